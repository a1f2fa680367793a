#pragma once

#include <limits>

#include "smoothing/bounded_run.h"

namespace isorelax {

/// The tolerance of a run of the last stage. It goes on after the smallest of moves, and ends by moving
/// nothing.
inline constexpr double kPolishTolerance = std::numeric_limits<double>::min();

/// Makes the last stage: steps that raise the smallest angles themselves and lower the largest, the worst
/// triangles first, where the sum of energies would trade them for others (PolishGoal::worst); steps that
/// raise the mean of the triangles' smallest angles, which that sum does not know (mean); or those after
/// these (both).
///
/// For the worst, each step visits the vertices of the triangles whose smallest or largest angle is near the
/// worst of the mesh, the nearest first, and moves each to a higher soft minimum of the scores around it. The
/// score of an angle a is the lesser of a - m and obtuse_weight * (M - a), where m and M are the smallest and
/// the largest angle at the start of the triangles that can change: both get better, from wherever the stage
/// starts. The soft minimum gets sharper from stage to stage. Where vertices one after another get no
/// farther, groups of them move together (GroupClimb).
///
/// What can be had of both has a bound where a vertex of three triangles is next to one of four, in a plane:
/// whatever the positions, the smallest angle is at most 22.5 degrees and at most 1.5 times the largest less
/// 180 (add up the angles of the five triangles).
///
/// Where the mean of the triangles' smallest angles would fall by more than is allowed, fewer triangles are
/// treated.
///
/// For the mean, each step visits all vertices in order and moves each to a higher sum of the soft minima of
/// the angles of each triangle around it, which get sharper from step to step.
///
/// The worst tenth of the triangles (PolishOptions::worst_share) gets no worse by that, and no other triangle
/// gets as bad.
///
/// No angle gets worse than the worst at the start of the goal, and no triangle turns over. Moves keep to
/// tangent spaces, borders, ridges and the frozen surface as all others do. Does not
/// depend on threads. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_polish(const SmoothingProblem& problem, const PolishOptions& options);

}  // namespace isorelax
