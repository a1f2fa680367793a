#include "render/colormap.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "mesh/error.h"
#include "render/embedded.h"

namespace isorelax::render {
namespace {

constexpr std::string_view kNames[] = {"viridis", "cividis", "inferno", "magma", "blue-orange"};
using Table = std::array<Color, 256>;

/// 256 lines of three numbers from 0 to 1.
Table parse_table(std::string_view name) {
  const std::string_view text = embedded_file(std::string(name) + ".txt");
  const char* at = text.data();
  const char* const end = at + text.size();
  Table table;
  for (Color& color : table) {
    std::uint8_t* const channels[] = {&color.red, &color.green, &color.blue};
    for (std::uint8_t* channel : channels) {
      while (at != end && (*at == ' ' || *at == '\n')) ++at;
      double value = 0;
      const auto [rest, status] = std::from_chars(at, end, value);
      if (status != std::errc()) throw std::logic_error("colour map " + std::string(name) + " is damaged");
      *channel = static_cast<std::uint8_t>(std::lround(255 * value));
      at = rest;
    }
  }
  return table;
}

const Table& table_of(ColorMap map) {
  static const std::array<Table, kColorMaps.size()> tables = [] {
    std::array<Table, kColorMaps.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = parse_table(kNames[i]);
    return all;
  }();
  return tables[static_cast<std::size_t>(map)];
}

}  // namespace

std::string_view name_of(ColorMap map) {
  return kNames[static_cast<std::size_t>(map)];
}

ColorMap parse_color_map(std::string_view text) {
  std::string all;
  for (const ColorMap map : kColorMaps) {
    if (text == name_of(map)) return map;
    all += (all.empty() ? "" : ", ") + std::string(name_of(map));
  }
  throw UsageError("colour map '" + std::string(text) + "' is unknown: give one of " + all);
}

std::span<const Color, 256> colors_of(ColorMap map) {
  return table_of(map);
}

double position_in_range(const Coloring& coloring, double value) {
  double low = coloring.range.low;
  double high = coloring.range.high;
  if (coloring.scale == ValueScale::logarithmic && value > 0) {
    low = std::log(low);
    high = std::log(high);
    value = std::log(value);
  } else if (coloring.scale == ValueScale::logarithmic && !std::isnan(value)) {
    return -1;
  }
  if (low == high && value == low) return 0.5;
  if (low == high) return value < low ? -1 : 2;
  return (value - low) / (high - low);
}

Color color_at(const Coloring& coloring, double position) {
  const double oriented = coloring.direction == MapDirection::reversed ? 1 - position : position;
  const double entry = 255 * std::clamp(oriented, 0.0, 1.0);
  const auto below = static_cast<std::size_t>(entry);
  const Table& table = table_of(coloring.map);
  return mix(table[below], table[std::min<std::size_t>(below + 1, 255)], entry - static_cast<double>(below));
}

Color color_of(const Coloring& coloring, double value) {
  if (std::isnan(value)) return kNoValue;
  const double position = position_in_range(coloring, value);
  // Ends that were rounded when the range was computed or typed still belong to it.
  constexpr double kSlack = 1e-9;
  if (position < -kSlack) return kBelowRange;
  if (position > 1 + kSlack) return kAboveRange;
  return color_at(coloring, position);
}

}  // namespace isorelax::render
