#include <gtest/gtest.h>

#include <algorithm>

#include "generate/generate.h"
#include "smoothing/run.h"

namespace isorelax {
namespace {

TEST(VisitOrder, LeavesGridsAndVisitsAllOfRandomlyNumberedMeshes) {
  const TriangleMesh grid = generate(ShapeKind::torus, {.seed = 1, .triangles = 4000, .jitter = 0.3});
  EXPECT_TRUE(VisitOrder(grid.positions, grid.triangles).vertices.empty());
  const TriangleMesh random = generate(ShapeKind::random_sphere, {.seed = 1, .vertices = 3000});
  VisitOrder order(random.positions, random.triangles);
  double jump = 0;
  for (std::size_t i = 1; i < order.vertices.size(); ++i)
    jump += (random.positions[order.vertices[i]] - random.positions[order.vertices[i - 1]]).norm();
  EXPECT_LT(jump / 3000, 0.12);  // the mean edge is 0.07, the mean distance of two vertices 1.3
  std::sort(order.vertices.begin(), order.vertices.end());
  for (Index v = 0; v < 3000; ++v) ASSERT_EQ(order.vertices[v], v);
  std::sort(order.triangles.begin(), order.triangles.end());
  for (Index t = 0; t < random.triangle_count(); ++t) ASSERT_EQ(order.triangles[t], t);
}

TEST(VisitOrder, ChangesNoStep) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 2, .vertices = 3000});
  SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  ASSERT_FALSE(problem.order.vertices.empty());
  std::vector<Vec3> ordered = mesh.positions;
  run(*make_newton(problem), problem, ordered, {.iterations = 5});
  problem.order = {};
  std::vector<Vec3> plain = mesh.positions;
  run(*make_newton(problem), problem, plain, {.iterations = 5});
  EXPECT_EQ(ordered, plain);
}

}  // namespace
}  // namespace isorelax
