#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "render/color.h"

namespace isorelax::render {

/// Perceptually uniform colour maps; blue_orange is diverging, the others go from dark to bright.
enum class ColorMap { viridis, cividis, inferno, magma, blue_orange };
inline constexpr std::array kColorMaps = {ColorMap::viridis, ColorMap::cividis, ColorMap::inferno,
                                          ColorMap::magma, ColorMap::blue_orange};

/// "viridis", ..., "blue-orange".
std::string_view name_of(ColorMap map);
/// The inverse. Throws UsageError listing the names.
ColorMap parse_color_map(std::string_view text);

/// The map's 256 colours, lowest first.
std::span<const Color, 256> colors_of(ColorMap map);

enum class MapDirection { forward, reversed };
constexpr MapDirection opposite(MapDirection direction) {
  return direction == MapDirection::forward ? MapDirection::reversed : MapDirection::forward;
}
enum class ValueScale { linear, logarithmic };

struct Range {
  double low = 0;
  double high = 1;

  friend bool operator==(const Range&, const Range&) = default;
};

/// How a number becomes a colour. Logarithmic scales need range.low > 0.
struct Coloring {
  ColorMap map = ColorMap::viridis;
  MapDirection direction = MapDirection::forward;
  ValueScale scale = ValueScale::linear;
  Range range;

  friend bool operator==(const Coloring&, const Coloring&) = default;
};

/// Outside the range: greys that no map contains. No number at all: a blue-grey.
inline constexpr Color kBelowRange{92, 92, 92};
inline constexpr Color kAboveRange{196, 196, 196};
inline constexpr Color kNoValue{118, 128, 142};
/// The backs of faces, as shaders/mesh.frag mixes it into their colours.
inline constexpr Color kBackColor{143, 23, 51};

/// 0 at the low end of the range, 1 at the high end, outside of [0, 1] beyond them. A range of no width puts
/// its own value in the middle.
double position_in_range(const Coloring& coloring, double value);

/// Colour at a position in [0, 1] of the range, interpolated, direction applied.
Color color_at(const Coloring& coloring, double position);

/// Colour of a value; greys outside the range, kNoValue for NaN.
Color color_of(const Coloring& coloring, double value);

}  // namespace isorelax::render
