#pragma once

#include "smoothing/run.h"

namespace isorelax {

/// Lets a free border slide first, as long as that gains something, and leave its outline after that:
/// vertices that leave it early are held by the limit of the distance before their neighbours came along. A
/// border that has left its outline already only moves freely. `make` makes the steps of both. The same as
/// `make` itself where the problem has no border that could slide. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_slide_first(const SmoothingProblem& problem, const SmootherFactory& make);

}  // namespace isorelax
