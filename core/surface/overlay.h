#pragma once

#include <optional>

#include "surface/surface_distance.h"

namespace isorelax {

/// A point of a triangle that may be farther than `enough` from a surface; none where it is shown that no
/// point is. The triangle is cut along the surface's edges, from the surface's triangle `near` on: the
/// distance from a piece to the triangle that it lies over is convex, largest at a corner. Each cut is by the
/// plane that halves the angle between two triangles, from where both are equally far: so the point mostly is
/// as far as it seems. The centre where it comes to too many pieces.
[[nodiscard]] std::optional<Vec3> point_beyond(double enough, const std::array<Vec3, 3>& corners,
                                               const IndexedSurface& surface, Index near);

}  // namespace isorelax
