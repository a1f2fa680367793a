#pragma once

#include <algorithm>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Area over squared longest edge at and under which a triangle has no area: its height is at the rounding
/// error of its coordinates.
inline constexpr double kDegenerateArea = 1e-14;

/// The rule for a triangle of which twice the area and the squared longest edge are known. Not-a-number
/// counts as no area.
inline bool has_no_area(double twice_area, double longest_squared) {
  return !(0.5 * twice_area > kDegenerateArea * longest_squared);
}

/// The same from the corners; sound for coordinates of any size.
inline bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 u = b - a;
  Vec3 v = c - a;
  const double size = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  if (!(size > 0)) return true;
  u /= size;
  v /= size;
  return has_no_area(u.cross(v).norm(), std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()}));
}

}  // namespace isorelax
