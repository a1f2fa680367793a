#pragma once

#include "smoothing/run.h"

namespace isorelax {

/// What `make` makes for the problem; where the problem has a renumbering, for a copy under those numbers,
/// with records under the problem's own.
[[nodiscard]] std::unique_ptr<Smoother> make_near_in_memory(const SmoothingProblem& problem,
                                                            const SmootherFactory& make);

}  // namespace isorelax
