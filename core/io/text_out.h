#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Appends the shortest decimal digits that read back as the same double.
inline void append_number(std::string& out, double value) {
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), result.ptr);
}

/// Those digits alone.
inline std::string digits_of(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

/// The three coordinates of a point with blanks between.
inline void append_point(std::string& out, const Vec3& point) {
  append_number(out, point.x());
  out += ' ';
  append_number(out, point.y());
  out += ' ';
  append_number(out, point.z());
}

/// The same as append_number, with ".0" after a whole number: for formats where "1" and "1.0" mean different
/// things.
inline void append_fraction(std::string& out, double value) {
  const std::size_t begin = out.size();
  append_number(out, value);
  if (out.find_first_of(".einf", begin) == std::string::npos) {
    out += ".0";
  }
}

/// A whole number in plain digits, where `append_number` might choose 1e+06. Precondition: below 2^53.
inline void append_whole(std::string& out, double value) {
  std::array<char, 24> digits;
  const auto result =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<long long>(value));
  out.append(digits.data(), result.ptr);
}

inline void append_integer(std::string& out, std::size_t value) {
  std::array<char, 24> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), result.ptr);
}

/// A whole number with zeros in front, at least `width` digits: names of files that sort as their numbers.
inline std::string zero_padded(std::size_t number, std::size_t width) {
  std::string digits = std::to_string(number);
  digits.insert(0, width - std::min(width, digits.size()), '0');
  return digits;
}

/// Appends each text as a line after `sign`; line breaks inside a text begin another such line.
inline void append_lines(std::string& out, std::string_view sign, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    out += sign;
    for (const char c : text) {
      if (c == '\n') {
        out += '\n';
        out += sign;
      } else if (c != '\r') {
        out += c;
      }
    }
    out += '\n';
  }
}

}  // namespace isorelax
