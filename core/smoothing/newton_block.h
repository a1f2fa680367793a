#pragma once

#include "smoothing/objective.h"

namespace isorelax {

/// One vertex' tangent Hessian block, made positive definite, ready to be solved with.
class NewtonBlock {
 public:
  /// Sums p E^(p-1) H + p (p-1) E^(p-2) g g^T over the vertex' triangles, with the clamped blocks H of method
  /// Sec. 3, in the tangent space given by mobility and axis. `here` is evaluated at `positions`.
  NewtonBlock(const SmoothingProblem& problem, const Objective& here, std::span<const Vec3> positions,
              Index vertex, const Vec3& axis);

  /// Solves H d = g in the tangent space: g and the result are vectors in space. Zero where the block is.
  [[nodiscard]] Vec3 solve(const Vec3& g) const;

 private:
  void add(const SmoothingProblem& problem, const Objective& here, std::span<const Vec3> positions,
           Corner corner);

  Vec3 t1_ = Vec3::Zero(), t2_ = Vec3::Zero();  // orthonormal; t2_ zero on a line
  double h11_ = 0, h12_ = 0, h22_ = 0;
};

}  // namespace isorelax
