#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/byte_order.h"

namespace isorelax {

/// Walks over a file in which lines of text and stretches of binary numbers take turns (MSH, legacy VTK), and
/// knows where it is. Lines end in LF, CR LF or CR; words are separated by blanks and line ends. Reads
/// nothing twice.
class MixedScanner {
 public:
  MixedScanner(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  /// The rest of this line without blanks around it; moves behind its end.
  std::string_view line();
  /// Next word on this or a later line; empty at the end of the file.
  std::string_view word();
  /// The same, left where it is.
  std::string_view peek_word();
  /// Next word as a number. `what` names it in the error: "the x coordinate of a node".
  double number(const char* what);
  double finite_number(const char* what);
  /// Next word as a whole number.
  std::int64_t integer(const char* what);
  /// The same, from 0 on.
  std::uint64_t count(const char* what);

  /// The next sizeof(T) bytes as a binary number.
  template <class T>
  T raw(std::endian order, const char* what) {
    const std::string_view found = raw_bytes(sizeof(T), what);
    return load_bytes<T>(found.data(), order);
  }
  std::string_view raw_bytes(std::size_t size, const char* what);

  /// Passes over what is not read. Precondition: `position` is not before the present one.
  void skip_to(std::size_t position) { last_ = position_ = position; }

  /// Throws unless so many elements, of at least so many bytes each, can follow.
  void promise(std::uint64_t elements, std::size_t least_bytes, const char* what) const;

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t bytes_left() const { return bytes_.size() - position_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Throws InputError with the line of what was read last; with its byte where the file was binary so far.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void skip_blanks();

  std::string_view bytes_;
  std::string name_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;  ///< where what was read last began
  bool binary_ = false;   ///< lines mean nothing after binary numbers
};

}  // namespace isorelax
