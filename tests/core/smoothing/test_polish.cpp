#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/angle_ring.h"
#include "smoothing/polish.h"

namespace isorelax {
namespace {

struct Polished {
  TriangleMesh smoothed, polished;
  BoundedResult result;
};

Polished polish(const TriangleMesh& mesh, const ProblemOptions& options,
                const PolishOptions& polish_options = {}) {
  const auto smoother = [](const SmoothingProblem& p) { return make_smoother(p, Solver::automatic); };
  Polished p{mesh, mesh, {}};
  run_bounded(p.smoothed.positions, mesh.triangles, options, smoother, {}, {});
  p.result = run_bounded(p.polished.positions, mesh.triangles, options, smoother, {}, {}, {}, polish_options);
  return p;
}

TEST(Polish, ImprovesBothWorstAnglesAndHardlyTheMean) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::hexagonal_square}) {
    const Polished p = polish(generate(kind, {.seed = 1, .triangles = 454}), {});
    const QualityReport before = measure_quality(p.smoothed);
    const QualityReport after = measure_quality(p.polished);
    EXPECT_GT(after.min_angle_deg, before.min_angle_deg + 1);
    EXPECT_LT(after.max_angle_deg, before.max_angle_deg - 0.2);
    EXPECT_GT(after.mean_min_angle_deg, before.mean_min_angle_deg - 1);
    ASSERT_TRUE(p.result.polish);
    EXPECT_EQ(p.result.polish->stopped, StopReason::movement);
  }
}

/// The largest smallest angle that any positions can have with this largest angle, where a vertex of three
/// triangles is next to one of four in a plane.
double bound_of_nested_triangles(double largest_deg) {
  return std::min(22.5, 1.5 * largest_deg - 180);
}

TEST(Polish, ComesToTheBoundOnARandomSquare) {
  // The minimum of the sum of squares has 19.3 and 138.8 degrees, that of sixteenth powers 18.3 and 132.8.
  const Polished p = polish(generate(ShapeKind::random_square, {.seed = 1, .triangles = 454}), {});
  const QualityReport after = measure_quality(p.polished);
  EXPECT_GT(after.min_angle_deg, 22.3);
  EXPECT_LT(after.max_angle_deg, 135.2);
  EXPECT_GT(after.mean_min_angle_deg, 43.0);
  EXPECT_LE(after.min_angle_deg, bound_of_nested_triangles(after.max_angle_deg) + 1e-6);
}

TEST(Polish, GetsBetterInBothAnglesThanEveryExponentItStartsFrom) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 1, .triangles = 454});
  for (const double exponent : {1.0, 2.0, 8.0, 16.0, 32.0}) {
    const Polished p = polish(mesh, {.exponent = exponent});
    const QualityReport before = measure_quality(p.smoothed);
    const QualityReport after = measure_quality(p.polished);
    EXPECT_GT(after.min_angle_deg, before.min_angle_deg + 0.1) << exponent;
    EXPECT_LT(after.max_angle_deg, before.max_angle_deg - 0.05) << exponent;
    EXPECT_GT(after.min_angle_deg, bound_of_nested_triangles(after.max_angle_deg) - 0.2) << exponent;
  }
}

TEST(Polish, FindsTheBestPlaceOfAVertexOfThreeTrianglesNextToOneOfFour) {
  // In a triangle of 67.5, 67.5 and 45 degrees all eight angles at its corners can be 22.5.
  const double top = 0.5 * std::tan(67.5 * M_PI / 180);
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, top, 0}, {0.55, 0.6, 0}, {0.45, 0.2, 0}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const QualityReport after = measure_quality(polish(mesh, {}, {.largest_mean_loss = 20}).polished);
  EXPECT_NEAR(after.min_angle_deg, 22.5, 0.2);
  EXPECT_NEAR(after.max_angle_deg, 135, 0.4);
}

TEST(Polish, LooksPastTrianglesThatCannotChange) {
  // The triangle cut off at the corner by a long edge stays; the others get better all the same.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-0.2, 0.5, 0}, {0.3, 0.25, 0}};
  mesh.triangles = {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}, {3, 4, 0}};
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const auto smoother = make_polish(problem, {.largest_mean_loss = 20});
  run(*smoother, problem, mesh.positions, {.iterations = 300, .tolerance = 1e-12});
  EXPECT_NEAR((mesh.positions[5] - Vec3(0.5, 0.5, 0)).norm(), 0, 1e-2);
}

TEST(Polish, LosesNoMoreOfTheMeanThanIsAllowed) {
  for (const double loss : {0.0, 0.02}) {
    const Polished p = polish(generate(ShapeKind::random_square, {.seed = 3, .triangles = 454}), {},
                              {.largest_mean_loss = loss});
    EXPECT_GE(measure_quality(p.polished).mean_min_angle_deg,
              measure_quality(p.smoothed).mean_min_angle_deg - loss - 1e-9);
  }
}

TEST(Polish, KeepsBordersRidgesAndTheSurface) {
  const TriangleMesh mesh = generate(ShapeKind::part, {.seed = 2, .triangles = 1500});
  const Polished p = polish(mesh, {.boundary = BoundaryRule::slide});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (problem.mobility[v] == Mobility::none) {
      EXPECT_EQ(p.polished.positions[v], mesh.positions[v]);
    }
  }
  EXPECT_LE(p.result.deviation.max, p.result.deviation_limit);
  EXPECT_TRUE(inverted_triangles(p.polished.positions, mesh.triangles, problem.topology).empty());
  EXPECT_GE(measure_quality(p.polished).min_angle_deg, measure_quality(p.smoothed).min_angle_deg - 1e-9);
  EXPECT_LE(measure_quality(p.polished).max_angle_deg, measure_quality(p.smoothed).max_angle_deg + 1e-9);
}

TEST(Polish, DoesNotDependOnThreads) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 4, .triangles = 3000});
  EXPECT_EQ(polish(mesh, {.threads = 1}).polished.positions, polish(mesh, {.threads = 2}).polished.positions);
}

TEST(Polish, LeavesARegularMeshAlone) {
  std::vector<Vec3> x = {Vec3::Zero()};
  std::vector<Triangle> triangles;
  for (Index k = 0; k < 6; ++k) {
    x.emplace_back(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
    triangles.push_back({0, k + 1, (k + 1) % 6 + 1});
  }
  const SmoothingProblem problem = make_problem(x, triangles, {});
  StepRecord record;
  make_polish(problem, {})->step(x, record);
  EXPECT_LT(record.displacement[0].norm(), 1e-9);
}

TEST(Polish, FollowsTheGradientOfTheSoftMinimum) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 9, .triangles = 100});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  AngleRing ring(problem);
  ring.aim_at({{10, 150}, 2});
  const double h = 1e-6 * problem.mean_edge_length;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (problem.mobility[v] == Mobility::none) continue;
    ring.look_at(mesh.positions, v);
    const Vec3 at = mesh.positions[v];
    const Vec3 gradient = ring.soft(at, 0.5).gradient;
    for (unsigned k = 0; k < 2; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const double slope = (ring.soft_value(at + step, 0.5) - ring.soft_value(at - step, 0.5)) / (2 * h);
      EXPECT_NEAR(gradient[k], slope, 1e-4 * (1 + gradient.norm()));
    }
  }
}

}  // namespace
}  // namespace isorelax
