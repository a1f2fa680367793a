#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isorelax {
namespace {

/// Two unit squares that meet in a right angle along the y axis: vertices 0 and 1 on it.
TriangleMesh bent() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1},
                    {0, 1, 1}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {6, 7, 8}};
  return mesh;
}

Vec3 normal_of(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

TEST(Normals, OfVerticesFollowAMoveAndOthersKeepTheirBits) {
  TriangleMesh mesh = bent();
  Attribute stored{.name = "normal", .width = 3, .values = std::vector<double>(27, 0.123)};
  for (std::size_t v = 0; v < 9; ++v) stored.values[3 * v + 2] = 1;
  mesh.attributes.vertex = {stored};
  const std::vector<Vec3> before = mesh.positions;
  mesh.positions[3].z() = 1;  // triangles 0 and 1 turn
  EXPECT_EQ(refresh_normals(mesh, before), 4U);
  const std::vector<double>& now = mesh.attributes.vertex[0].values;
  EXPECT_NEAR(normal_of(now, 2).dot(Vec3(0, -1, 1) / std::sqrt(2)), 1, 1e-12);  // of triangle 0 alone
  EXPECT_NEAR(normal_of(now, 0).norm(), 1, 1e-12);
  for (const std::size_t v : {4, 5, 6, 7, 8}) EXPECT_EQ(normal_of(now, v), Vec3(0.123, 0.123, 1));
}

TEST(Normals, ThatPointedInwardStillDo) {
  TriangleMesh mesh = bent();
  Attribute stored{.name = "normal", .width = 3, .values = std::vector<double>(27, 0)};
  for (std::size_t v = 0; v < 9; ++v) stored.values[3 * v + 2] = -1;
  mesh.attributes.vertex = {stored};
  const std::vector<Vec3> before = mesh.positions;
  mesh.positions[2].x() = 2;
  refresh_normals(mesh, before);
  EXPECT_NEAR(normal_of(mesh.attributes.vertex[0].values, 2).z(), -1, 1e-12);
}

TEST(Normals, OfCornersStayApartAcrossACrease) {
  TriangleMesh mesh = bent();
  CornerAttribute stored{.name = "normal", .width = 3, .values = {0, 0, 1, 1, 0, 0}};
  stored.indices = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0};
  mesh.attributes.corner = {stored};
  const std::vector<Vec3> before = mesh.positions;
  mesh.positions[2].z() = mesh.positions[3].z() = 1;  // the first square tilts by 45 degrees
  EXPECT_EQ(refresh_normals(mesh, before), 6U);
  const CornerAttribute& now = mesh.attributes.corner[0];
  const Vec3 tilted = Vec3(-1, 0, 1) / std::sqrt(2);
  for (Corner c = 0; c < 6; ++c) EXPECT_NEAR(normal_of(now.values, now.indices[c]).dot(tilted), 1, 1e-12);
  for (Corner c = 6; c < 12; ++c) EXPECT_NEAR(normal_of(now.values, now.indices[c]).x(), 1, 1e-12);
  for (Corner c = 12; c < 15; ++c) EXPECT_EQ(normal_of(now.values, now.indices[c]), Vec3(0, 0, 1));
}

TEST(Normals, NoneStoredNoneMade) {
  TriangleMesh mesh = bent();
  const std::vector<Vec3> before = mesh.positions;
  mesh.positions[2].z() = 1;
  EXPECT_EQ(refresh_normals(mesh, before), 0U);
}

}  // namespace
}  // namespace isorelax
