#pragma once

#include <algorithm>

namespace isorelax {

/// A bound, and where on the way it is.
struct LineBound {
  double share = 0;  ///< of the way from a to b
  double distance = 0;
};

/// A bound on the distances to a surface along the way from a to b. The distance to any one triangle is
/// convex along it: the triangle nearest to a allows distances from `at_a` to `a_at_b`, the one nearest to b
/// from `b_at_a` to `at_b`, and the surface is no farther than either.
inline LineBound bound_between(double at_a, double a_at_b, double b_at_a, double at_b) {
  const LineBound ends = at_a < at_b ? LineBound{1, at_b} : LineBound{0, at_a};
  const double left = b_at_a - at_a;
  const double right = a_at_b - at_b;
  if (!(left > 0 && right > 0)) return ends;
  const double share = left / (left + right);
  const double crossing = at_a + share * (a_at_b - at_a);
  return crossing > ends.distance ? LineBound{share, crossing} : ends;
}

}  // namespace isorelax
