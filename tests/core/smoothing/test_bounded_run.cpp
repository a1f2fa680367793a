#include "smoothing/bounded_run.h"

#include <gtest/gtest.h>

#include <limits>

#include "generate/generate.h"
#include "quality/report.h"

namespace isorelax {
namespace {

BoundedResult smooth(TriangleMesh& mesh, double limit, SurfaceRule surface = SurfaceRule::tangent) {
  return run_bounded(mesh.positions, mesh.triangles, {.surface = surface},
                     [](const SmoothingProblem& problem) { return make_jacobi(problem); }, {.iterations = 40},
                     {limit});
}

TriangleMesh shaken_torus() {
  return generate(ShapeKind::torus, {.seed = 3, .triangles = 1000, .jitter = 0.5});
}

double deviation(const TriangleMesh& a, const TriangleMesh& b) {
  return measure_deviation(a.positions, b.positions, a.triangles, Topology(a.triangles, a.vertex_count()))
      .max;
}

TEST(BoundedRun, NeverExceedsTheLimit) {
  TriangleMesh free = shaken_torus();
  const double unlimited = smooth(free, std::numeric_limits<double>::infinity()).deviation.max;
  ASSERT_GT(unlimited, 0);
  for (const double share : {0.8, 0.3, 0.05}) {
    TriangleMesh mesh = shaken_torus();
    const BoundedResult result = smooth(mesh, share * unlimited);
    EXPECT_LE(result.deviation.max, share * unlimited);
    EXPECT_EQ(result.deviation.max, deviation(shaken_torus(), mesh));
    EXPECT_GT(result.limits[6], 0U) << "surface limits are counted";
  }
}

TEST(BoundedRun, TellsTheEnergyOfAMeshInWhichNothingMayMove) {
  const TriangleMesh original = shaken_torus();
  TriangleMesh mesh = original;
  const BoundedResult moved = smooth(mesh, std::numeric_limits<double>::infinity());
  mesh = original;
  const BoundedResult held = smooth(mesh, 0);
  EXPECT_EQ(held.run.iterations, 0U);
  EXPECT_EQ(held.run.before.energy, moved.run.before.energy);
  EXPECT_EQ(held.run.after.energy, held.run.before.energy);
}

TEST(BoundedRun, ACoarseSphereIsNotFrozenByTheDefaultLimit) {
  TriangleMesh mesh = generate(ShapeKind::sphere, {.vertices = 100});
  const double before = measure_quality(mesh).mean_min_angle_deg;
  const BoundedResult result = run_bounded(
      mesh.positions, mesh.triangles, {},
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, {});
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, before + 3);
  EXPECT_LE(result.deviation.max, result.deviation_limit);
}

TEST(BoundedRun, WithALimitOfZeroMovesNothingThatLeavesTheSurface) {
  TriangleMesh mesh = shaken_torus();
  EXPECT_LT(smooth(mesh, 0).deviation.max, 1e-14);
  EXPECT_EQ(mesh.positions, shaken_torus().positions);
}

TEST(BoundedRun, VerticesThatAreKeptNearMoveAndStayNear) {
  const TriangleMesh start = shaken_torus();
  ProblemOptions options;
  options.holds.distance = 0.02;
  for (Index v = 0; v < start.vertex_count(); v += 2) options.holds.near.push_back(v);
  for (const SurfaceRule surface : {SurfaceRule::tangent, SurfaceRule::project}) {
    options.surface = surface;
    const SmoothingProblem problem = make_problem(start.positions, start.triangles, options);
    std::vector<Vec3> x = start.positions;
    std::size_t limited = 0;
    run(*make_smoother(problem, Solver::automatic), problem, x, {.iterations = 30},
        [&](unsigned, const StepRecord& record, std::span<const Vec3>) {
          limited += count_limits(record.limits)[6];
          return true;
        });
    double nearest = 0, farthest = 0;
    for (Index v = 0; v < x.size(); ++v) {
      double& largest = v % 2 == 0 ? nearest : farthest;
      largest = std::max(largest, (x[v] - start.positions[v]).norm());
    }
    EXPECT_LE(nearest, options.holds.distance * (1 + 1e-12));
    EXPECT_GT(nearest, 0.9 * options.holds.distance);
    EXPECT_GT(farthest, 2 * options.holds.distance);
    EXPECT_GT(limited, 0U);
  }
}

TEST(BoundedRun, KeepsVerticesNearBeforeItHoldsThemStill) {
  TriangleMesh mesh = shaken_torus();
  const double unlimited = smooth(mesh, std::numeric_limits<double>::infinity()).deviation.max;
  mesh = shaken_torus();
  SurfaceHolds last;
  run_bounded(
      mesh.positions, mesh.triangles, {.surface = SurfaceRule::tangent},
      [](const SmoothingProblem& problem) { return make_jacobi(problem); }, {.iterations = 40},
      {0.5 * unlimited}, {}, {}, [&](const RunPart& part, std::span<const Vec3>) { last = part.holds; });
  EXPECT_GT(last.near.size(), 0U);
  EXPECT_TRUE(last.still.empty());
}

TEST(BoundedRun, ProjectionKeepsVerticesOnTheSurfaceItCameFrom) {
  TriangleMesh tangent = generate(ShapeKind::random_sphere, {.seed = 8, .vertices = 2000});
  TriangleMesh projected = tangent;
  smooth(tangent, 1, SurfaceRule::tangent);
  smooth(projected, 1, SurfaceRule::project);
  const auto radial_error = [](const TriangleMesh& mesh) {
    double largest = 0;
    for (const Vec3& p : mesh.positions) largest = std::max(largest, std::abs(p.norm() - 1));
    return largest;
  };
  EXPECT_GT(radial_error(tangent), 1e-3);
  EXPECT_LT(radial_error(projected), 1e-4);
}

}  // namespace
}  // namespace isorelax
