#pragma once

#include <span>

#include "smoothing/problem.h"

namespace isorelax {

/// Whether `at` lies between the others on a straight line, but for rounding by so much.
[[nodiscard]] bool runs_straight(const Vec3& before, const Vec3& at, const Vec3& behind, double rounding);

/// Whether moves of a vertex change the outline of a mesh, here at `positions`: it is on the border, may
/// move, and not only along a straight stretch (whose ends stay).
[[nodiscard]] bool changes_outline(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                   Index vertex, double rounding);

}  // namespace isorelax
