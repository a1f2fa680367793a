#include "io/color_column.h"

#include <algorithm>

namespace isorelax {

void ColorColumn::take(TextScanner& text, std::size_t index, unsigned width) {
  Row row;
  row.width = width;
  for (unsigned k = 0; k < width; ++k) {
    const std::string_view word = text.word();
    const std::optional<double> value = parse_double(word);
    if (!value) {
      text.fail("a colour is not a number: " + in_quotes(word));
    }
    row.value[k] = *value;
    const std::optional<std::int64_t> integer = parse_integer(word);
    whole_ = whole_ && integer && *integer >= 0 && *integer <= 255;
  }
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
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::copy_n(rows_[i].value.begin(), rows_[i].width, color.values.begin() + i * width_);
    without += rows_[i].width == 0 ? 1 : 0;
  }
  if (without > 0) {
    messages.push_back(std::to_string(without) + " of " + std::to_string(count) + " " + elements +
                       " without a colour made white");
  }
  attributes.push_back(std::move(color));
}

}  // namespace isorelax
