#include "surface/feature_edges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/surface/shapes.h"
#include "surface/sectors.h"

namespace isorelax {
namespace {

bool on_side(double x) {
  return std::abs(x) < 1e-12 || std::abs(x - 1) < 1e-12;
}

/// In how many sides of the unit cube, moved to its corner, a point lies.
int sides(const Vec3& x) {
  return (on_side(x.x()) ? 1 : 0) + (on_side(x.y()) ? 1 : 0) + (on_side(x.z()) ? 1 : 0);
}

struct CubeFeatures : ::testing::Test {
  CubeFeatures() : mesh(with_triangles(ShapeKind::cube, 1200)) {
    Vec3 low = mesh.positions[0];
    for (const Vec3& x : mesh.positions) low = low.cwiseMin(x);
    for (Vec3& x : mesh.positions) x -= low;
    topology = Topology(mesh.triangles, mesh.vertex_count());
    classes = classify_vertices(mesh.positions, mesh.triangles, topology, {}, 1);
  }
  TriangleMesh mesh;
  Topology topology;
  VertexClasses classes;
};

TEST_F(CubeFeatures, CreasesAreTheEdgesOfACube) {
  double length = 0;
  for (const FeatureEdge& e : classes.creases) {
    for (const Index v : e.vertices) {
      EXPECT_GE(sides(mesh.positions[v]), 2);
      EXPECT_NE(classes.classes[v], VertexClass::smooth);
    }
    length += (mesh.positions[e.vertices[1]] - mesh.positions[e.vertices[0]]).norm();
    EXPECT_NEAR(dihedral_turn_deg(mesh.positions, mesh.triangles, topology, e.corner), 90, 1e-9);
  }
  EXPECT_NEAR(length, 12, 1e-9);
}

TEST_F(CubeFeatures, VanishWithoutFeatures) {
  const FeatureOptions none = FeatureOptions::none();
  const VertexClasses plain = classify_vertices(mesh.positions, mesh.triangles, topology, none, 1);
  EXPECT_TRUE(plain.creases.empty());
}

TEST_F(CubeFeatures, CutTheTrianglesAboutAVertexIntoFaces) {
  EdgeWalls walls(3 * mesh.triangles.size(), 0);
  for (const FeatureEdge& e : classes.creases) walls[e.corner] = walls[topology.opposite(e.corner)] = 1;
  const Sectors sectors(mesh.triangles, topology, walls);
  std::vector<int> count(mesh.positions.size(), 0);
  std::size_t corners = 0;
  for (Index s = 0; s < sectors.count(); ++s) {
    ++count[sectors.vertex(s)];
    corners += sectors.corners(s).size();
    for (const Corner c : sectors.corners(s)) {
      EXPECT_EQ(sectors.of(c), s);
      EXPECT_EQ(mesh.triangles[c / 3][c % 3], sectors.vertex(s));
    }
    EXPECT_EQ(sectors.is_closed(s), sides(mesh.positions[sectors.vertex(s)]) == 1);
  }
  EXPECT_EQ(corners, 3 * mesh.triangles.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(count[v], sides(mesh.positions[v]));
}

}  // namespace
}  // namespace isorelax
