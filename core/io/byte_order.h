#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>

namespace isorelax {

/// The value of type T that stands at `bytes` in this byte order.
template <class T>
[[nodiscard]] T load_bytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (order != std::endian::native) {
    std::reverse(raw.begin(), raw.end());
  }
  return std::bit_cast<T>(raw);
}

/// Appends the bytes of `value` in this byte order.
template <class T>
void append_bytes(std::string& out, T value, std::endian order) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) {
    std::reverse(raw.begin(), raw.end());
  }
  out.append(raw.data(), raw.size());
}

}  // namespace isorelax
