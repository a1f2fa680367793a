#include <gtest/gtest.h>

#include "motion/material_point.h"

namespace isorelax {
namespace {

/// Two triangles of the unit square.
struct Square {
  std::vector<Vec3> x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  Topology topology{triangles, 4};
};

TEST(MaterialSurface, AWalkGoesStraightOnOverAnEdge) {
  const Square square;
  const MaterialSurface surface(square.x, square.triangles, square.topology, {});
  const MaterialPoint from{0, Vec3(0.2, 0.6, 0.2)};  // (0.8, 0.2)
  const Vec3 way(-0.6, 0.3, 0);
  const auto& frame = surface.frame(0);
  const MaterialPoint to = surface.walk(from, {way.dot(frame[0]), way.dot(frame[1])});
  EXPECT_EQ(to.triangle, 1U);
  EXPECT_LT((surface.point(to) - Vec3(0.2, 0.5, 0)).norm(), 1e-14);
}

TEST(MaterialSurface, AWalkUnfoldsTheTriangleBeyondABentEdge) {
  Square square;
  square.x[3] = Vec3(0.5, 0.5, std::sqrt(0.5));  // the second triangle stands upright
  const MaterialSurface surface(square.x, square.triangles, square.topology, {});
  const MaterialPoint from{0, Vec3(0.25, 0.5, 0.25)};
  const double height = (surface.point(from) - Vec3(0.5, 0.5, 0)).norm();
  const Vec3 way = (Vec3(0.5, 0.5, 0) - surface.point(from)).normalized() * (height + 0.3);
  const auto& frame = surface.frame(0);
  const MaterialPoint to = surface.walk(from, {way.dot(frame[0]), way.dot(frame[1])});
  EXPECT_EQ(to.triangle, 1U);
  EXPECT_LT((surface.point(to) - Vec3(0.5, 0.5, 0.3)).norm(), 1e-14);
}

TEST(MaterialSurface, AWalkEndsAtABorderAndAtAWall) {
  const Square square;
  EdgeWalls walls(6, 0);
  walls[1] = walls[5] = 1;  // the diagonal
  const MaterialSurface open(square.x, square.triangles, square.topology, {});
  const MaterialSurface cut(square.x, square.triangles, square.topology, walls);
  const MaterialPoint from{0, Vec3(0.2, 0.6, 0.2)};
  const auto& frame = open.frame(0);
  const auto go = [&](const MaterialSurface& surface, const Vec3& way) {
    return surface.point(surface.walk(from, {way.dot(frame[0]), way.dot(frame[1])}));
  };
  EXPECT_LT((go(open, Vec3(0, -5, 0)) - Vec3(0.8, 0, 0)).norm(), 1e-14);
  EXPECT_LT((go(cut, Vec3(-0.6, 0.0, 0)) - Vec3(0.2, 0.2, 0)).norm(), 1e-14);
  EXPECT_LT((go(open, Vec3(-0.7, 0.0, 0)) - Vec3(0.1, 0.2, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace isorelax
