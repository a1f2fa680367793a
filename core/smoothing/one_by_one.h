#pragma once

#include "smoothing/run.h"

namespace isorelax {

/// Steps for where many vertices are at the limit of the distance: all move one after another, each downhill
/// in the energy of its own triangles as they are by then, and along what holds it back. Moves that were
/// found for all at once break off there, for no vertex knows what another one is held to. On one thread.
std::unique_ptr<Smoother> make_one_by_one(const SmoothingProblem& problem, RecordDetail detail);

}  // namespace isorelax
