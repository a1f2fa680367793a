#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.h"
#include "smoothing/coarse_correction.h"
#include "smoothing/run.h"

namespace isorelax {
namespace {

struct Prepared {
  SmoothingProblem problem;
  Objective here;
  std::vector<NewtonBlock> blocks;

  Prepared(const TriangleMesh& mesh, const ProblemOptions& options)
      : problem(make_problem(mesh.positions, mesh.triangles, options)),
        here(problem),
        blocks(mesh.vertex_count()) {
    here.evaluate(mesh.positions);
    TangentSweep(problem).run(here, mesh.positions, [&](const TangentBatch& batch) {
      const auto made = newton_blocks(problem, here, batch);
      for (unsigned i = 0; i < batch.count; ++i) blocks[batch.vertices[i]] = made[i];
    });
  }

  [[nodiscard]] std::vector<Vec3> correct(const std::vector<Vec3>& residual) const {
    CoarseCorrection coarse(problem, here);
    coarse.refresh(here, blocks);
    coarse.solve(residual, blocks);
    std::vector<Vec3> result;
    for (Index v = 0; v < residual.size(); ++v) result.push_back(coarse.at(v, blocks[v]));
    return result;
  }
};

double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

TEST(CoarseCorrection, IsSymmetricAndPositive) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::random_sphere, ShapeKind::part}) {
    const TriangleMesh mesh = generate(kind, {.seed = 3, .triangles = 1200});
    const Prepared prepared(mesh, {.weights = {1, 0.5}, .boundary = BoundaryRule::slide});
    std::vector<Vec3> a, b;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      a.emplace_back(std::sin(v), std::cos(3 * v), std::sin(2 * v));
      b.emplace_back(std::cos(v), std::sin(5 * v), std::cos(7 * v));
    }
    const std::vector<Vec3> ca = prepared.correct(a);
    const std::vector<Vec3> cb = prepared.correct(b);
    EXPECT_GT(product(a, ca), 0);
    EXPECT_NEAR(product(a, cb), product(b, ca), 1e-9 * std::sqrt(product(a, ca) * product(b, cb)));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (prepared.problem.mobility[v] == Mobility::none) {
        EXPECT_EQ(ca[v], Vec3::Zero());
      }
    }
  }
}

TEST(CoarseCorrection, KeepsTheStepsToConvergenceFromGrowingWithTheMesh) {
  // By Newton blocks alone L-BFGS takes 48, 78 and 139 steps.
  for (const std::size_t triangles : {454, 2126, 10282}) {
    TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 3, .triangles = triangles});
    const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
    const RunResult result = run(*make_smoother(problem, Solver::automatic), problem, mesh.positions, {});
    EXPECT_LT(result.iterations, 60U) << triangles;
    EXPECT_NE(result.stopped, StopReason::stalled);
  }
}

}  // namespace
}  // namespace isorelax
