#include <array>
#include <string>

#include "mesh/error.h"
#include "render/picture_size.h"
#include "view/view.h"

namespace isorelax::view {
namespace {

constexpr std::array<std::string_view, 6> kColors{"none", "angle", "max-angle", "area", "energy", "class"};

}  // namespace

std::string_view name_of(ColorBy color) {
  return kColors[static_cast<std::size_t>(color)];
}

ColorBy parse_color(std::string_view text) {
  for (std::size_t i = 0; i < kColors.size(); ++i)
    if (text == kColors[i]) return static_cast<ColorBy>(i);
  throw UsageError("colour '" + std::string(text) +
                   "' is unknown: give angle, max-angle, area, energy, class or none");
}

RangeChoice parse_range_choice(std::string_view text) {
  if (text == "run") return {RangeRule::run, {}};
  if (text == "current") return {RangeRule::current, {}};
  return {RangeRule::ends, render::parse_range(text)};
}

}  // namespace isorelax::view
