#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "io/text_in.h"
#include "mesh/error.h"

namespace isorelax::editor {

/// A word as a number. Throws UsageError.
template <typename Number>
[[nodiscard]] Number to_number(const std::string& word) {
  Number value = 0;
  if (!read_number(word, value)) throw UsageError("expected a number, found \"" + word + "\"");
  return value;
}

/// Throws UsageError where there are fewer or more words behind the first.
inline void require(std::span<const std::string> words, std::size_t least, std::size_t most) {
  if (words.size() < least + 1) throw UsageError(words.front() + ": something is missing");
  if (words.size() > most + 1) throw UsageError(words.front() + ": \"" + words[most + 1] + "\" is too much");
}

/// Which of several names a word is. Throws UsageError with all of them.
template <std::size_t N>
[[nodiscard]] std::size_t index_of(const std::array<std::string_view, N>& names, const std::string& word) {
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string_view name : names) known += (known.empty() ? "" : ", ") + std::string(name);
  throw UsageError("\"" + word + "\": expected one of " + known);
}

}  // namespace isorelax::editor
