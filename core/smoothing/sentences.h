#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <string>

#include "mesh/triangle_mesh.h"

// Parts of the sentences that runs tell.
namespace isorelax {

/// Three digits of a number.
inline std::string short_text(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

/// "1 vertex is", "2 vertices are".
inline std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// The first ten, and how many more.
inline std::string list_ids(std::span<const Index> ids) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(ids.size(), kShown); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(ids[i]);
  if (ids.size() > kShown) text += " and " + std::to_string(ids.size() - kShown) + " more";
  return text;
}

}  // namespace isorelax
