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

std::array<Vec3, kLanes> tangent_parts(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                       Index first, std::span<const VertexSums> sums) {
  std::array<Vec3, kLanes> normals;
  if (problem.plane_normal) {
    normals.fill(*problem.plane_normal);
  } else {
    CovarianceBatch batch{};
    for (unsigned i = 0; i < sums.size(); ++i) batch.set(i, sums[i].covariance);
    normals = dominant_eigenvectors(batch);
  }
  std::array<Vec3, kLanes> parts;
  for (unsigned i = 0; i < sums.size(); ++i) {
    const Vec3& g = sums[i].gradient;
    switch (problem.mobility[first + i]) {
      case Mobility::none:
        parts[i].setZero();
        break;
      case Mobility::line: {
        const Vec3 along = line_direction(problem, positions, first + i, sums[i].covariance);
        parts[i] = along * along.dot(g);
        break;
      }
      case Mobility::plane:
        parts[i] = g - normals[i] * normals[i].dot(g);
        break;
    }
  }
  return parts;
}

}  // namespace isorelax
