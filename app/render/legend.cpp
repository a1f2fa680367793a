#include "render/legend.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace isorelax::render {
namespace {

constexpr int kMostDecimals = 6;

std::string to_text(double value, std::chars_format format, int precision) {
  std::array<char, 64> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0 ? 0.0 : value,
                                    format, precision);
  return {buffer.data(), result.ptr};
}

/// Whether `decimals` show a number up to a share of the bar that nobody sees.
bool is_shown_by(double value, int decimals, double width) {
  const double unit = std::pow(10.0, -decimals);
  return std::abs(value - std::round(value / unit) * unit) <= 5e-3 * width;
}

/// A label for `value` in a range of a width.
std::string label(double value, int decimals, const Range& range) {
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  if (largest >= 1e6 || decimals > kMostDecimals) return to_text(value, std::chars_format::general, 3);
  return to_text(value, std::chars_format::fixed, decimals);
}

/// The smallest 1, 2 or 5 times a power of ten that is at least `step`.
double round_up_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<double> linear_values(const Range& range, int most) {
  std::vector<double> values;
  const double step = round_up_step((range.high - range.low) / (most - 1));
  for (double k = std::ceil(range.low / step); k * step < range.high; ++k) {
    values.push_back(k * step);
    if (k == k + 1) break;
  }
  return values;
}

std::vector<double> logarithmic_values(const Range& range, int most) {
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(std::log10(range.low)));
  const int last = static_cast<int>(std::ceil(std::log10(range.high)));
  const bool few_decades = 3 * (last - first) <= 2 * most;
  const int stride = std::max(1, (last - first) / std::max(1, most - 1));
  for (int decade = first; decade <= last; decade += stride)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor == 1.0 || few_decades) values.push_back(factor * std::pow(10.0, decade));
  return values;
}

/// Decimals at which the ends and a step of the bar are told apart.
int decimals_for(const Range& range, int most) {
  const double width = range.high - range.low;
  const double step = round_up_step(width / (most - 1));
  if (!(step > 0)) return kMostDecimals + 1;  // the smallest numbers have no halves
  int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  while (decimals <= kMostDecimals &&
         !(is_shown_by(range.low, decimals, width) && is_shown_by(range.high, decimals, width)))
    ++decimals;
  return decimals;
}

}  // namespace

std::vector<Tick> legend_ticks(const Coloring& coloring, int most) {
  const Range& range = coloring.range;
  if (!(range.low < range.high)) return {{0.5, to_text(range.low, std::chars_format::general, 4)}};
  const bool logarithmic = coloring.scale == ValueScale::logarithmic && range.high / range.low > 5;
  const int decimals = decimals_for(range, most);
  const auto text = [&](double value) {
    return logarithmic ? to_text(value, std::chars_format::general, 3) : label(value, decimals, range);
  };
  const double spacing = 0.6 / (most - 1);
  std::vector<Tick> ticks{{0, text(range.low)}};
  for (const double value : logarithmic ? logarithmic_values(range, most) : linear_values(range, most)) {
    const double position = position_in_range(coloring, value);
    if (position >= ticks.back().position + spacing && position <= 1 - spacing)
      ticks.push_back({position, text(value)});
  }
  ticks.push_back({1, text(range.high)});
  return ticks;
}

}  // namespace isorelax::render
