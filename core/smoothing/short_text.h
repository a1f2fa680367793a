#pragma once

#include <array>
#include <charconv>
#include <string>

namespace isorelax {

/// Three digits of a number, for sentences.
inline std::string short_text(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

}  // namespace isorelax
