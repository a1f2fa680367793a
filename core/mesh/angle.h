#pragma once

#include <cmath>
#include <numbers>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Degrees in a radian.
inline constexpr double kDegrees = 180 / std::numbers::pi;

/// Angle between two vectors of any length, in radians from 0 to pi; exact to rounding for small and flat
/// angles too. Zero where one of them is zero.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

inline double angle_between_deg(const Vec3& a, const Vec3& b) {
  return angle_between(a, b) * kDegrees;
}

}  // namespace isorelax
