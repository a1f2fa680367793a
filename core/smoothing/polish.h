#pragma once

#include "smoothing/bounded_run.h"

namespace isorelax {

/// Makes the last stage: steps that raise the smallest angles themselves and lower the largest, the worst
/// triangles first, where the sum of energies would trade them for others.
///
/// Each step visits the vertices of the triangles whose smallest or largest angle is near the worst of the
/// mesh, the nearest first, and moves each to a higher soft minimum of the scores around it. The score of an
/// angle a is the lesser of a - m and obtuse_weight * (M - a), where m and M are the smallest and the largest
/// angle at the start of the triangles that can change: both get better, from wherever the stage starts. The
/// soft minimum gets sharper from stage to stage.
///
/// What can be had of both has a bound where a vertex of three triangles is next to one of four, in a plane:
/// whatever the positions, the smallest angle is at most 22.5 degrees and at most 1.5 times the largest less
/// 180 (add up the angles of the five triangles).
///
/// No angle gets worse than the worst at the start, no triangle turns over, and where the mean of the
/// triangles' smallest angles would fall by more than is allowed, fewer triangles are treated. Moves keep to
/// tangent spaces, borders, ridges and the frozen surface as all others do. Ends by moving nothing. Does not
/// depend on threads. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_polish(const SmoothingProblem& problem, const PolishOptions& options);

}  // namespace isorelax
