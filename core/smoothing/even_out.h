#pragma once

#include "smoothing/run.h"

namespace isorelax {

/// Every vertex goes to the mean of its neighbours, in its tangent space, twenty times over, and all that is
/// one step, without folds. Knows nothing of the energy, which it lowers most where triangles are very
/// uneven: then it costs a fraction of the steps that would do the same. Where the energy would rise, nothing
/// moves. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_even_out(const SmoothingProblem& problem, RecordDetail detail);

/// Whether the energy of a problem asks for even triangles: all references are the same, their shape counts
/// at least as much as their area, and no high power looks at the worst alone.
[[nodiscard]] bool wants_even(const SmoothingProblem& problem);

}  // namespace isorelax
