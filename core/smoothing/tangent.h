#pragma once

#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "smoothing/objective.h"

namespace isorelax {

/// What a vertex is on the frozen surface: one that may move in a plane goes over faces whatever it is.
inline VertexClass class_on_surface(const SmoothingProblem& problem, Index vertex) {
  return problem.mobility[vertex] == Mobility::line ? problem.classes.classes[vertex] : VertexClass::smooth;
}

/// V V^T g (paper Eq. 8): the part of `g` in the tangent space of this mobility and axis.
inline Vec3 tangent_part(Mobility mobility, const Vec3& axis, const Vec3& g) {
  switch (mobility) {
    case Mobility::none:
      return Vec3::Zero();
    case Mobility::line:
      return axis * axis.dot(g);
    case Mobility::plane:
      break;
  }
  return g - axis * axis.dot(g);
}

/// What spans the tangent space of one vertex that may move: as TangentBatch::axes.
Vec3 tangent_axis(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex);

/// Gradients and tangent spaces of up to eight vertices.
struct TangentBatch {
  std::array<Index, kLanes> vertices{};
  unsigned count = 0;
  std::array<VertexSums, kLanes> sums;
  /// What spans the tangent space: the unit normal of a plane, the unit direction of a line; unused where a
  /// vertex may not move. From the frozen surface where there is one, else from the sums around each vertex
  /// (paper Sec. 3).
  std::array<Vec3, kLanes> axes;
  std::array<Vec3, kLanes> gradients;  ///< their parts in the tangent space
};

/// Visits all vertices in batches, with what every way of stepping starts from.
class TangentSweep {
 public:
  /// Keeps a reference to the problem.
  explicit TangentSweep(const SmoothingProblem& problem)
      : problem_(problem), partials_(block_count(problem.vertex_count())) {}

  /// Calls body(batch) for all vertices, on several threads: the body writes only what belongs to the batch'
  /// vertices. Returns the 2-norm of the tangent gradient. `here` is evaluated at `positions`.
  template <typename Body>
  double run(const Objective& here, std::span<const Vec3> positions, const Body& body) {
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double squares = 0;
      TangentBatch batch;
      for (std::size_t first = begin; first < end; first += kLanes) {
        batch.count = static_cast<unsigned>(std::min<std::size_t>(kLanes, end - first));
        for (unsigned i = 0; i < batch.count; ++i) batch.vertices[i] = static_cast<Index>(first + i);
        gather(here, positions, batch);
        for (unsigned i = 0; i < batch.count; ++i) squares += batch.gradients[i].squaredNorm();
        body(std::as_const(batch));
      }
      partials_[begin / kBlockSize] = squares;
    });
    return norm();
  }

  /// The gradients of all vertices and what spans their tangent spaces. Returns the same norm.
  double find_tangents(const Objective& here, std::span<const Vec3> positions, std::span<Vec3> gradients,
                       std::span<Vec3> axes) {
    return run(here, positions, [&](const TangentBatch& batch) {
      for (unsigned i = 0; i < batch.count; ++i) {
        gradients[batch.vertices[i]] = batch.sums[i].gradient;
        axes[batch.vertices[i]] = batch.axes[i];
      }
    });
  }

 private:
  void gather(const Objective& here, std::span<const Vec3> positions, TangentBatch& batch) const;
  [[nodiscard]] double norm() const;

  const SmoothingProblem& problem_;
  std::vector<double> partials_;
};

}  // namespace isorelax
