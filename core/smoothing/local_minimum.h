#pragma once

#include "smoothing/problem.h"

namespace isorelax {

/// The move of one vertex to the minimum of the sum of E^p over its own triangles, its neighbours held:
/// Newton's steps repeated, each shortened until the sum falls and no triangle folds. In the tangent space of
/// mobility and axis; close to a sliver one Newton step goes only a fraction of the way. Triangles that are
/// not treated do not count.
Vec3 move_to_local_minimum(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                           const Vec3& axis);

}  // namespace isorelax
