#pragma once

#include <span>
#include <string>
#include <string_view>

#include "render/colormap.h"
#include "render/legend.h"

namespace isorelax::render {

/// What faces are coloured by. The numbers themselves come from the caller.
enum class Quantity { min_angle, max_angle, area, energy };

/// "angle", "max-angle", "area", "energy", as on the command line; none is not among them.
std::string_view name_of(Quantity quantity);

/// How a quantity is shown when nobody chose otherwise. In every sequential map the brighter triangle is the
/// worse one; areas (relative to the mean) diverge from 1.
///   min_angle  degrees, 0..60, reversed viridis     max_angle  degrees, 60..180, viridis
///   area       of the mean, 1/m..m, logarithmic, m the largest deviation, 2..100
///   energy     least..greatest, logarithmic, viridis
/// `values`: one per triangle; NaN and infinite ones are passed over.
Coloring default_coloring(Quantity quantity, std::span<const double> values);

/// Title, unit and the words at the ends for a quantity; swatches for values outside coloring.range.
Legend make_legend(Quantity quantity, const Coloring& coloring, std::span<const double> values);

}  // namespace isorelax::render
