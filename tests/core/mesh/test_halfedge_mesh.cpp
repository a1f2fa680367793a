#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/boundary.h"
#include "mesh/halfedge_mesh.h"
#include "mesh/validation.h"

namespace isorelax {
namespace {

/// n x n squares, each cut in two along the same diagonal.
TriangleMesh grid(Index n) {
  TriangleMesh mesh;
  for (Index y = 0; y <= n; ++y) {
    for (Index x = 0; x <= n; ++x) mesh.positions.emplace_back(x, y, 0);
  }
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  }
  return mesh;
}

std::vector<Index> from_smallest(std::vector<Index> loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

TEST(HalfedgeMesh, OneRingRunsCounterClockwise) {
  const HalfedgeMesh mesh(grid(2));
  EXPECT_EQ(from_smallest(mesh.one_ring(4)), (std::vector<Index>{0, 1, 5, 8, 7, 3}));
  EXPECT_EQ(mesh.one_ring(0), (std::vector<Index>{1, 4, 3}));  // a corner: from end to end
  EXPECT_EQ(mesh.one_ring(1), (std::vector<Index>{2, 5, 4, 0}));
}

TEST(HalfedgeMesh, AgreesWithValidationOnBoundaryAndEdges) {
  TriangleMesh mesh = grid(5);
  mesh.triangles.erase(mesh.triangles.begin() + 24);  // a hole inside
  const HalfedgeMesh view(mesh);
  const ValidationReport report = validate(mesh);
  EXPECT_EQ(view.edge_count(), report.edges);
  std::vector<std::vector<Index>> mine;
  for (const BoundaryLoop& loop : report.boundary) mine.push_back(from_smallest(loop.vertices));
  std::vector<std::vector<Index>> theirs;
  for (const auto& loop : view.boundary_loops()) theirs.push_back(from_smallest(loop));
  std::sort(mine.begin(), mine.end());
  std::sort(theirs.begin(), theirs.end());
  EXPECT_EQ(mine, theirs);
  EXPECT_EQ(mine.size(), 2U);
}

TEST(HalfedgeMesh, NamesTheTrianglesItCannotHold) {
  TriangleMesh mesh = grid(2);
  mesh.triangles.push_back({4, 0, 2});  // a third triangle at the edge 0-4
  mesh.triangles.push_back({1, 1, 2});
  const HalfedgeMesh view(mesh);
  const auto rejected = view.rejected_triangles();
  EXPECT_EQ(std::vector<Index>(rejected.begin(), rejected.end()), (std::vector<Index>{8, 9}));
  EXPECT_EQ(view.triangles().size(), 8U);
}

TEST(HalfedgeMesh, FlippingAnEdgeTurnsItAndKeepsTheRest) {
  HalfedgeMesh view(grid(1));
  EXPECT_FALSE(view.flip_edge(0, 1));  // boundary
  EXPECT_FALSE(view.flip_edge(1, 2));  // no such edge
  EXPECT_TRUE(view.flip_edge(0, 3));
  const auto ring = view.one_ring(1);
  EXPECT_NE(std::find(ring.begin(), ring.end(), 2U), ring.end());
  EXPECT_EQ(view.edge_count(), 5U);
  TriangleMesh flipped = grid(1);
  flipped.triangles = view.triangles();
  EXPECT_TRUE(validate(flipped).oriented);
}

TEST(HalfedgeMesh, RemovingATriangleOpensAHoleOnce) {
  HalfedgeMesh view(grid(3));
  EXPECT_TRUE(view.remove_triangle(8));
  EXPECT_FALSE(view.remove_triangle(8));
  EXPECT_EQ(view.triangles().size(), 17U);
  EXPECT_EQ(view.boundary_loops().size(), 2U);
}

TEST(HalfedgeMesh, LaplaceSmootherMovesInnerVerticesOnly) {
  TriangleMesh mesh = grid(4);
  mesh.positions[12] += Vec3(0.3, 0.2, 0);
  HalfedgeMesh view(mesh);
  view.smooth_laplace(20);
  const auto after = view.positions();
  EXPECT_EQ(after[0], mesh.positions[0]);
  EXPECT_LT((after[12] - Vec3(2, 2, 0)).norm(), 0.05);
}

TEST(HalfedgeMesh, LaplaceSmootherLeavesHeldVertices) {
  TriangleMesh mesh = grid(4);
  mesh.positions[12] += Vec3(0.3, 0.2, 0);
  HalfedgeMesh view(mesh);
  std::vector<std::uint8_t> held(mesh.vertex_count(), 0);
  held[12] = 1;
  view.hold(held);
  view.smooth_laplace(20);
  EXPECT_EQ(view.positions()[12], mesh.positions[12]);
  EXPECT_NE(view.positions()[11], mesh.positions[11]);
}

}  // namespace
}  // namespace isorelax
