#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace isorelax {

/// Reads the number that the whole text is: false where it is none, out of the type's range, or more than a
/// number, blanks and a plus sign included. "inf" and "nan" are numbers where the type has them.
template <typename Number>
[[nodiscard]] bool read_number(std::string_view text, Number& value) {
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last;
}

}  // namespace isorelax
