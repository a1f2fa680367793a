#pragma once

#include "smoothing/objective.h"

namespace isorelax {

/// V V^T g: the part of a vertex' gradient that lies in its tangent space (paper Eq. 8), from the sums around
/// it. Zero where it may not move.
Vec3 tangent_part(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                  const VertexSums& sums);

}  // namespace isorelax
