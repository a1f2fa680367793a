#include "io/scalar_bytes.h"

#include <cstdint>

#include "io/byte_order.h"
#include "io/text_out.h"

namespace isorelax {

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8:
      return 1;
    case ScalarType::int16:
    case ScalarType::uint16:
      return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32:
      return 4;
    case ScalarType::float64:
    case ScalarType::int64:
    case ScalarType::uint64:
      return 8;
  }
  return 8;
}

double load_scalar(const char* bytes, ScalarType type, std::endian order) {
  switch (type) {
    case ScalarType::int8:
      return load_bytes<std::int8_t>(bytes, order);
    case ScalarType::uint8:
      return load_bytes<std::uint8_t>(bytes, order);
    case ScalarType::int16:
      return load_bytes<std::int16_t>(bytes, order);
    case ScalarType::uint16:
      return load_bytes<std::uint16_t>(bytes, order);
    case ScalarType::int32:
      return load_bytes<std::int32_t>(bytes, order);
    case ScalarType::uint32:
      return load_bytes<std::uint32_t>(bytes, order);
    case ScalarType::float32:
      return static_cast<double>(load_bytes<float>(bytes, order));
    case ScalarType::float64:
      return load_bytes<double>(bytes, order);
    case ScalarType::int64:
      return static_cast<double>(load_bytes<std::int64_t>(bytes, order));
    case ScalarType::uint64:
      return static_cast<double>(load_bytes<std::uint64_t>(bytes, order));
  }
  return 0.0;
}

void append_scalar(std::string& out, double value, ScalarType type, std::endian order) {
  switch (type) {
    case ScalarType::int8:
      return append_bytes(out, static_cast<std::int8_t>(value), order);
    case ScalarType::uint8:
      return append_bytes(out, static_cast<std::uint8_t>(value), order);
    case ScalarType::int16:
      return append_bytes(out, static_cast<std::int16_t>(value), order);
    case ScalarType::uint16:
      return append_bytes(out, static_cast<std::uint16_t>(value), order);
    case ScalarType::int32:
      return append_bytes(out, static_cast<std::int32_t>(value), order);
    case ScalarType::uint32:
      return append_bytes(out, static_cast<std::uint32_t>(value), order);
    case ScalarType::float32:
      return append_bytes(out, static_cast<float>(value), order);
    case ScalarType::float64:
      return append_bytes(out, value, order);
    case ScalarType::int64:
      return append_bytes(out, static_cast<std::int64_t>(value), order);
    case ScalarType::uint64:
      return append_bytes(out, static_cast<std::uint64_t>(value), order);
  }
}

void append_scalar_text(std::string& out, double value, ScalarType type) {
  if (type == ScalarType::uint64) return append_integer(out, static_cast<std::uint64_t>(value));
  is_real(type) ? append_number(out, value) : append_whole(out, value);
}

}  // namespace isorelax
