#pragma once

#include "smoothing/bounded_run.h"

namespace isorelax {

/// Makes the last stage: steps that raise the smallest angles themselves and lower the largest, the worst
/// triangles first, where the sum of energies would trade them for others.
///
/// Each step visits the vertices of the triangles whose score is near the worst, in the order of their
/// scores, and moves each to a higher soft minimum of the scores around it; the score of an angle a is the
/// lesser of a and obtuse_share * (180 - a). The soft minimum gets sharper from stage to stage. No angle gets
/// worse than the worst at the start, no triangle turns over, and where the mean of the triangles' smallest
/// angles would fall by more than is allowed, fewer triangles are treated. Moves keep to tangent spaces,
/// borders, ridges and the frozen surface as all others do. Ends by moving nothing. Does not depend on
/// threads. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_polish(const SmoothingProblem& problem, const PolishOptions& options);

}  // namespace isorelax
