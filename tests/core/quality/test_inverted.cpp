#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "quality/inverted.h"

namespace isorelax {
namespace {

std::vector<Index> inverted(const TriangleMesh& mesh) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  return inverted_triangles(mesh.positions, mesh.triangles, topology);
}

/// Six triangles around vertex 0, ring radius 1; `bulge` lifts the middle out of the plane.
TriangleMesh hexagon(double bulge) {
  TriangleMesh mesh;
  mesh.positions.emplace_back(0, 0, bulge);
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::atan(1.0) * 4 / 3;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (Index k = 0; k < 6; ++k) mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % 6});
  return mesh;
}

/// The hexagon within a second ring of radius 2, so that its triangles have neighbours outward too.
TriangleMesh two_rings(double bulge) {
  TriangleMesh mesh = hexagon(bulge);
  for (Index k = 1; k <= 6; ++k) {
    Vec3 outer = 2 * mesh.positions[k];
    outer.z() = -2 * bulge;
    mesh.positions.push_back(outer);
  }
  for (Index k = 0; k < 6; ++k) {
    const Index a = 1 + k;
    const Index b = 1 + (k + 1) % 6;
    mesh.triangles.push_back({a, a + 6, b + 6});
    mesh.triangles.push_back({a, b + 6, b});
  }
  return mesh;
}

TriangleMesh cube(const Vec3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2) * size.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(Inverted, PlanarMeshNamesTheTriangleThatAMovedVertexTurnedOver) {
  TriangleMesh mesh = hexagon(0);
  EXPECT_TRUE(inverted(mesh).empty());
  mesh.positions[0] = Vec3(0, 1.2, 0);  // over the edge from ring vertex 2 to 3
  EXPECT_EQ(inverted(mesh), std::vector<Index>{1});
}

TEST(Inverted, PlanarMeshMayFaceAnyWay) {
  TriangleMesh mesh = hexagon(0);
  mesh.positions[0] = Vec3(0, 1.2, 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& p : mesh.positions) p = turn * p + Vec3(5, 5, 5);
  EXPECT_EQ(inverted(mesh), std::vector<Index>{1});
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(inverted(mesh), std::vector<Index>{1});
}

TEST(Inverted, CurvedSurfaceNamesTheTriangleThatIsFoldedOver) {
  TriangleMesh mesh = two_rings(0.05);
  EXPECT_TRUE(inverted(mesh).empty());
  mesh.positions[0] = Vec3(0, 1.2, 0);
  EXPECT_EQ(inverted(mesh), std::vector<Index>{1});
}

TEST(Inverted, SharpButSoundSurfacesHaveNone) {
  EXPECT_TRUE(inverted(cube({1, 1, 1})).empty());
  EXPECT_TRUE(inverted(cube({1, 1, 1e-4})).empty());     // a thin plate
  EXPECT_TRUE(inverted(cube({1, 1e-3, 1e-3})).empty());  // a needle
  TriangleMesh wedge;                                    // a blade of six degrees
  wedge.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.05}, {1, 1, 0.05}, {1, 0, -0.05}, {1, 1, -0.05}};
  wedge.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 1, 5}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}};
  EXPECT_TRUE(inverted(wedge).empty());
}

TEST(Inverted, LensWithASharpRimHasNone) {
  TriangleMesh lens = hexagon(0.05);
  lens.positions.emplace_back(0, 0, -0.05);
  for (Index k = 0; k < 6; ++k) lens.triangles.push_back({7, 1 + (k + 1) % 6, 1 + k});
  EXPECT_TRUE(inverted(lens).empty());
}

TEST(Inverted, NarrowTrianglesAlongASharpRimAreNotOutvotedByTheOtherSide) {
  TriangleMesh lens = hexagon(-0.02);
  for (Triangle& t : lens.triangles) std::swap(t[1], t[2]);  // the lower side
  for (Index k = 1; k <= 6; ++k) {
    Vec3 inner = 0.9 * lens.positions[k];
    inner.z() = 0.01;
    lens.positions.push_back(inner);
  }
  lens.positions.emplace_back(0, 0, 0.02);
  for (Index k = 0; k < 6; ++k) {
    const Index a = 1 + k;
    const Index b = 1 + (k + 1) % 6;
    lens.triangles.push_back({a, b, a + 6});
    lens.triangles.push_back({b, b + 6, a + 6});
    lens.triangles.push_back({13, a + 6, b + 6});
  }
  EXPECT_TRUE(inverted(lens).empty());
}

TEST(Inverted, DegenerateTriangleIsNotInverted) {
  TriangleMesh mesh = hexagon(0);
  mesh.positions[0] = Vec3(0.5 * (mesh.positions[2] + mesh.positions[3]));
  EXPECT_TRUE(inverted(mesh).empty());
}

}  // namespace
}  // namespace isorelax
