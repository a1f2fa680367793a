#include <gtest/gtest.h>

#include "mesh/repair.h"
#include "mesh/validation.h"

namespace isorelax {
namespace {

/// A tetrahedron with an isolated vertex 1, a degenerate triangle 2 and a copy (5) of triangle 0; every
/// attribute value names the element it belongs to.
TriangleMesh flawed() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 3, 2}, {0, 2, 4}, {2, 2, 3}, {2, 3, 4}, {3, 0, 4}, {2, 0, 3}};
  mesh.attributes.vertex.push_back({"weight", ScalarType::float64, 1, {0, 1, 2, 3, 4}});
  mesh.attributes.face.push_back({"pair", ScalarType::float64, 2, {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}});
  CornerAttribute corners;
  for (std::uint32_t c = 0; c < 18; ++c) corners.indices.push_back(c);
  mesh.attributes.corner.push_back(corners);
  mesh.attributes.face_labels.push_back({"g", {"a", "b", "c", "d", "e", "f"}, {0, 1, 2, 3, 4, 5}});
  return mesh;
}

TEST(Repair, DegenerateTrianglesGoAndTakeTheirAttributesAlong) {
  TriangleMesh mesh = flawed();
  EXPECT_EQ(remove_degenerate_triangles(mesh), std::vector<Index>{2});
  EXPECT_EQ(mesh.triangle_count(), 5U);
  EXPECT_EQ(mesh.triangles[2], (Triangle{2, 3, 4}));
  EXPECT_EQ(mesh.attributes.face[0].values, (std::vector<double>{0, 0, 1, 1, 3, 3, 4, 4, 5, 5}));
  EXPECT_EQ(mesh.attributes.corner[0].indices[6], 9U);
  EXPECT_EQ(mesh.attributes.face_labels[0].face_label, (std::vector<std::uint32_t>{0, 1, 3, 4, 5}));
  EXPECT_TRUE(remove_degenerate_triangles(mesh).empty());
}

TEST(Repair, LaterCopiesGo) {
  TriangleMesh mesh = flawed();
  EXPECT_EQ(remove_duplicate_triangles(mesh), std::vector<Index>{5});
  EXPECT_EQ(mesh.triangle_count(), 5U);
}

TEST(Repair, IsolatedVerticesGoAndTheOthersMoveUp) {
  TriangleMesh mesh = flawed();
  EXPECT_EQ(remove_isolated_vertices(mesh), std::vector<Index>{1});
  EXPECT_EQ(mesh.vertex_count(), 4U);
  EXPECT_EQ(mesh.triangles[1], (Triangle{0, 1, 3}));
  EXPECT_EQ(mesh.attributes.vertex[0].values, (std::vector<double>{0, 2, 3, 4}));
}

TEST(Repair, AllOfThemMakeASoundMesh) {
  TriangleMesh mesh = flawed();
  remove_degenerate_triangles(mesh);
  remove_duplicate_triangles(mesh);
  remove_isolated_vertices(mesh);
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  EXPECT_FALSE(validate(mesh).oriented);
  EXPECT_EQ(orient_consistently(mesh), std::vector<Index>{1});
  const ValidationReport r = validate(mesh);
  EXPECT_TRUE(r.oriented && r.manifold() && r.closed);
  EXPECT_EQ(r.genus, 0);
}

TEST(Repair, TurningATriangleOverTurnsItsCornersAndNormal) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 0, 4}};
  mesh.attributes.face.push_back({"normal", ScalarType::float64, 3, {0, 0, 1, 0, 0, 1, 0, 0, -1}});
  mesh.attributes.corner.push_back({"texcoord", 2, {}, {0, 1, 2, 3, 4, 5, 6, 7, 8}});
  EXPECT_EQ(orient_consistently(mesh), std::vector<Index>{2});
  EXPECT_EQ(mesh.triangles[2], (Triangle{3, 4, 0}));
  EXPECT_EQ(mesh.attributes.corner[0].indices[7], 8U);
  EXPECT_EQ(mesh.attributes.face[0].values[8], 1);
}

}  // namespace
}  // namespace isorelax
