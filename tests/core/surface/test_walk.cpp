#include "surface/walk.h"

#include <gtest/gtest.h>

namespace isorelax {
namespace {

/// A square grid, of right angles throughout: where walks meet points that are as near to an edge as to its
/// end.
struct Grid {
  static constexpr Index kSide = 6;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;

  Grid() {
    for (Index j = 0; j <= kSide; ++j)
      for (Index i = 0; i <= kSide; ++i) positions.emplace_back(i, j, 0);
    for (Index j = 0; j < kSide; ++j) {
      for (Index i = 0; i < kSide; ++i) {
        const Index v = j * (kSide + 1) + i;
        triangles.push_back({v, v + 1, v + kSide + 2});
        triangles.push_back({v, v + kSide + 2, v + kSide + 1});
      }
    }
  }
};

TEST(Walk, OverAFlatGridEndsAtTheClosestPointFromEverywhere) {
  const Grid grid;
  const Topology topology(grid.triangles, static_cast<Index>(grid.positions.size()));
  const ClosestPointIndex index(grid.positions, grid.triangles);
  for (int i = -2; i <= 14; ++i) {
    for (int j = -2; j <= 14; ++j) {
      const Vec3 point(0.5 * i + 1e-17, 0.5 * j, 0.25);
      const auto foot = [&](Index t) {
        return closest_point_of_triangle(point, grid.positions, grid.triangles, t);
      };
      const double best = index.closest(point).distance;
      for (Index start = 0; start < grid.triangles.size(); ++start) {
        const SurfacePoint found = walk_nearer(
            foot(start), foot, [&](Corner c) { return topology.opposite(c); },
            [&](Corner c) { return topology.corners_of(grid.triangles[c / 3][c % 3]); });
        EXPECT_NEAR(found.distance, best, 1e-12) << point.transpose() << " from triangle " << start;
      }
    }
  }
}

}  // namespace
}  // namespace isorelax
