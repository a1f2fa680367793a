#include "smoothing/even_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generate/generate.h"
#include "quality/report.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

StepRecord one_step(const TriangleMesh& mesh, const ProblemOptions& options, const SmootherFactory& make) {
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, options);
  StepRecord record;
  make(problem)->step(mesh.positions, record);
  return record;
}

std::unique_ptr<Smoother> automatic(const SmoothingProblem& problem) {
  return make_smoother(problem, Solver::automatic);
}
std::unique_ptr<Smoother> newton(const SmoothingProblem& problem) {
  return make_smoother(problem, Solver::newton);
}
std::unique_ptr<Smoother> even_out(const SmoothingProblem& problem) {
  return make_even_out(problem, RecordDetail::vertices);
}

double mean_after(const StepRecord& record, TriangleMesh mesh) {
  apply_step(record, mesh.positions);
  EXPECT_EQ(measure_quality(mesh).inverted, 0U);
  return measure_quality(mesh).mean_min_angle_deg;
}

TEST(EvenOut, OneStepDoesTheMeanMoreGoodThanOneOfNewtons) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::random_sphere}) {
    const TriangleMesh mesh = generate(kind, {.seed = 4, .triangles = 3000});
    const StepRecord even = one_step(mesh, {}, even_out);
    EXPECT_LT(even.after.energy, 0.5 * even.before.energy);
    EXPECT_GT(mean_after(even, mesh), mean_after(one_step(mesh, {}, newton), mesh) + 4);
  }
}

TEST(EvenOut, KeepsRidgesCornersAndPins) {
  const TriangleMesh part = generate(ShapeKind::part, {.seed = 2, .triangles = 3000, .jitter = 0.3});
  const ProblemOptions options{.surface = SurfaceRule::tangent, .pinned = {3, 200}};
  const SmoothingProblem problem = make_problem(part.positions, part.triangles, options);
  const StepRecord record = one_step(part, options, even_out);
  EXPECT_LE(record.after.energy, record.before.energy);
  EXPECT_GT(record.moved, 500U);
  for (Index v = 0; v < part.vertex_count(); ++v) {
    if (problem.mobility[v] == Mobility::none) {
      ASSERT_TRUE(record.displacement[v].isZero(0)) << v;
    } else if (problem.mobility[v] == Mobility::line) {
      const Vec3 axis = tangent_axis(problem, part.positions, v);
      ASSERT_LT(record.displacement[v].cross(axis).norm(), 1e-12) << v;
    }
  }
}

TEST(EvenOut, LeavesARegularMeshAsItIs) {
  TriangleMesh hexagon{{Vec3::Zero()}, {}, {}};
  for (Index k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3;
    hexagon.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    hexagon.triangles.push_back({0, 1 + k, 1 + (k + 1) % 6});
  }
  EXPECT_EQ(one_step(hexagon, {}, even_out).moved, 0U);
  hexagon.positions[0] = {0.1, 0.2, 0};
  const StepRecord back = one_step(hexagon, {}, even_out);
  EXPECT_EQ(back.moved, 1U);
  EXPECT_LT((back.displacement[0] + hexagon.positions[0]).norm(), 1e-15);
}

TEST(EvenOut, BeginsAutomaticRunsThatWantEvenTriangles) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 4, .triangles = 1000});
  EXPECT_EQ(one_step(mesh, {}, automatic).displacement, one_step(mesh, {}, even_out).displacement);
  const std::vector<double> sizes(mesh.vertex_count(), 1.0);
  for (const ProblemOptions& options :
       {ProblemOptions{.weights = {0, 1}}, ProblemOptions{.reference = InitialReference{}, .pinned = {100}},
        ProblemOptions{.weights = {1, 0.5}, .reference = SizeFieldReference{sizes}},
        ProblemOptions{.exponent = 8}})
    EXPECT_EQ(one_step(mesh, options, automatic).displacement, one_step(mesh, options, newton).displacement);
}

/// Where all is done, evening out would only do harm: it does nothing, and the run goes on without it.
TEST(EvenOut, DoesNoHarmAndEndsNoRun) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 4, .triangles = 1000});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  run(*newton(problem), problem, mesh.positions, {.iterations = 40, .tolerance = 0});
  const StepRecord harm = one_step(mesh, {}, even_out);
  EXPECT_EQ(harm.moved, 0U);
  EXPECT_EQ(harm.energy_passes, 1U);
  EXPECT_EQ(harm.after.energy, harm.before.energy);
  const RunResult result = run(*automatic(problem), problem, mesh.positions, {});
  EXPECT_GT(result.iterations, 5U);
  EXPECT_LT(result.after.energy, result.before.energy);
  const RunResult again = run(*automatic(problem), problem, mesh.positions, {});
  EXPECT_LE(again.after.energy, again.before.energy);
  EXPECT_GT(again.after.energy, (1 - 1e-4) * again.before.energy);
}

}  // namespace
}  // namespace isorelax
