#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/repair.h"
#include "mesh/validation.h"

namespace isorelax {
namespace {

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

/// n x m grid of squares on a torus, each cut in two.
TriangleMesh torus(Index n, Index m) {
  TriangleMesh mesh;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      const double u = 6.283185307179586 * i / n;
      const double v = 6.283185307179586 * j / m;
      mesh.positions.emplace_back((2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u),
                                  std::sin(v));
    }
  }
  const auto at = [&](Index i, Index j) { return (i % n) * m + j % m; };
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TEST(Validation, SoundClosedMeshHasNoFindings) {
  const ValidationReport r = validate(tetrahedron());
  EXPECT_EQ(r.edges, 6U);
  EXPECT_EQ(r.euler_characteristic, 2);
  EXPECT_EQ(r.genus, 0);
  EXPECT_TRUE(r.closed);
  EXPECT_TRUE(r.oriented);
  EXPECT_TRUE(r.manifold());
  EXPECT_TRUE(r.degenerate.empty());
  EXPECT_TRUE(r.duplicates.empty());
  EXPECT_TRUE(r.isolated_vertices.empty());
  EXPECT_TRUE(r.boundary.empty());
  ASSERT_EQ(r.components.size(), 1U);
  EXPECT_EQ(r.components[0].triangles, 4U);
}

TEST(Validation, TorusHasGenusOneAndKeepsItWithAHole) {
  TriangleMesh mesh = torus(6, 5);
  EXPECT_EQ(validate(mesh).genus, 1);
  mesh.triangles.erase(mesh.triangles.begin() + 7);
  const ValidationReport r = validate(mesh);
  EXPECT_EQ(r.genus, 1);
  EXPECT_FALSE(r.closed);
  ASSERT_EQ(r.boundary.size(), 1U);
  EXPECT_EQ(r.boundary[0].vertices.size(), 3U);
}

TEST(Validation, BoundaryLoopRunsWithTheSurfaceToItsLeft) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const ValidationReport r = validate(mesh);
  ASSERT_EQ(r.boundary.size(), 1U);
  EXPECT_TRUE(r.boundary[0].closed);
  auto loop = r.boundary[0].vertices;
  std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), 0U), loop.end());
  EXPECT_EQ(loop, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(r.genus, 0);
}

TEST(Validation, ThirdTriangleAtAnEdgeIsNamed) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.emplace_back(1, 1, 1);
  mesh.triangles.push_back({1, 2, 4});
  const ValidationReport r = validate(mesh);
  ASSERT_EQ(r.non_manifold_edges.size(), 1U);
  EXPECT_EQ(r.non_manifold_edges[0].a, 1U);
  EXPECT_EQ(r.non_manifold_edges[0].b, 2U);
  EXPECT_EQ(r.non_manifold_edges[0].triangles, (std::vector<Index>{0, 2, 4}));
  EXPECT_EQ(r.non_manifold_vertices, (std::vector<Index>{1, 2}));
  EXPECT_EQ(r.components.size(), 1U);
  EXPECT_FALSE(r.genus.has_value());
  EXPECT_EQ(r.edges, 8U);
  ASSERT_EQ(r.boundary.size(), 1U);
  EXPECT_FALSE(r.boundary[0].closed);
  EXPECT_EQ(r.boundary[0].vertices, (std::vector<Index>{2, 4, 1}));
}

TEST(Validation, FansThatTouchInAVertexAreTwoComponentsAndOneNonManifoldVertex) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const ValidationReport r = validate(mesh);
  EXPECT_EQ(r.non_manifold_vertices, std::vector<Index>{0});
  EXPECT_TRUE(r.non_manifold_edges.empty());
  EXPECT_EQ(r.components.size(), 2U);
  EXPECT_EQ(r.boundary.size(), 2U);
}

TEST(Validation, TurnedTriangleShowsAtItsThreeEdges) {
  TriangleMesh mesh = torus(6, 5);
  std::swap(mesh.triangles[9][0], mesh.triangles[9][1]);
  const ValidationReport r = validate(mesh);
  EXPECT_FALSE(r.oriented);
  EXPECT_TRUE(r.orientable);
  ASSERT_EQ(r.inconsistent_edges.size(), 3U);
  for (const EdgeFinding& edge : r.inconsistent_edges) {
    EXPECT_EQ(std::count(edge.triangles.begin(), edge.triangles.end(), 9U), 1);
  }
}

TEST(Validation, AnEdgeOfThreeTrianglesAsksForNoDirection) {
  // Three triangles about vertex 1, the last turned over; it shares {0, 1} with the first and a stray one.
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 0, 1}, {-1, 1, 0}, {-1, -1, 0}, {2, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {1, 3, 0}, {0, 1, 4}};
  const ValidationReport r = validate(mesh);
  EXPECT_EQ(r.non_manifold_edges.size(), 1U);
  EXPECT_EQ(r.components.size(), 1U);
  EXPECT_FALSE(r.oriented);
  EXPECT_TRUE(r.orientable);
  EXPECT_EQ(orient_consistently(mesh), std::vector<Index>{2});
  EXPECT_TRUE(validate(mesh).oriented);
}

TEST(Validation, MoebiusStripIsNotOrientable) {
  TriangleMesh mesh;
  for (int i = 0; i < 6; ++i) mesh.positions.emplace_back(std::cos(i), std::sin(i), i % 2);
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {4, 5, 1}, {1, 5, 0}};
  const ValidationReport r = validate(mesh);
  EXPECT_FALSE(r.orientable);
  EXPECT_FALSE(r.genus.has_value());
  EXPECT_EQ(r.boundary.size(), 1U);
  EXPECT_EQ(r.euler_characteristic, 0);
}

TEST(Validation, DegenerateTrianglesComeWithTheirReason) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.emplace_back(2, 0, 0);
  mesh.triangles.push_back({0, 1, 4});
  mesh.triangles.push_back({2, 3, 3});
  const ValidationReport r = validate(mesh);
  ASSERT_EQ(r.degenerate.size(), 2U);
  EXPECT_EQ(r.degenerate[0].triangle, 4U);
  EXPECT_EQ(r.degenerate[0].reason, DegenerateReason::zero_area);
  EXPECT_EQ(r.degenerate[1].triangle, 5U);
  EXPECT_EQ(r.degenerate[1].reason, DegenerateReason::repeated_vertex);
}

TEST(Validation, DuplicatesAreFoundInAnyOrderOfTheirVertices) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({3, 1, 2});
  mesh.triangles.push_back({2, 1, 3});
  const ValidationReport r = validate(mesh);
  ASSERT_EQ(r.duplicates.size(), 2U);
  EXPECT_EQ(r.duplicates[0].triangle, 4U);
  EXPECT_EQ(r.duplicates[0].first, 2U);
  EXPECT_EQ(r.duplicates[1].triangle, 5U);
  EXPECT_EQ(r.duplicates[1].first, 2U);
}

TEST(Validation, IsolatedVerticesDoNotCountInTheEulerCharacteristic) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.emplace_back(9, 9, 9);
  const ValidationReport r = validate(mesh);
  EXPECT_EQ(r.isolated_vertices, std::vector<Index>{4});
  EXPECT_EQ(r.euler_characteristic, 2);
}

TEST(Validation, MeshWithoutTrianglesIsNeitherClosedNorOfAnyGenus) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  const ValidationReport r = validate(mesh);
  EXPECT_FALSE(r.closed);
  EXPECT_FALSE(r.genus.has_value());
  EXPECT_TRUE(r.components.empty());
}

}  // namespace
}  // namespace isorelax
