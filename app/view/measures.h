#pragma once

#include <span>
#include <vector>

#include "view/view.h"

namespace isorelax::view {

/// What a view colours by, one number per triangle: degrees, areas over their mean, energies (infinite where
/// there is no area). Empty for ColorBy::none and ColorBy::classes. Reads the reference's file. Throws
/// UsageError, InputError, MeshError.
[[nodiscard]] std::vector<double> measure(ColorBy color, const EnergyTerms& energy,
                                          std::span<const Vec3> positions,
                                          std::span<const Triangle> triangles);

/// Now minus then, triangle by triangle; no number where either has none.
[[nodiscard]] std::vector<double> change(std::span<const double> now, std::span<const double> then);

/// Whether a value is worse than View::only_worse_than. Precondition: the view colours by numbers.
[[nodiscard]] bool is_worse(const View& view, double value);

}  // namespace isorelax::view
