#pragma once

#include <span>

#include "smoothing/newton_block.h"

namespace isorelax {

/// A linear bound on the move m of a vertex: gradient . m >= -slack.
struct MoveBound {
  Vec3 gradient;
  double slack;
};

/// The move in the block's tangent plane, within all bounds, where g . m - m . H m / 2 is largest; H is the
/// block, positive definite. Where rounding or negative slacks leave no move within all bounds, one that
/// keeps the later ones. By linear programming in two unknowns (Seidel 1991), with parabolas for lines.
[[nodiscard]] Vec3 best_move(const NewtonBlock& block, const Vec3& g, std::span<const MoveBound> bounds);

}  // namespace isorelax
