#pragma once

#include "smoothing/tangent.h"

namespace isorelax {

/// E over the sum of its weights, 2 for the best triangle, from which a triangle counts as a sliver.
inline constexpr double kSliverEnergy = 3;
/// Share of the area term's convex part that its second derivative never falls below: keeps a block solvable
/// where the triangles are so large that the term is concave.
inline constexpr double kLeastAreaCurvature = 0.05;

/// One vertex' tangent Hessian block, made positive definite, ready to be solved with.
struct NewtonBlock {
  Vec3 t1 = Vec3::Zero(), t2 = Vec3::Zero();  ///< orthonormal; t2 zero on a line, both where nothing may move
  double h11 = 0, h12 = 0, h22 = 0;

  NewtonBlock() = default;
  /// An empty block over the tangent space of this mobility and axis.
  NewtonBlock(Mobility mobility, const Vec3& axis);

  /// Adds a second derivative in space.
  void add(const Mat3& curvature) {
    h11 += t1.dot(curvature * t1);
    h12 += t1.dot(curvature * t2);
    h22 += t2.dot(curvature * t2);
  }
  /// Solves H d = g in the tangent space: g and the result are vectors in space. Zero where the block is.
  [[nodiscard]] Vec3 solve(const Vec3& g) const;
  /// The part of a vector in the tangent space.
  [[nodiscard]] Vec3 tangent(const Vec3& d) const { return t1 * t1.dot(d) + t2 * t2.dot(d); }
};

/// The blocks of a batch: sums of p E^(p-1) H + p (p-1) E^(p-2) g g^T over each vertex' triangles, with the
/// clamped blocks H of method Sec. 3. `here` is what the batch was
/// gathered from.
std::array<NewtonBlock, kLanes> newton_blocks(const SmoothingProblem& problem, const Objective& here,
                                              const TangentBatch& batch);

}  // namespace isorelax
