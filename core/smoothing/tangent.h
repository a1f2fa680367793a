#pragma once

#include "smoothing/objective.h"

namespace isorelax {

/// V V^T g for up to eight vertices: the part of each gradient that lies in its vertex' tangent space (paper
/// Eq. 8), from the sums around it. Zero where a vertex may not move.
std::array<Vec3, kLanes> tangent_parts(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                       Index first, std::span<const VertexSums> sums);

}  // namespace isorelax
