#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isorelax {

/// Where a text format lets a comment begin.
enum class CommentRule : std::uint8_t { none, anywhere, at_token };

/// Whether a backslash at the end of a line joins it with the next one.
enum class LineJoin : std::uint8_t { never, backslash };

struct ScannerRules {
  CommentRule comments = CommentRule::none;
  LineJoin join = LineJoin::never;
};

/// Walks over the lines and words of a text held in memory, and knows where it is.
///
/// Lines end in LF, CR LF or CR; a byte order mark at the start is skipped; words are separated by blanks.
/// Comments are cut off and collected. Reads nothing twice: O(bytes) for a whole file.
class TextScanner {
 public:
  TextScanner(std::string_view bytes, std::string name, ScannerRules rules);

  /// Says that `lines` lines stand before these bytes in their file.
  void start_after_line(std::size_t lines) { lines_begun_ = line_number_ = lines; }

  /// Moves to the next line, empty ones included. False at the end of the text.
  bool next_line();
  /// Next word on this line; empty when there is none.
  std::string_view word();
  /// Next word on this or a later line; empty at the end of the text.
  std::string_view word_across_lines();
  /// Moves on to a line that has a word left, if this one has none; false when the text has no more words.
  bool find_word();
  /// Next word on this line, left where it is.
  [[nodiscard]] std::string_view peek_word() const;
  /// What is left of this line, without blanks around it.
  std::string_view rest_of_line();
  /// Words left on this line, counted up to `most`: a caller that asks at every element of one long line must
  /// not walk through all of it each time.
  [[nodiscard]] std::size_t words_left(std::size_t most) const;
  /// Whether no word of this line was taken yet.
  [[nodiscard]] bool at_line_start() const { return words_taken_ == 0; }

  /// Next word across lines as a number. `what` names it in the error: "x coordinate".
  double number(const char* what);
  /// Same, and the number must be finite.
  double finite_number(const char* what);
  /// Next word across lines as a whole number from 0 to 2^64 - 1.
  std::uint64_t count(const char* what);

  /// Number of the current line, from 1.
  [[nodiscard]] std::size_t line() const { return line_number_; }
  /// Bytes from the current place to the end of the text.
  [[nodiscard]] std::size_t bytes_left() const;
  /// Bytes after the end of the current line.
  [[nodiscard]] std::size_t bytes_after_line() const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::vector<std::string>& comments() { return comments_; }

  /// Throws InputError with the current line.
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail_at(std::size_t line, const std::string& reason) const;

 private:
  std::string_view physical_line();
  void join_lines(std::string_view first);
  void cut_comment();
  void skip_blanks();

  std::string_view bytes_;
  std::string name_;
  ScannerRules rules_;
  std::size_t next_start_ = 0;
  std::size_t next_newline_ = 0;
  std::size_t lines_begun_ = 0;
  std::size_t line_number_ = 0;
  std::string_view line_;
  std::string joined_;
  std::size_t position_ = 0;
  std::size_t words_taken_ = 0;
  std::vector<std::string> comments_;
};

/// A word of a file as an error shows it: in quotes, at most 40 bytes, all but printable ASCII as \xNN.
std::string in_quotes(std::string_view word);

/// A file name as a message shows it: control bytes as \xNN, so that the message stays one line.
std::string one_line(std::string_view text);

/// The double nearest to a decimal number (also nan, inf, a leading +); none when the word is no number.
/// A number beyond the largest double becomes infinite, one below the smallest becomes zero.
std::optional<double> parse_double(std::string_view word);

/// A whole decimal number with an optional sign; none when the word is anything else or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace isorelax
