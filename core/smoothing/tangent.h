#pragma once

#include "smoothing/objective.h"

namespace isorelax {

/// What a vertex is on the frozen surface: one that may move in a plane goes over faces whatever it is.
inline VertexClass class_on_surface(const SmoothingProblem& problem, Index vertex) {
  return problem.mobility[vertex] == Mobility::line ? problem.classes.classes[vertex] : VertexClass::smooth;
}

/// What spans the tangent spaces of up to eight vertices from `first` on: the unit normal of a plane, the
/// unit direction of a line; unused where a vertex may not move. From the frozen surface where there
/// is one, else from the sums around each vertex (paper Sec. 3).
std::array<Vec3, kLanes> tangent_axes(const SmoothingProblem& problem, std::span<const Vec3> positions,
                                      Index first, std::span<const VertexSums> sums);

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

}  // namespace isorelax
