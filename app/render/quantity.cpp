#include "render/quantity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isorelax::render {
namespace {

/// Areas further from the mean than this factor are grey: one speck must not wash out all others.
constexpr double kLargestAreaFactor = 100;

/// Least and greatest of the finite positive values; 1 and 1 when there are none.
Range positive_extremes(std::span<const double> values) {
  double low = std::numeric_limits<double>::max();
  double high = 0;
  for (const double v : values) {
    if (!std::isfinite(v) || v <= 0) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return high > 0 ? Range{low, high} : Range{1, 1};
}

Coloring area_coloring(std::span<const double> values) {
  const Range extremes = positive_extremes(values);
  const double factor = std::clamp(std::max(extremes.high, 1 / extremes.low), 2.0, kLargestAreaFactor);
  return {ColorMap::blue_orange, MapDirection::forward, ValueScale::logarithmic, {1 / factor, factor}};
}

}  // namespace

std::string_view name_of(Quantity quantity) {
  constexpr std::string_view kNames[] = {"angle", "max-angle", "area", "energy"};
  return kNames[static_cast<std::size_t>(quantity)];
}

Coloring default_coloring(Quantity quantity, std::span<const double> values) {
  switch (quantity) {
    case Quantity::min_angle:
      return {ColorMap::viridis, MapDirection::reversed, ValueScale::linear, {0, 60}};
    case Quantity::max_angle:
      return {ColorMap::viridis, MapDirection::forward, ValueScale::linear, {60, 180}};
    case Quantity::area:
      return area_coloring(values);
    case Quantity::energy:
      break;
  }
  return {ColorMap::viridis, MapDirection::forward, ValueScale::logarithmic, positive_extremes(values)};
}

Legend make_legend(Quantity quantity, const Coloring& coloring, std::span<const double> values) {
  Legend legend;
  legend.coloring = coloring;
  switch (quantity) {
    case Quantity::min_angle:
      legend.title = "Min angle";
      legend.unit = "°";
      legend.low_note = "worst";
      break;
    case Quantity::max_angle:
      legend.title = "Max angle";
      legend.unit = "°";
      legend.high_note = "worst";
      break;
    case Quantity::area:
      legend.title = "Area / mean";
      break;
    case Quantity::energy:
      legend.title = "Energy";
      legend.high_note = "worst";
      break;
  }
  // The extremes tell whether there are greys; colouring a million values to find out would not be free.
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const double v : values) {
    low = v < low ? v : low;
    high = v > high ? v : high;
    legend.shows_missing |= std::isnan(v);
  }
  if (low > high) return legend;
  legend.shows_below = color_of(coloring, low) == kBelowRange;
  legend.shows_above = color_of(coloring, high) == kAboveRange;
  return legend;
}

}  // namespace isorelax::render
