#pragma once

#include <bit>
#include <cstddef>
#include <string>

#include "mesh/attributes.h"

namespace isorelax {

/// Bytes that a number of this type takes.
[[nodiscard]] std::size_t size_of(ScalarType type);

/// Whether the type holds fractions.
[[nodiscard]] constexpr bool is_real(ScalarType type) {
  return type == ScalarType::float32 || type == ScalarType::float64;
}

/// The number of this type that stands at `bytes` in this byte order.
[[nodiscard]] double load_scalar(const char* bytes, ScalarType type, std::endian order);

/// Appends `value` as a number of this type in this byte order. Precondition: the type holds it (fits).
void append_scalar(std::string& out, double value, ScalarType type, std::endian order);

/// Appends it as text: the shortest digits that read back as the same double, whole numbers in full.
void append_scalar_text(std::string& out, double value, ScalarType type);

}  // namespace isorelax
