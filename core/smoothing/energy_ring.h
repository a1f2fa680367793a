#pragma once

#include <span>

#include "smoothing/newton_block.h"

namespace isorelax {

/// The treated triangles at one vertex as functions of where it is, its neighbours held. Keeps references.
class EnergyRing {
 public:
  /// What a Newton step is made from: the gradient and the second derivative, made positive definite, of the
  /// sum of E^p.
  struct Slope {
    Vec3 gradient = Vec3::Zero();
    Mat3 curvature = Mat3::Zero();
  };

  EnergyRing(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex)
      : p_(problem), x_(positions), v_(vertex) {}

  /// Sum of E^p with the vertex at `at`; infinite where a triangle has left the side it is on now.
  [[nodiscard]] double energy(const Vec3& at) const;
  [[nodiscard]] Slope slope(const Vec3& at) const;

 private:
  [[nodiscard]] std::array<Vec3, 3> corners(Corner c, const Vec3& at) const;

  const SmoothingProblem& p_;
  std::span<const Vec3> x_;
  Index v_;
};

/// The move of one vertex to the minimum of the sum of E^p over its own triangles, its neighbours held:
/// Newton's steps repeated, each shortened until the sum falls and no triangle folds. In the tangent space of
/// mobility and axis; close to a sliver one Newton step goes only a fraction of the way. Triangles that are
/// not treated do not count.
Vec3 move_to_local_minimum(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                           const Vec3& axis);

}  // namespace isorelax
