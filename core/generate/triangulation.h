#pragma once

#include <span>
#include <vector>

#include "generate/predicates.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Delaunay triangles of points in the plane (z is not looked at), counter-clockwise. Covers the convex hull;
/// points on the hull's edges are used. Incremental insertion with exact predicates; O(n log n) for points
/// spread evenly.
///
/// Throws UsageError when the points all lie on a line or two coincide.
[[nodiscard]] std::vector<Triangle> delaunay_triangles(std::span<const GridPoint> points);

/// The convex hull of points in space of which every one is a corner of the hull, counter-clockwise from
/// outside: exactly 2 n - 4 triangles.
///
/// Throws UsageError when fewer than four points span space, or one is no corner of the hull.
[[nodiscard]] std::vector<Triangle> hull_triangles(std::span<const GridPoint> points);

}  // namespace isorelax
