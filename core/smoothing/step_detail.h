#pragma once

#include <span>

#include "smoothing/objective.h"

namespace isorelax {

/// Notes in a record what the energy is made of: K, S and E of each triangle where `here` was evaluated last.
void record_triangles(const Objective& here, StepRecord& record);

/// Begins the detail of a record with what its proposal was made from: each vertex' tangent space, the
/// gradient's part in it, and the move proposed. The rounds of control are noted as they are made. `here` is
/// evaluated at `positions`. Precondition: the record has its displacement.
void record_stages(const SmoothingProblem& problem, const Objective& here, std::span<const Vec3> positions,
                   StepRecord& record);

}  // namespace isorelax
