#include "smoothing/tangent.h"

namespace isorelax {
namespace {

/// Unit direction of the only line a ridge or a sliding boundary vertex may move along.
Vec3 line_direction(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                    const SymmetricMatrix& covariance) {
  if (problem.topology.is_boundary(vertex)) {
    const auto& ends = problem.border.at(vertex);
    return (positions[ends[1]] - positions[ends[0]]).normalized();
  }
  return decompose(covariance).vectors.col(2);
}

}  // namespace

std::array<Vec3, kLanes> tangent_axes(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                      Index first, std::span<const VertexSums> sums) {
  std::array<Vec3, kLanes> axes;
  if (problem.plane_normal) {
    axes.fill(*problem.plane_normal);
  } else {
    CovarianceBatch batch{};
    for (unsigned i = 0; i < sums.size(); ++i) batch.set(i, sums[i].covariance);
    axes = dominant_eigenvectors(batch);
  }
  for (unsigned i = 0; i < sums.size(); ++i) {
    if (problem.mobility[first + i] == Mobility::line) {
      axes[i] = line_direction(problem, positions, first + i, sums[i].covariance);
    }
  }
  return axes;
}

}  // namespace isorelax
