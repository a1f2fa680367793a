#include "io/text_scanner.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mesh/error.h"

namespace isorelax {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::size_t find_byte(std::string_view text, char byte, std::size_t from) {
  const std::size_t place = text.find(byte, from);
  return place == std::string_view::npos ? text.size() : place;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

enum class Escape { control_bytes, all_but_ascii };

std::string escaped(std::string_view text, Escape which) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || (byte > 0x7f && which == Escape::all_but_ascii)) {
      out += "\\x";
      out += kDigits[byte >> 4];
      out += kDigits[byte & 15];
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

TextScanner::TextScanner(std::string_view bytes, std::string name, ScannerRules rules)
    : bytes_(bytes), name_(std::move(name)), rules_(rules) {
  if (bytes_.substr(0, 3) == "\xef\xbb\xbf") {
    next_start_ = 3;
  }
  next_newline_ = find_byte(bytes_, '\n', next_start_);
}

std::string_view TextScanner::physical_line() {
  // The place of the next LF is remembered: a text of many lines that end in CR is not searched again for
  // each of them.
  if (next_newline_ < next_start_) {
    next_newline_ = find_byte(bytes_, '\n', next_start_);
  }
  const std::string_view upto_newline = bytes_.substr(next_start_, next_newline_ - next_start_);
  const std::size_t length = find_byte(upto_newline, '\r', 0);
  std::size_t end = next_start_ + length;
  const std::string_view line = upto_newline.substr(0, length);
  if (end < bytes_.size() && bytes_[end] == '\r' && end + 1 < bytes_.size() && bytes_[end + 1] == '\n') {
    ++end;
  }
  next_start_ = end + 1;
  ++lines_begun_;
  return line;
}

bool TextScanner::next_line() {
  if (next_start_ >= bytes_.size()) {
    line_ = {};
    position_ = 0;
    return false;
  }
  line_ = physical_line();
  line_number_ = lines_begun_;
  position_ = 0;
  words_taken_ = 0;
  // A comment may end in a path; the line after it is no part of it.
  const bool is_comment = rules_.comments != CommentRule::none && trimmed(line_).substr(0, 1) == "#";
  if (rules_.join == LineJoin::backslash && !is_comment && !line_.empty() && line_.back() == '\\') {
    join_lines(line_);
  }
  cut_comment();
  return true;
}

void TextScanner::join_lines(std::string_view first) {
  joined_.assign(first);
  while (!joined_.empty() && joined_.back() == '\\') {
    joined_.back() = ' ';
    if (next_start_ >= bytes_.size()) {
      break;
    }
    joined_ += physical_line();
  }
  line_ = joined_;
}

void TextScanner::cut_comment() {
  if (rules_.comments == CommentRule::none) {
    return;
  }
  std::size_t place = line_.find('#');
  while (place != std::string_view::npos && rules_.comments == CommentRule::at_token && place > 0 &&
         !is_blank(line_[place - 1])) {
    place = line_.find('#', place + 1);
  }
  if (place == std::string_view::npos) {
    return;
  }
  std::string_view comment = line_.substr(place + 1);
  if (!comment.empty() && comment.front() == ' ') {
    comment.remove_prefix(1);
  }
  // A bare comment sign says nothing, and a file may have millions of them.
  if (!comment.empty()) {
    comments_.emplace_back(comment);
  }
  line_ = line_.substr(0, place);
}

void TextScanner::skip_blanks() {
  while (position_ < line_.size() && is_blank(line_[position_])) {
    ++position_;
  }
}

std::string_view TextScanner::word() {
  skip_blanks();
  const std::size_t begin = position_;
  while (position_ < line_.size() && !is_blank(line_[position_])) {
    ++position_;
  }
  words_taken_ += position_ > begin ? 1 : 0;
  return line_.substr(begin, position_ - begin);
}

std::string_view TextScanner::word_across_lines() {
  std::string_view found = word();
  while (found.empty() && next_line()) {
    found = word();
  }
  return found;
}

bool TextScanner::find_word() {
  skip_blanks();
  while (position_ == line_.size()) {
    if (!next_line()) {
      return false;
    }
    skip_blanks();
  }
  return true;
}

std::string_view TextScanner::peek_word() const {
  const auto begin =
      std::find_if_not(line_.begin() + static_cast<std::ptrdiff_t>(position_), line_.end(), is_blank);
  return {begin, std::find_if(begin, line_.end(), is_blank)};
}

std::string_view TextScanner::rest_of_line() {
  const std::string_view rest = trimmed(line_.substr(position_));
  position_ = line_.size();
  return rest;
}

std::size_t TextScanner::words_left(std::size_t most) const {
  std::size_t words = 0;
  bool inside = false;
  for (std::size_t i = position_; i < line_.size() && words < most; ++i) {
    const bool blank = is_blank(line_[i]);
    words += !blank && !inside ? 1 : 0;
    inside = !blank;
  }
  return words;
}

std::size_t TextScanner::bytes_left() const {
  return line_.size() - position_ + bytes_after_line();
}

std::size_t TextScanner::bytes_after_line() const {
  return next_start_ < bytes_.size() ? bytes_.size() - next_start_ : 0;
}

double TextScanner::number(const char* what) {
  const std::string_view text = word_across_lines();
  if (text.empty()) {
    fail(std::string("the file ends where ") + what + " should stand");
  }
  const std::optional<double> value = parse_double(text);
  if (!value) {
    fail(std::string(what) + " is not a number: " + in_quotes(text));
  }
  return *value;
}

double TextScanner::finite_number(const char* what) {
  const double value = number(what);
  if (!std::isfinite(value)) {
    fail(std::string(what) + (std::isnan(value) ? " is not a number (NaN)" : " is infinite or too large"));
  }
  return value;
}

std::uint64_t TextScanner::count(const char* what) {
  const std::string_view text = word_across_lines();
  if (text.empty()) {
    fail(std::string("the file ends where ") + what + " should stand");
  }
  const std::optional<std::int64_t> value = parse_integer(text);
  if (!value || *value < 0) {
    fail(std::string(what) + " is not a whole number from 0 on: " + in_quotes(text));
  }
  return static_cast<std::uint64_t>(*value);
}

void TextScanner::fail(const std::string& reason) const {
  fail_at(line_number_, reason);
}

void TextScanner::fail_at(std::size_t line, const std::string& reason) const {
  throw InputError(one_line(name_), "line " + std::to_string(line == 0 ? 1 : line), reason);
}

std::string in_quotes(std::string_view word) {
  static constexpr std::size_t kLongest = 40;
  const bool cut = word.size() > kLongest;
  return "'" + escaped(word.substr(0, kLongest), Escape::all_but_ascii) + (cut ? "...'" : "'");
}

std::string one_line(std::string_view text) {
  return escaped(text, Escape::control_bytes);
}

std::optional<double> parse_double(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  double value = 0.0;
  const auto result = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec == std::errc::invalid_argument || result.ptr != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  std::int64_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc{} || result.ptr != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace isorelax
