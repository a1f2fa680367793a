#include <gtest/gtest.h>

#include "mesh/halfedge_mesh.h"

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

TEST(HalfedgeMesh, NamesTheTrianglesItCannotHold) {
  TriangleMesh mesh = grid(2);
  mesh.triangles.push_back({4, 0, 2});  // a third triangle at the edge 0-4
  mesh.triangles.push_back({1, 1, 2});
  const HalfedgeMesh view(mesh);
  const auto rejected = view.rejected_triangles();
  EXPECT_EQ(std::vector<Index>(rejected.begin(), rejected.end()), (std::vector<Index>{8, 9}));
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
