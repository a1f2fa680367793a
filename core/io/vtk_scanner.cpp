#include "io/vtk_scanner.h"

#include <cmath>
#include <limits>

#include "io/text_scanner.h"
#include "io/vtk_names.h"

namespace isorelax {

VtkType VtkScanner::type() {
  const std::string_view word = scanner_.word();
  const std::optional<VtkType> found = legacy_vtk_type(word);
  if (!found) {
    scanner_.fail("unknown type of numbers: " + in_quotes(word));
  }
  return *found;
}

void VtkScanner::begin_numbers() {
  // In text, numbers may begin on the same line.
  if (!text_) {
    static_cast<void>(scanner_.line());
  }
}

/// Throws unless the rest of the file has room for so many numbers, before memory is set aside for them.
void VtkScanner::promise(VtkType type, std::uint64_t count, const char* what) const {
  // A number of a text takes two bytes; the very last one has no blank after it.
  const std::uint64_t needed = text_ ? capped_product(count, 2) : binary_size(type, count);
  if (needed > scanner_.bytes_left() + (text_ ? 1 : 0)) {
    scanner_.fail("promises " + std::to_string(count) + " " + what + ", but only " +
                  std::to_string(scanner_.bytes_left()) + " bytes follow");
  }
}

void VtkScanner::numbers(VtkArray& array) {
  if (array.width > std::numeric_limits<std::uint32_t>::max()) {
    scanner_.fail("an array has " + std::to_string(array.width) + " components");
  }
  last_width_ = array.width;
  promise(array.type, array.size(), "numbers");
  const auto count = static_cast<std::size_t>(array.size());
  if (!text_) {
    const auto size = static_cast<std::size_t>(binary_size(array.type, count));
    append_binary(array, scanner_.raw_bytes(size, "an array").data(), std::endian::big);
    return;
  }
  array.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = scanner_.word();
    if (word.empty()) {
      scanner_.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                    " numbers of an array");
    }
    if (!append_word(array, word)) {
      scanner_.fail("a number of an array is none: " + in_quotes(word));
    }
  }
}

void VtkScanner::check_finite(double value, std::size_t place) const {
  if (!std::isfinite(value)) {
    scanner_.fail("a coordinate of point " + std::to_string(place / 3) +
                  (std::isnan(value) ? " is not a number (NaN)" : " is infinite or too large"));
  }
}

void VtkScanner::coordinates(VtkArray& array) {
  if (!text_) {
    numbers(array);
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      check_finite(array.values[i], i);
    }
    return;
  }
  // One by one, so that an error names its line.
  last_width_ = 3;
  promise(array.type, array.size(), "numbers");
  const auto count = static_cast<std::size_t>(array.size());
  array.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    array.values.push_back(scanner_.number("a coordinate of a point"));
    check_finite(array.values.back(), i);
  }
}

std::vector<VtkArray> VtkScanner::field(std::vector<std::string>& messages) {
  std::vector<VtkArray> arrays;
  static_cast<void>(scanner_.word());  // the name of all of them together, which says nothing
  const std::uint64_t count = scanner_.count("the number of arrays");
  for (std::uint64_t i = 0; i < count; ++i) {
    while (vtk_lower_case(scanner_.peek_word()) == "metadata") {
      static_cast<void>(scanner_.word());
      skip_metadata();
    }
    VtkArray array;
    array.name = decode_vtk_name(scanner_.word());
    array.width = scanner_.count("the number of components of an array");
    array.rows = scanner_.count("the number of rows of an array");
    const std::string word = vtk_lower_case(scanner_.peek_word());
    if (word == "string" || word == "utf8_string") {
      skip_strings(array);
      messages.push_back("array " + in_quotes(array.name) + " of texts left out");
      continue;
    }
    array.type = type();
    begin_numbers();
    numbers(array);
    arrays.push_back(std::move(array));
  }
  return arrays;
}

/// Texts stand one on a line, or each after its length in the lower bits of one, two, four or eight bytes.
void VtkScanner::skip_strings(const VtkArray& array) {
  static_cast<void>(scanner_.line());
  last_width_ = array.width;
  scanner_.promise(array.size(), 1, "texts");
  for (std::uint64_t i = 0; i < array.size(); ++i) {
    if (text_) {
      static_cast<void>(scanner_.line());
      continue;
    }
    const auto first = scanner_.raw<std::uint8_t>(std::endian::big, "the length of a text");
    std::uint64_t length = first & 0x3fU;
    for (unsigned more = (1U << (3 - first / 64U)) - 1; more > 0; --more) {
      length = length << 8U | scanner_.raw<std::uint8_t>(std::endian::big, "the length of a text");
    }
    static_cast<void>(scanner_.raw_bytes(length, "a text"));
  }
}

/// Names of components, then INFORMATION with some lines of its own; an empty line ends it.
void VtkScanner::skip_metadata() {
  static_cast<void>(scanner_.line());
  while (scanner_.bytes_left() > 0) {
    const std::string_view line = scanner_.line();
    if (line.empty()) {
      return;
    }
    if (vtk_lower_case(line) == "component_names") {
      for (std::uint64_t i = 0; i < last_width_ && scanner_.bytes_left() > 0; ++i) {
        static_cast<void>(scanner_.line());  // empty for a component without a name
      }
    }
  }
}

std::vector<std::uint8_t> VtkScanner::small_numbers(std::uint64_t count, const char* what) {
  begin_numbers();
  promise(VtkType::int32, count, "numbers");
  std::vector<std::uint8_t> values;
  values.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::int64_t value = integer(VtkType::int32, what);
    if (value < 0 || value > std::numeric_limits<std::uint8_t>::max()) {
      scanner_.fail(std::string(what) + " is unknown: " + std::to_string(value));
    }
    values.push_back(static_cast<std::uint8_t>(value));
  }
  return values;
}

}  // namespace isorelax
