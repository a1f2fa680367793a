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

/// Whether a vertex takes its tangent space from the frozen surface that its moves are brought back to.
bool follows_surface(const SmoothingProblem& problem, Index vertex) {
  if (!problem.surface || problem.mobility[vertex] == Mobility::none) return false;
  return problem.mobility[vertex] == Mobility::line ? problem.surface->anchor(vertex).edge != kNone
                                                    : !problem.plane_normal;
}

}  // namespace

std::array<Vec3, kLanes> tangent_axes(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                      Index first, std::span<const VertexSums> sums) {
  std::array<Vec3, kLanes> axes;
  if (problem.plane_normal) {
    axes.fill(*problem.plane_normal);
  } else if (!problem.surface) {
    CovarianceBatch batch{};
    for (unsigned i = 0; i < sums.size(); ++i) batch.set(i, sums[i].covariance);
    axes = dominant_eigenvectors(batch);
  }
  for (unsigned i = 0; i < sums.size(); ++i) {
    const Index v = first + i;
    if (follows_surface(problem, v)) {
      axes[i] = problem.surface->tangent_axis(positions[v], class_on_surface(problem, v),
                                              problem.surface->anchor(v));
    } else if (problem.mobility[v] == Mobility::line) {
      axes[i] = line_direction(problem, positions, v, sums[i].covariance);
    }
  }
  return axes;
}

}  // namespace isorelax
