#pragma once

#include <cstdint>

namespace isorelax {

/// A point on an integer grid. In the plane (z = 0) |coordinate differences| <= 2^30, in space <= 2^41:
/// then every sign below is exact.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// Sign of the area of (a, b, c) in the plane: +1 counter-clockwise, 0 on a line.
[[nodiscard]] int orient_plane(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// +1 when d lies inside the circle through the counter-clockwise triangle (a, b, c), 0 on it.
[[nodiscard]] int in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d);

/// +1 when d lies on the side of (a, b, c) from which the triangle is seen counter-clockwise, 0 in its plane.
[[nodiscard]] int orient_space(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                               const GridPoint& d);

}  // namespace isorelax
