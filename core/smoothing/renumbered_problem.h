#pragma once

#include "smoothing/problem.h"

namespace isorelax {

/// The same problem under the numbers of its renumbering, which it must have: without the user's notes, and
/// without what was measured to tell classes.
[[nodiscard]] SmoothingProblem renumbered(const SmoothingProblem& problem);

}  // namespace isorelax
