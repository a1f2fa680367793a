#include "io/vtk_numbers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "io/byte_order.h"
#include "io/scalar_bytes.h"
#include "io/text_in.h"
#include "io/text_scanner.h"
#include "io/vtk_names.h"

namespace isorelax {
namespace {

using NamedType = std::pair<std::string_view, VtkType>;

template <std::size_t size>
std::optional<VtkType> find_vtk_type(const std::array<NamedType, size>& types, std::string_view word) {
  const auto* const found =
      std::find_if(types.begin(), types.end(), [&](const NamedType& type) { return type.first == word; });
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

template <class Integer>
void append_wide(VtkArray& array, Integer value) {
  const auto nearest = static_cast<double>(value);
  // The largest values round up to 2^63 or 2^64, which their type does not hold.
  constexpr double kBeyond =
      2.0 * static_cast<double>(Integer{1} << (std::numeric_limits<Integer>::digits - 1));
  array.rounded += nearest >= kBeyond || static_cast<Integer>(nearest) != value ? 1 : 0;
  array.values.push_back(nearest);
}

template <class Integer>
bool append_wide_word(VtkArray& array, std::string_view word) {
  Integer value = 0;
  if (!read_number(word, value)) {
    return false;
  }
  append_wide(array, value);
  return true;
}

}  // namespace

std::uint64_t VtkArray::size() const {
  return capped_product(rows, width);
}

std::optional<VtkType> legacy_vtk_type(std::string_view word) {
  // A vtkIdType is written with 32 bits whatever it is in memory; a long is taken for one of 64 bits.
  static constexpr std::array<NamedType, 19> kTypes{{{"bit", VtkType::bit},
                                                     {"char", VtkType::int8},
                                                     {"signed_char", VtkType::int8},
                                                     {"unsigned_char", VtkType::uint8},
                                                     {"short", VtkType::int16},
                                                     {"unsigned_short", VtkType::uint16},
                                                     {"int", VtkType::int32},
                                                     {"vtkidtype", VtkType::int32},
                                                     {"vtktypeint32", VtkType::int32},
                                                     {"unsigned_int", VtkType::uint32},
                                                     {"vtktypeuint32", VtkType::uint32},
                                                     {"long", VtkType::int64},
                                                     {"long_long", VtkType::int64},
                                                     {"vtktypeint64", VtkType::int64},
                                                     {"unsigned_long", VtkType::uint64},
                                                     {"unsigned_long_long", VtkType::uint64},
                                                     {"vtktypeuint64", VtkType::uint64},
                                                     {"float", VtkType::float32},
                                                     {"double", VtkType::float64}}};
  return find_vtk_type(kTypes, vtk_lower_case(word));
}

std::optional<VtkType> xml_vtk_type(std::string_view word) {
  static constexpr std::array<NamedType, 11> kTypes{{{"Bit", VtkType::bit},
                                                     {"Int8", VtkType::int8},
                                                     {"UInt8", VtkType::uint8},
                                                     {"Int16", VtkType::int16},
                                                     {"UInt16", VtkType::uint16},
                                                     {"Int32", VtkType::int32},
                                                     {"UInt32", VtkType::uint32},
                                                     {"Int64", VtkType::int64},
                                                     {"UInt64", VtkType::uint64},
                                                     {"Float32", VtkType::float32},
                                                     {"Float64", VtkType::float64}}};
  return find_vtk_type(kTypes, word);
}

const char* legacy_vtk_name(ScalarType type) {
  static constexpr std::array<const char*, 10> kNames{
      "char",         "unsigned_char", "short",  "unsigned_short", "int",
      "unsigned_int", "float",         "double", "vtktypeint64",   "vtktypeuint64"};
  return kNames[static_cast<std::size_t>(type)];
}

const char* xml_vtk_name(ScalarType type) {
  static constexpr std::array<const char*, 10> kNames{"Int8",   "UInt8",   "Int16",   "UInt16", "Int32",
                                                      "UInt32", "Float32", "Float64", "Int64",  "UInt64"};
  return kNames[static_cast<std::size_t>(type)];
}

ScalarType kept_type(VtkType type) {
  static constexpr std::array<ScalarType, 11> kTypes{
      ScalarType::uint8,  ScalarType::int8,    ScalarType::uint8,  ScalarType::int16,
      ScalarType::uint16, ScalarType::int32,   ScalarType::uint32, ScalarType::int64,
      ScalarType::uint64, ScalarType::float32, ScalarType::float64};
  return kTypes[static_cast<std::size_t>(type)];
}

std::uint64_t capped_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > kLargest / b ? kLargest : a * b;
}

std::uint64_t binary_size(VtkType type, std::uint64_t count) {
  if (type == VtkType::bit) return count / 8 + (count % 8 == 0 ? 0 : 1);
  return capped_product(count, size_of(kept_type(type)));
}

void append_binary(VtkArray& array, const char* bytes, std::endian order) {
  const auto count = static_cast<std::size_t>(array.size());
  array.values.reserve(array.values.size() + count);
  switch (array.type) {
    case VtkType::bit:
      for (std::size_t i = 0; i < count; ++i) {
        array.values.push_back((static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8)) & 1U);
      }
      return;
    case VtkType::int64:
      for (std::size_t i = 0; i < count; ++i) {
        append_wide(array, load_bytes<std::int64_t>(bytes + 8 * i, order));
      }
      return;
    case VtkType::uint64:
      for (std::size_t i = 0; i < count; ++i) {
        append_wide(array, load_bytes<std::uint64_t>(bytes + 8 * i, order));
      }
      return;
    default:
      const ScalarType type = kept_type(array.type);
      for (std::size_t i = 0; i < count; ++i) {
        array.values.push_back(load_scalar(bytes + size_of(type) * i, type, order));
      }
  }
}

bool append_word(VtkArray& array, std::string_view word) {
  if (array.type == VtkType::int64 && append_wide_word<std::int64_t>(array, word)) {
    return true;
  }
  if (array.type == VtkType::uint64 && append_wide_word<std::uint64_t>(array, word)) {
    return true;
  }
  const std::optional<double> value = parse_double(word);
  if (!value) {
    return false;
  }
  // Whole numbers have no negative zero.
  array.values.push_back(is_whole(array.type) ? *value + 0.0 : *value);
  return true;
}

}  // namespace isorelax
