#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/text_scanner.h"
#include "mesh/attributes.h"

namespace isorelax {

/// Colours that a text file may, or may not, give for each vertex or face: whole numbers 0 .. 255 or
/// fractions, with or without opacity.
class ColorColumn {
 public:
  /// Takes the next `width` (3 or 4) words of the current line as the colour of element `index`. Indices come
  /// in ascending order; elements passed over have no colour. Throws InputError for a word that is no number.
  void take(TextScanner& text, std::size_t index, unsigned width);

  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// Appends the attribute "color" of `count` elements, uint8 when every number was whole and at most 255,
  /// and says in a message how many elements had no colour and are white now. `elements` is their noun.
  void finish(std::size_t count, const char* elements, std::vector<Attribute>& attributes,
              std::vector<std::string>& messages) const;

 private:
  struct Row {
    std::array<double, 4> value{};
    unsigned width = 0;
  };
  std::vector<Row> rows_;
  bool whole_ = true;
  unsigned width_ = 3;
};

}  // namespace isorelax
