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

Vec3 tangent_part(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                  const VertexSums& sums) {
  switch (problem.mobility[vertex]) {
    case Mobility::none:
      return Vec3::Zero();
    case Mobility::line: {
      const Vec3 along = line_direction(problem, positions, vertex, sums.covariance);
      return along * along.dot(sums.gradient);
    }
    case Mobility::plane:
      break;
  }
  const Vec3 normal = problem.plane_normal ? *problem.plane_normal : dominant_eigenvector(sums.covariance);
  return sums.gradient - normal * normal.dot(sums.gradient);
}

}  // namespace isorelax
