#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace isorelax {

/// The numbers after a PLY header, one after the other, whether they are text or binary.
class PlySource {
 public:
  PlySource(std::string_view bytes, const std::string& name, const PlyHeader& header);

  /// Next number. Text must fit the range of a whole-number type. Throws InputError at the end of the file.
  double number(ScalarType type);
  /// Next count of a list: from 0, and not more than the numbers that can still follow.
  std::size_t list_size(const PlyProperty& list);
  /// Passes over `count` numbers.
  void skip(ScalarType type, std::size_t count);

  /// Ends a row: in text, nothing may be left on its line.
  void end_row();
  /// What follows the last element, as a message; empty when nothing does. Throws InputError for what looks
  /// like more elements than the header promises: a number in text, anything but blanks in binary.
  [[nodiscard]] std::string describe_rest();

  /// Least number of bytes that a number of this type takes.
  [[nodiscard]] std::size_t least_size(ScalarType type) const;
  [[nodiscard]] std::size_t bytes_left() const;
  /// Tells the source what is being read, for its errors.
  void at(const PlyElement& element, std::size_t row);
  [[nodiscard]] std::string place() const;
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  double text_number(ScalarType type);

  std::string_view bytes_;
  TextScanner text_;
  FileEncoding encoding_;
  std::size_t position_ = 0;
  const PlyElement* element_ = nullptr;
  std::size_t row_ = 0;
};

}  // namespace isorelax
