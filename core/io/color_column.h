#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/text_scanner.h"
#include "mesh/attributes.h"

namespace isorelax {

/// How a format means its colours: always as fractions of one, or as bytes when all of them are whole.
enum class ColorNumbers : std::uint8_t { fractions, bytes_or_fractions };

/// Colours that a text file may, or may not, give for each vertex or face: whole numbers 0 .. 255 or
/// fractions, with or without opacity.
class ColorColumn {
 public:
  explicit ColorColumn(ColorNumbers numbers)
      : numbers_(numbers), whole_(numbers == ColorNumbers::bytes_or_fractions) {}

  /// Takes the next `width` (3 or 4) words of the current line as the colour of element `index`. Indices come
  /// in ascending order; elements passed over have no colour. Throws InputError for a word that is no number.
  void take(TextScanner& text, std::size_t index, unsigned width);

  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// Appends the attribute "color" of `count` elements, uint8 when every number was whole and at most 255,
  /// and says in messages how many elements had no colour and are white now, and how many colours of bytes
  /// among fractions are fractions now. `elements` is their noun.
  void finish(std::size_t count, const char* elements, std::vector<Attribute>& attributes,
              std::vector<std::string>& messages) const;

 private:
  struct Row {
    std::array<double, 4> value{};
    unsigned width = 0;
    bool means_bytes = false;  ///< even among fractions: whole, and beyond 1
  };
  ColorNumbers numbers_;
  std::vector<Row> rows_;
  /// Whether all numbers so far may be bytes.
  bool whole_;
  unsigned width_ = 3;
};

}  // namespace isorelax
