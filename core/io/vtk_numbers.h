#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/attributes.h"

namespace isorelax {

/// Types of numbers in VTK's files. Eight bits of an array stand in one byte, the first in its highest bit.
enum class VtkType : std::uint8_t {
  bit,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// One array of a file: `rows` times `width` numbers, row by row.
struct VtkArray {
  std::string name;
  VtkType type = VtkType::float64;
  std::uint64_t width = 1;
  std::uint64_t rows = 0;
  std::vector<double> values;
  /// Whole numbers of 64 bits that no double holds.
  std::size_t rounded = 0;

  [[nodiscard]] std::uint64_t size() const;
};

/// The type that a legacy file (any case of letters) or an XML file names so; none for any other word.
[[nodiscard]] std::optional<VtkType> legacy_vtk_type(std::string_view word);
[[nodiscard]] std::optional<VtkType> xml_vtk_type(std::string_view word);

/// What a writer calls the type: "unsigned_char", "UInt8".
[[nodiscard]] const char* legacy_vtk_name(ScalarType type);
[[nodiscard]] const char* xml_vtk_name(ScalarType type);

/// The type under which an attribute keeps such numbers: bits as bytes.
[[nodiscard]] ScalarType kept_type(VtkType type);

[[nodiscard]] constexpr bool is_whole(VtkType type) {
  return type != VtkType::float32 && type != VtkType::float64;
}

/// a * b, or 2^64 - 1 where that is too large.
[[nodiscard]] std::uint64_t capped_product(std::uint64_t a, std::uint64_t b);

/// Bytes that so many numbers take in binary; 2^64 - 1 where that is too large.
[[nodiscard]] std::uint64_t binary_size(VtkType type, std::uint64_t count);

/// Appends the array's size() numbers, which stand at `bytes`, binary_size of them.
void append_binary(VtkArray& array, const char* bytes, std::endian order);

/// Appends one number of a text; false where the word is none.
[[nodiscard]] bool append_word(VtkArray& array, std::string_view word);

}  // namespace isorelax
