#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "mesh/error.h"
#include "render/quantity.h"
#include "view/scene.h"

namespace isorelax::view {
namespace {

using render::Quantity;

Quantity quantity_of(ColorBy color) {
  switch (color) {
    case ColorBy::max_angle:
      return Quantity::max_angle;
    case ColorBy::area:
      return Quantity::area;
    case ColorBy::energy:
      return Quantity::energy;
    default:
      return Quantity::min_angle;
  }
}

/// Least and greatest finite value; nothing when there are none.
std::optional<render::Range> extremes(std::span<const double> values) {
  render::Range range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    range.low = std::min(range.low, v);
    range.high = std::max(range.high, v);
  }
  if (range.low > range.high) return {};
  return range;
}

/// Blue is better and orange is worse; 0 is in the middle.
render::Coloring difference_coloring(ColorBy color, std::span<const double> values) {
  const render::Range found = extremes(values).value_or(render::Range{0, 0});
  double most = std::max(std::abs(found.low), std::abs(found.high));
  if (!(most > 0)) most = 1;
  const auto direction =
      color == ColorBy::min_angle ? render::MapDirection::reversed : render::MapDirection::forward;
  return {render::ColorMap::blue_orange, direction, render::ValueScale::linear, {-most, most}};
}

render::Coloring own_coloring(const View& view, std::span<const double> values) {
  if (view.difference) return difference_coloring(view.color, values);
  render::Coloring coloring = render::default_coloring(quantity_of(view.color), values);
  const bool angle = view.color == ColorBy::min_angle || view.color == ColorBy::max_angle;
  if (view.range.rule == RangeRule::current && angle)
    if (const auto found = extremes(values)) coloring.range = *found;
  return coloring;
}

/// The title says that the numbers are changes, the ends which of them is bad.
void say_difference(render::Legend& legend, ColorBy color) {
  if (!legend.title.empty()) legend.title[0] = static_cast<char>(std::tolower(legend.title[0]));
  legend.title = "Change of " + legend.title;
  legend.low_note.clear();
  legend.high_note.clear();
  if (color == ColorBy::min_angle) legend.low_note = "worse";
  if (color == ColorBy::max_angle || color == ColorBy::energy) legend.high_note = "worse";
}

}  // namespace

render::Coloring coloring_of(const View& view, std::span<const double> values) {
  if (view.color == ColorBy::none || view.color == ColorBy::classes) return {};
  render::Coloring coloring = own_coloring(view, values);
  if (view.range.rule == RangeRule::ends) coloring.range = view.range.ends;
  if (coloring.range.low <= 0) coloring.scale = render::ValueScale::linear;
  if (view.color_map) coloring.map = *view.color_map;
  if (view.reversed) coloring.direction = opposite(coloring.direction);
  return coloring;
}

render::Legend legend_of(const View& view, const render::Coloring& coloring, std::span<const double> values,
                         std::size_t inverted) {
  if (view.color == ColorBy::classes) {
    render::Legend legend;
    legend.title = "Features";
    legend.kinds = {{kCreaseColor, "ridge"},
                    {kBorderColor, "boundary"},
                    {kRidgeVertexColor, "ridge vertex"},
                    {kCornerColor, "corner"}};
    return legend;
  }
  render::Legend legend = render::make_legend(quantity_of(view.color), coloring, values);
  if (view.difference) say_difference(legend, view.color);
  // Between triangles that were left out, backs are not marked.
  legend.shows_backs = inverted > 0 && !view.only_worse_than;
  return legend;
}

}  // namespace isorelax::view
