#include "smoothing/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "generate/generate.h"
#include "quality/report.h"

namespace isorelax {
namespace {

RunResult run_smoother(TriangleMesh& mesh, const ProblemOptions& problem_options, const RunOptions& options,
                       const StepObserver& observer = {}) {
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, problem_options);
  return run(*make_jacobi(problem), problem, mesh.positions, options, observer);
}

TEST(Run, StopsAtTheIterationLimit) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 300});
  const RunResult result = run_smoother(mesh, {}, {.iterations = 3});
  EXPECT_EQ(result.iterations, 3U);
  EXPECT_EQ(result.stopped, StopReason::iterations);
}

TEST(Run, WithToleranceZeroDoesExactlyThatManySteps) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 100});
  EXPECT_EQ(run_smoother(mesh, {}, {.iterations = 2000, .tolerance = 0}).iterations, 2000U);
}

TEST(Run, NeverMakesATriangleWorseThanTheWorstOne) {
  // Halves of squares: the energy alone would trade their angles of 45 degrees for a better sum.
  TriangleMesh cube = generate(ShapeKind::cube, {.triangles = 300, .jitter = 0});
  TriangleMesh sphere = generate(ShapeKind::sphere, {.vertices = 400});
  for (TriangleMesh* mesh : {&cube, &sphere}) {
    const QualityReport before = measure_quality(*mesh);
    ProblemOptions options;
    options.exponent = 2;
    run_smoother(*mesh, options, {.iterations = 100});
    const QualityReport after = measure_quality(*mesh);
    EXPECT_GE(after.min_angle_deg, before.min_angle_deg - 1e-9);
    EXPECT_LE(after.max_angle_deg, std::max(before.max_angle_deg, 120.0) + 1e-9);
    EXPECT_GE(after.mean_min_angle_deg, before.mean_min_angle_deg - 1e-9);
  }
}

TEST(Run, StopsWhenConverged) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 200, .jitter = 0.2});
  const RunResult result = run_smoother(mesh, {}, {.iterations = 5000, .tolerance = 1e-5});
  EXPECT_LT(result.iterations, 5000U);
  EXPECT_NE(result.stopped, StopReason::iterations);
}

TEST(Run, ASliverThatCannotGetBetterDoesNotEndIt) {
  const TriangleMesh clean = generate(ShapeKind::random_square, {.seed = 2, .triangles = 400});
  TriangleMesh flawed = clean;
  const auto& x = clean.positions;
  for (const Triangle& t : clean.triangles) {
    for (unsigned k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[next(k)];
      if (x[a].y() != 0 || x[b].y() != 0 || flawed.positions.size() > x.size()) continue;
      flawed.triangles.push_back({b, a, flawed.vertex_count()});
      flawed.positions.emplace_back(0.5 * (x[a] + x[b]) - Vec3(0, 1e-7, 0));
    }
  }
  ASSERT_EQ(flawed.triangle_count(), clean.triangle_count() + 1);
  const auto converge = [](TriangleMesh mesh) {
    const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
    const RunResult result =
        run(*make_smoother(problem, Solver::automatic), problem, mesh.positions, {.iterations = 500});
    EXPECT_NE(result.stopped, StopReason::iterations);
    return measure_quality(mesh).mean_min_angle_deg * static_cast<double>(mesh.triangle_count());
  };
  EXPECT_NEAR(converge(flawed), converge(clean), 0.02 * static_cast<double>(clean.triangle_count()));
}

TEST(Run, AHugeGradientAtTheStartDoesNotEndItEither) {
  // A square that is crowded towards one corner.
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 3, .triangles = 600});
  for (Vec3& x : mesh.positions)
    for (double* const c : {&x.x(), &x.y()}) *c = std::pow(*c, 4);
  const auto energy_with = [&](Solver solver, BoundaryRule boundary) {
    TriangleMesh copy = mesh;
    const SmoothingProblem problem = make_problem(copy.positions, copy.triangles, {.boundary = boundary});
    return run(*make_smoother(problem, solver), problem, copy.positions, {.iterations = 3000}).after.energy;
  };
  for (const BoundaryRule boundary : {BoundaryRule::fixed, BoundaryRule::slide}) {
    const double least = energy_with(Solver::automatic, boundary);
    EXPECT_LT(energy_with(Solver::lbfgs, boundary), 1.01 * least);
  }
}

TEST(Run, SaysThatNothingMayMove) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const RunResult result = run_smoother(mesh, {}, {});
  EXPECT_EQ(result.stopped, StopReason::fixed);
  EXPECT_EQ(result.iterations, 0U);
}

TEST(Run, ObserverCanCancel) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 300});
  const RunResult result = run_smoother(
      mesh, {}, {},
      [](unsigned iteration, const StepRecord&, std::span<const Vec3>) { return iteration < 5; });
  EXPECT_EQ(result.iterations, 5U);
  EXPECT_EQ(result.stopped, StopReason::cancelled);
}

TEST(Run, MakesEveryKindOfMeshBetter) {
  for (const ShapeKind kind :
       {ShapeKind::random_square, ShapeKind::hexagonal_square, ShapeKind::random_sphere, ShapeKind::part}) {
    TriangleMesh mesh = generate(kind, {.seed = 11, .triangles = 1500});
    const QualityReport before = measure_quality(mesh);
    run_smoother(mesh, {}, {});
    const QualityReport after = measure_quality(mesh);
    EXPECT_GT(after.mean_min_angle_deg, before.mean_min_angle_deg + 5);
    EXPECT_GE(after.min_angle_deg, before.min_angle_deg);
    EXPECT_LE(after.inverted, before.inverted);
  }
}

TEST(Run, KeepsTheBoundaryToTheBit) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 500});
  const std::vector<Vec3> before = mesh.positions;
  run_smoother(mesh, {}, {});
  const Topology topology(mesh.triangles, mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (topology.is_boundary(v)) {
      EXPECT_EQ(mesh.positions[v], before[v]);
    }
  }
}

TEST(Run, SlidingKeepsTheSquare) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 500});
  const std::vector<Vec3> before = mesh.positions;
  run_smoother(mesh, {.boundary = BoundaryRule::slide}, {});
  std::size_t slid = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (int k = 0; k < 2; ++k) {
      if (before[v][k] == 0 || before[v][k] == 1) {
        EXPECT_NEAR(mesh.positions[v][k], before[v][k], 1e-12);
      }
    }
    const bool border = (before[v].array() * (1 - before[v].array())).head<2>().minCoeff() == 0;
    slid += border && mesh.positions[v] != before[v] ? 1 : 0;
  }
  EXPECT_GT(slid, 10U);
}

TEST(Run, KeepsTheCubeACube) {
  TriangleMesh mesh = generate(ShapeKind::cube, {.triangles = 1200, .jitter = 0.4});
  Vec3 low = mesh.positions[0];
  Vec3 high = low;
  for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  run_smoother(mesh, {}, {});
  for (const Vec3& p : mesh.positions) {
    const double off = std::min((p - low).cwiseAbs().minCoeff(), (p - high).cwiseAbs().minCoeff());
    EXPECT_LT(off, 1e-9);
  }
}

/// Largest distance between results after a map of the input is undone.
double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TEST(Run, DoesNotDependOnWhereAndHowLargeTheMeshIs) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 2, .vertices = 400});
  TriangleMesh plain = mesh;
  run_smoother(plain, {.weights = {1, 0.5}}, {.iterations = 10});
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.2, 0.7).normalized();
  const Vec3 shift(0.5, -2, 1);
  TriangleMesh moved = mesh;
  for (Vec3& p : moved.positions) p = 8 * (turn * p) + shift;
  run_smoother(moved, {.weights = {1, 0.5}}, {.iterations = 10});
  for (Vec3& p : moved.positions) p = turn.conjugate() * ((p - shift) / 8);
  EXPECT_LT(difference(plain.positions, moved.positions), 1e-9);
}

TEST(Run, DoesNotDependOnTheNumberingOfTheMesh) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 2, .triangles = 400});
  TriangleMesh plain = mesh;
  run_smoother(plain, {}, {.iterations = 10});
  std::mt19937_64 engine(4);
  std::vector<Index> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), engine);
  TriangleMesh renumbered = mesh;
  for (Index v = 0; v < mesh.vertex_count(); ++v) renumbered.positions[order[v]] = mesh.positions[v];
  for (Triangle& t : renumbered.triangles) t = {order[t[1]], order[t[2]], order[t[0]]};
  std::shuffle(renumbered.triangles.begin(), renumbered.triangles.end(), engine);
  run_smoother(renumbered, {}, {.iterations = 10});
  std::vector<Vec3> back(mesh.positions.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v) back[v] = renumbered.positions[order[v]];
  EXPECT_LT(difference(plain.positions, back), 1e-9);
}

TEST(Run, AgainstTheMeshItselfMovesNothing) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 400});
  const std::vector<Vec3> before = mesh.positions;
  const RunResult result = run_smoother(mesh, {.weights = {0.5, 0.5}, .reference = InitialReference{}}, {});
  EXPECT_LT(difference(mesh.positions, before), 1e-9);
  EXPECT_LE(result.iterations, 2U);
}

}  // namespace
}  // namespace isorelax
