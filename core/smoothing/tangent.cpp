#include "smoothing/tangent.h"

#include <algorithm>

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
  return problem.mobility[vertex] == Mobility::line ? problem.anchors[vertex].edge != kNone
                                                    : !problem.plane_normal;
}

}  // namespace

Vec3 tangent_axis(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex) {
  if (follows_surface(problem, vertex)) {
    return problem.surface->tangent_axis(positions[vertex], class_on_surface(problem, vertex),
                                         problem.anchors[vertex]);
  }
  const bool on_line = problem.mobility[vertex] == Mobility::line;
  if (problem.plane_normal && !on_line) return *problem.plane_normal;
  const SymmetricMatrix covariance =
      normal_covariance(positions, problem.triangles, problem.topology, vertex);
  return on_line ? line_direction(problem, positions, vertex, covariance)
                 : Vec3(decompose(covariance).vectors.col(0));
}

void TangentSweep::gather(const Objective& here, std::span<const Vec3> positions, TangentBatch& batch) const {
  for (unsigned i = 0; i < batch.count; ++i) batch.sums[i] = here.gather(batch.vertices[i]);
  if (problem_.plane_normal) {
    batch.axes.fill(*problem_.plane_normal);
  } else if (!problem_.surface) {
    CovarianceBatch covariances{};
    for (unsigned i = 0; i < batch.count; ++i) covariances.set(i, batch.sums[i].covariance);
    batch.axes = dominant_eigenvectors(covariances);
  } else {
    batch.axes.fill(Vec3::Zero());
  }
  for (unsigned i = 0; i < batch.count; ++i) {
    const Index v = batch.vertices[i];
    const Mobility mobility = problem_.mobility[v];
    if (follows_surface(problem_, v)) {
      batch.axes[i] =
          problem_.surface->tangent_axis(positions[v], class_on_surface(problem_, v), problem_.anchors[v]);
    } else if (mobility == Mobility::line) {
      batch.axes[i] = line_direction(problem_, positions, v, batch.sums[i].covariance);
    }
    batch.gradients[i] = tangent_part(mobility, batch.axes[i], batch.sums[i].gradient);
  }
}

double TangentSweep::norm() const {
  double squares = 0;
  for (const double partial : partials_) squares += partial;
  return std::sqrt(squares);
}

}  // namespace isorelax
