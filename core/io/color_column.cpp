#include "io/color_column.h"

#include <algorithm>

namespace isorelax {

void ColorColumn::take(TextScanner& text, std::size_t index, unsigned width) {
  Row row;
  row.width = width;
  bool whole = true;
  for (unsigned k = 0; k < width; ++k) {
    const std::string_view word = text.word();
    const std::optional<double> value = parse_double(word);
    if (!value) {
      text.fail("a colour is not a number: " + in_quotes(word));
    }
    row.value[k] = *value;
    const std::optional<std::int64_t> integer = parse_integer(word);
    whole = whole && integer && *integer >= 0 && *integer <= 255;
  }
  row.means_bytes = numbers_ == ColorNumbers::bytes_or_fractions && whole && std::ranges::max(row.value) > 1;
  whole_ = whole_ && whole;
  width_ = std::max(width_, width);
  rows_.resize(index);
  rows_.push_back(row);
}

void ColorColumn::finish(std::size_t count, const char* elements, std::vector<Attribute>& attributes,
                         std::vector<std::string>& messages) const {
  if (rows_.empty()) {
    return;
  }
  const double full = whole_ ? 255.0 : 1.0;
  Attribute color{"color", whole_ ? ScalarType::uint8 : ScalarType::float64, width_, {}};
  color.values.assign(count * width_, full);
  std::size_t without = count - rows_.size();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool divide = !whole_ && rows_[i].means_bytes;
    for (unsigned k = 0; k < rows_[i].width; ++k)
      color.values[i * width_ + k] = divide ? rows_[i].value[k] / 255 : rows_[i].value[k];
    changed += divide ? 1 : 0;
    without += rows_[i].width == 0 ? 1 : 0;
  }
  if (without > 0) {
    messages.push_back(std::to_string(without) + " of " + std::to_string(count) + " " + elements +
                       " without a colour made white");
  }
  if (changed > 0) {
    messages.push_back("colours of " + std::to_string(changed) + " of " + std::to_string(count) + " " +
                       elements + " given in bytes among fractions made fractions");
  }
  attributes.push_back(std::move(color));
}

}  // namespace isorelax
