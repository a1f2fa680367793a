#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.h"
#include "smoothing/run.h"

namespace isorelax {
namespace {

struct JacobiCase {
  const char* name;
  TriangleMesh mesh;
  ProblemOptions options;
};

std::vector<JacobiCase> jacobi_cases() {
  std::vector<JacobiCase> all;
  all.push_back({"random square", generate(ShapeKind::random_square, {.seed = 3, .triangles = 800}), {}});
  all.push_back({"random square, sliding",
                 generate(ShapeKind::random_square, {.seed = 4, .triangles = 800}),
                 {.boundary = BoundaryRule::slide}});
  all.push_back({"random square, areas too",
                 generate(ShapeKind::random_square, {.seed = 5, .triangles = 800}),
                 {.weights = {0.5, 0.5}}});
  all.push_back({"random sphere", generate(ShapeKind::random_sphere, {.seed = 6, .vertices = 900}), {}});
  all.push_back({"part", generate(ShapeKind::part, {.seed = 7, .triangles = 2000}), {.exponent = 2}});
  return all;
}

TEST(JacobiStep, IsPure) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 400});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const auto smoother = make_jacobi(problem);
  const std::vector<Vec3> before = mesh.positions;
  StepRecord first;
  StepRecord second;
  smoother->step(before, first);
  std::vector<Vec3> elsewhere = before;
  apply_step(first, elsewhere);
  smoother->step(elsewhere, second);  // what a smoother remembers must not show
  smoother->step(before, second);
  EXPECT_EQ(first.displacement, second.displacement);
  EXPECT_EQ(first.alpha, second.alpha);
  EXPECT_EQ(first.limits, second.limits);
  EXPECT_EQ(first.after.energy, second.after.energy);
}

TEST(JacobiStep, NeverRaisesTheEnergyAndNeverTurnsATriangle) {
  for (JacobiCase& c : jacobi_cases()) {
    const SmoothingProblem problem = make_problem(c.mesh.positions, c.mesh.triangles, c.options);
    const auto smoother = make_jacobi(problem, {.relaxation = 1.5});
    StepRecord record;
    for (int i = 0; i < 40; ++i) {
      const std::vector<Vec3> before = c.mesh.positions;
      smoother->step(before, record);
      apply_step(record, c.mesh.positions);
      ASSERT_LE(record.after.energy, record.before.energy) << c.name << " step " << i;
      for (const Triangle& t : problem.triangles) {
        const Vec3 was = area_vector(before[t[0]], before[t[1]], before[t[2]]);
        const Vec3 is = area_vector(c.mesh.positions[t[0]], c.mesh.positions[t[1]], c.mesh.positions[t[2]]);
        ASSERT_GT(was.dot(is), 0) << c.name << " step " << i;
      }
    }
  }
}

TEST(JacobiStep, RecordsTheEnergyOfThePositionsItLeadsTo) {
  for (JacobiCase& c : jacobi_cases()) {
    const SmoothingProblem problem = make_problem(c.mesh.positions, c.mesh.triangles, c.options);
    const auto smoother = make_jacobi(problem);
    StepRecord record;
    smoother->step(c.mesh.positions, record);
    const double promised = record.after.energy;
    apply_step(record, c.mesh.positions);
    make_jacobi(problem)->step(c.mesh.positions, record);
    EXPECT_EQ(record.before.energy, promised) << c.name;
  }
}

TEST(JacobiStep, IsTheSameForAnyNumberOfThreads) {
  for (JacobiCase& c : jacobi_cases()) {
    std::vector<std::vector<Vec3>> results;
    for (const unsigned threads : {1U, 2U, 5U}) {
      c.options.threads = threads;
      const SmoothingProblem problem = make_problem(c.mesh.positions, c.mesh.triangles, c.options);
      std::vector<Vec3> positions = c.mesh.positions;
      run(*make_jacobi(problem), problem, positions, {.iterations = 15});
      results.push_back(std::move(positions));
    }
    EXPECT_EQ(results[0], results[1]) << c.name;
    EXPECT_EQ(results[0], results[2]) << c.name;
  }
}

TEST(JacobiStep, IsEquation9WhereNothingLimitsIt) {
  // One free vertex in a hexagon, pushed off its middle: Eq. 9 by hand.
  std::vector<Vec3> x = {{0.1, 0.05, 0}};
  std::vector<Triangle> triangles;
  for (Index k = 0; k < 6; ++k) {
    x.emplace_back(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
    triangles.push_back({0, k + 1, (k + 1) % 6 + 1});
  }
  const SmoothingProblem problem = make_problem(x, triangles, {.weights = {0.8, 0.2}, .exponent = 1});
  StepRecord record;
  make_jacobi(problem, {.relaxation = 0.5})->step(x, record);
  Vec3 gradient = Vec3::Zero();
  double stiffness = 0;
  for (Index t = 0; t < 6; ++t) {
    const std::array<Vec3, 3> points = {x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]};
    gradient += energy_gradient(points, problem.reference[t], problem.weights)[0];
    const TriangleEnergy e = evaluate_energy(points, problem.reference[t], problem.weights);
    stiffness += e.s[1] + e.s[2];
  }
  EXPECT_LT((record.gradient[0] - gradient).norm(), 1e-13);
  EXPECT_LT((record.displacement[0] + 0.5 * gradient / stiffness).norm(), 1e-14);
  EXPECT_EQ(record.alpha[0], 1);
  EXPECT_EQ(record.limits[0], 0);
  EXPECT_EQ(record.limits[3], kLimitBoundary);
  EXPECT_EQ(record.moved, 1U);
}

TEST(JacobiStep, ConvergesToTheMiddleOfAHexagon) {
  std::vector<Vec3> x = {{0.4, -0.3, 0}};
  std::vector<Triangle> triangles;
  for (Index k = 0; k < 6; ++k) {
    x.emplace_back(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
    triangles.push_back({0, k + 1, (k + 1) % 6 + 1});
  }
  const SmoothingProblem problem = make_problem(x, triangles, {});
  const RunResult result = run(*make_jacobi(problem), problem, x, {.iterations = 1000, .tolerance = 1e-10});
  EXPECT_LT(x[0].norm(), 1e-8);
  EXPECT_NE(result.stopped, StopReason::iterations);
}

TEST(JacobiStep, ReportsShapeAreaAndEnergyOfEveryTriangleWhenAsked) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 300});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {.weights = {0.5, 2}});
  StepRecord record;
  make_jacobi(problem, {.detail = RecordDetail::vertices_and_triangles})->step(mesh.positions, record);
  ASSERT_EQ(record.energy.size(), mesh.triangles.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[t];
    const TriangleEnergy e =
        evaluate_energy({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]},
                        problem.reference[t], problem.weights);
    EXPECT_NEAR(record.shape[t], e.shape, 1e-12 * e.shape);
    EXPECT_NEAR(record.area[t], e.area, 1e-12 * e.area);
    EXPECT_NEAR(record.energy[t], e.energy, 1e-12 * e.energy);
  }
}

TEST(JacobiStep, KeepsAPlanarMeshInItsPlaneToTheBit) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 500});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  run(*make_jacobi(problem), problem, mesh.positions, {.iterations = 50});
  for (const Vec3& p : mesh.positions) EXPECT_EQ(p.z(), 0);
}

TEST(JacobiStep, LeavesARegularMeshWhereItIs) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 500, .jitter = 0});
  // Only vertices whose whole surroundings are equilateral are at rest: those away from the border.
  const std::vector<Vec3> before = mesh.positions;
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  StepRecord record;
  make_jacobi(problem)->step(mesh.positions, record);
  std::size_t inner = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = before[v];
    if (std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.2) continue;
    ++inner;
    EXPECT_LT(record.displacement[v].norm(), 1e-12);
  }
  EXPECT_GT(inner, 20U);
}

}  // namespace
}  // namespace isorelax
