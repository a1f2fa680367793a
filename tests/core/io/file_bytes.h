#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/byte_order.h"

namespace isorelax {

inline std::string little_endian_floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    append_bytes(bytes, value, std::endian::little);
  }
  return bytes;
}

/// Binary STL of these facets (nine coordinates each), with zero normals and the attribute given.
inline std::string binary_stl(const std::vector<std::vector<float>>& facets, std::uint16_t attribute = 0,
                              const std::string& title = "") {
  std::string bytes = title;
  bytes.resize(80, '\0');
  append_bytes(bytes, static_cast<std::uint32_t>(facets.size()), std::endian::little);
  for (const std::vector<float>& facet : facets) {
    bytes += little_endian_floats({0, 0, 0}) + little_endian_floats(facet);
    append_bytes(bytes, attribute, std::endian::little);
  }
  return bytes;
}

}  // namespace isorelax
