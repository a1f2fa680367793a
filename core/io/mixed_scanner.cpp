#include "io/mixed_scanner.h"

#include <algorithm>
#include <cmath>

#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

bool parts_words(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || ends_line(c);
}

}  // namespace

std::string_view MixedScanner::line() {
  last_ = position_;
  const auto* const begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
  const auto* const end = std::find_if(begin, bytes_.end(), ends_line);
  position_ = static_cast<std::size_t>(end - bytes_.begin());
  if (end != bytes_.end()) position_ += *end == '\r' && end + 1 != bytes_.end() && end[1] == '\n' ? 2 : 1;
  const auto* const first = std::find_if_not(begin, end, parts_words);
  const auto* last = end;
  while (last != first && parts_words(last[-1])) --last;
  return {first, last};
}

void MixedScanner::skip_blanks() {
  while (position_ < bytes_.size() && parts_words(bytes_[position_])) ++position_;
}

std::string_view MixedScanner::peek_word() {
  skip_blanks();
  const auto* const begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
  return {begin, std::find_if(begin, bytes_.end(), parts_words)};
}

std::string_view MixedScanner::word() {
  const std::string_view found = peek_word();
  last_ = position_;
  position_ += found.size();
  return found;
}

double MixedScanner::number(const char* what) {
  const std::string_view text = word();
  if (text.empty()) fail(std::string("the file ends where ") + what + " should stand");
  const std::optional<double> value = parse_double(text);
  if (!value) fail(std::string(what) + " is not a number: " + in_quotes(text));
  return *value;
}

double MixedScanner::finite_number(const char* what) {
  const double value = number(what);
  if (!std::isfinite(value))
    fail(std::string(what) + (std::isnan(value) ? " is not a number (NaN)" : " is infinite or too large"));
  return value;
}

std::int64_t MixedScanner::integer(const char* what) {
  const std::string_view text = word();
  if (text.empty()) fail(std::string("the file ends where ") + what + " should stand");
  const std::optional<std::int64_t> value = parse_integer(text);
  if (!value) fail(std::string(what) + " is not a whole number: " + in_quotes(text));
  return *value;
}

std::uint64_t MixedScanner::count(const char* what) {
  const std::int64_t value = integer(what);
  if (value < 0) fail(std::string(what) + " is negative");
  return static_cast<std::uint64_t>(value);
}

std::string_view MixedScanner::raw_bytes(std::size_t size, const char* what) {
  last_ = position_;
  binary_ = true;
  if (size > bytes_left()) fail(std::string("the file ends within ") + what);
  position_ += size;
  return bytes_.substr(last_, size);
}

void MixedScanner::promise(std::uint64_t elements, std::size_t least_bytes, const char* what) const {
  // The very last number of a text has no blank after it.
  if (elements > bytes_left() / least_bytes + 1) {
    fail("promises " + std::to_string(elements) + " " + what + ", but only " + std::to_string(bytes_left()) +
         " bytes follow");
  }
}

void MixedScanner::fail(const std::string& reason) const {
  std::string place = "byte " + std::to_string(last_);
  if (!binary_) {
    const std::string_view before = bytes_.substr(0, last_);
    std::size_t lines = 1;
    for (std::size_t i = 0; i < before.size(); ++i)
      lines += before[i] == '\n' || (before[i] == '\r' && (i + 1 == before.size() || before[i + 1] != '\n'));
    place = "line " + std::to_string(lines);
  }
  throw InputError(one_line(name_), place, reason);
}

}  // namespace isorelax
