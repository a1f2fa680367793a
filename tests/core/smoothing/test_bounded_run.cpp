#include "smoothing/bounded_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/two_sheets.h"
#include "generate/generate.h"
#include "quality/report.h"
#include "surface/crossings.h"

namespace isorelax {
namespace {

BoundedResult smooth(TriangleMesh& mesh, double limit, SurfaceRule surface = SurfaceRule::tangent,
                     const StepObserver& observer = {}) {
  return run_bounded(
      mesh.positions, mesh.triangles, {.surface = surface},
      [](const SmoothingProblem& problem) { return make_jacobi(problem); }, {.iterations = 40}, {limit},
      observer);
}

TriangleMesh shaken_torus() {
  return generate(ShapeKind::torus, {.seed = 3, .triangles = 600, .jitter = 0.5});
}

double distance_between(const TriangleMesh& a, const TriangleMesh& b) {
  return measure_deviation(a.positions, b.positions, a.triangles, Topology(a.triangles, a.vertex_count()))
      .max;
}

TEST(BoundedRun, NeverExceedsTheLimit) {
  TriangleMesh free = shaken_torus();
  const double unlimited = smooth(free, std::numeric_limits<double>::infinity()).deviation.max;
  ASSERT_GT(unlimited, 0);
  for (const double share : {0.8, 0.3, 0.05}) {
    TriangleMesh mesh = shaken_torus();
    std::size_t limited = 0;
    const BoundedResult result = smooth(mesh, share * unlimited, SurfaceRule::tangent,
                                        [&](unsigned, const StepRecord& record, std::span<const Vec3>) {
                                          limited += count_limits(record.limits)[6];
                                          return true;
                                        });
    EXPECT_LE(result.deviation.max, share * unlimited);
    EXPECT_EQ(result.deviation.max, distance_between(shaken_torus(), mesh));
    EXPECT_GT(limited, 0U) << "surface limits are counted";
  }
}

TEST(BoundedRun, TellsTheEnergyOfAMeshInWhichNothingMayMove) {
  const TriangleMesh original = shaken_torus();
  TriangleMesh mesh = original;
  const BoundedResult moved = smooth(mesh, std::numeric_limits<double>::infinity());
  mesh = original;
  const BoundedResult held = smooth(mesh, 0);
  EXPECT_EQ(mesh.positions, original.positions);
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

BoundedResult smooth_by_default(TriangleMesh& mesh, const ProblemOptions& options,
                                const DeviationLimit& limit = {}) {
  return run_bounded(
      mesh.positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, limit);
}

TEST(BoundedRun, WithALimitOfZeroBordersSlideAlongStraightLines) {
  TriangleMesh free = generate(ShapeKind::random_square, {.seed = 5, .triangles = 400});
  TriangleMesh limited = free;
  smooth_by_default(free, {.boundary = BoundaryRule::slide});
  EXPECT_EQ(smooth_by_default(limited, {.boundary = BoundaryRule::slide}, {0.0}).deviation.max, 0);
  EXPECT_EQ(limited.positions, free.positions);
}

TEST(BoundedRun, TheExponentIsTwoWhereAreasCount) {
  // Angles get worse by it with either exponent.
  TriangleMesh squares = generate(ShapeKind::random_square, {.seed = 12, .triangles = 400});
  TriangleMesh by_default = squares;
  ProblemOptions options{.weights = EnergyWeights::from_mu(1), .boundary = BoundaryRule::slide};
  smooth_by_default(by_default, options);
  options.exponent = 2;
  smooth_by_default(squares, options);
  EXPECT_EQ(by_default.positions, squares.positions);
}

TEST(BoundedRun, TheLastStageDoesNotChangeTheExponent) {
  // Squashed so far that the worst angles get better at the cost of the mean.
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 1, .triangles = 400});
  for (Vec3& x : mesh.positions) x.y() *= 0.05;
  TriangleMesh smoothed = mesh;
  smooth_by_default(smoothed, {});
  run_bounded(
      mesh.positions, mesh.triangles, {},
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, {}, {},
      PolishOptions{});
  EXPECT_GE(measure_quality(mesh).min_angle_deg, measure_quality(smoothed).min_angle_deg);
}

TEST(BoundedRun, AHighExponentIsReachedInTheIterationsThereAre) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 200});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {.exponent = 64});
  const auto smoother = [](const SmoothingProblem& stage) { return make_jacobi(stage); };
  for (const unsigned iterations : {0U, 3U, 40U}) {
    std::vector<Vec3> x = mesh.positions;
    double reached = 0;
    const RunResult result =
        run_with_continuation(problem, smoother, x, {.iterations = iterations, .tolerance = 0}, {},
                              [&](unsigned /*done*/, double exponent) { reached = exponent; });
    EXPECT_EQ(reached, 64) << iterations;
    EXPECT_EQ(result.iterations, iterations);
  }
}

TEST(BoundedRun, OfWhatIsConvergedKeepsItsExponent) {
  const auto names_the_exponent = [](const std::string& note) {
    return note.find("exponent") != std::string::npos;
  };
  for (const unsigned seed : {1, 2, 3}) {
    TriangleMesh mesh =
        generate(ShapeKind::hexagonal_square, {.seed = seed, .triangles = 400, .jitter = 0.9});
    for (unsigned again = 0; again < 4; ++again) {
      const BoundedResult result = smooth_by_default(mesh, {.boundary = BoundaryRule::slide});
      EXPECT_TRUE(std::ranges::none_of(result.notes, names_the_exponent)) << seed << " " << again;
    }
  }
}

TEST(BoundedRun, EndsNotWhereStepsForAllFindNoWay) {
  TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 3, .triangles = 800});
  run_bounded(mesh.positions, mesh.triangles, {.exponent = 2},
              [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {},
              {0.002});
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, 42);  // 41.1 with L-BFGS alone
}

TEST(BoundedRun, EveryStepOfAStatedLimitKeepsIt) {
  const TriangleMesh start = generate(ShapeKind::torus, {.seed = 3, .triangles = 400, .jitter = 0.5});
  for (const SurfaceRule surface : {SurfaceRule::tangent, SurfaceRule::project}) {
    TriangleMesh mesh = start;
    const double limit = 0.3 * smooth(mesh, std::numeric_limits<double>::infinity(), surface).deviation.max;
    mesh = start;
    std::size_t limited = 0, attempts = 0;
    double largest = 0;
    run_bounded(
        mesh.positions, mesh.triangles, {.surface = surface},
        [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
        {.iterations = 12}, {limit},
        [&](unsigned, const StepRecord& record, std::span<const Vec3> positions) {
          limited += count_limits(record.limits)[6];
          TriangleMesh now = start;
          now.positions.assign(positions.begin(), positions.end());
          largest = std::max(largest, distance_between(start, now));
          return true;
        },
        PolishOptions{.iterations = 3},
        [&](const RunPart& part, std::span<const Vec3>) {
          attempts += part.done == 0 ? 1 : 0;
          EXPECT_TRUE(part.holds.still.empty());
        });
    EXPECT_LE(largest, limit);
    EXPECT_GT(largest, 0.5 * limit);
    EXPECT_GT(limited, 0U);
    EXPECT_EQ(attempts, 1U) << "nothing was found out too late";
    double farthest = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      farthest = std::max(farthest, (mesh.positions[v] - start.positions[v]).norm());
    EXPECT_GT(farthest, 10 * limit) << "vertices slide";
  }
}

TEST(BoundedRun, AFreeOutlineKeepsAStatedLimitToo) {
  const TriangleMesh start = generate(ShapeKind::hexagonal_square, {.seed = 4, .triangles = 460});
  TriangleMesh mesh = start;
  std::size_t attempts = 0;
  run_bounded(
      mesh.positions, mesh.triangles, {.boundary = BoundaryRule::free},
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, {0.01},
      {}, {}, [&](const RunPart& part, std::span<const Vec3>) { attempts += part.done == 0 ? 1 : 0; });
  EXPECT_LE(distance_between(start, mesh), 0.01);
  EXPECT_GT(distance_between(start, mesh), 0.005);
  EXPECT_EQ(attempts, 1U);
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, measure_quality(start).mean_min_angle_deg + 10);
}

TEST(BoundedRun, ATightLimitCostsLittleQuality) {
  TriangleMesh mesh = shaken_torus();
  const auto run_within = [&](double limit) {
    mesh = shaken_torus();
    return run_bounded(
               mesh.positions, mesh.triangles, {},
               [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
               {.iterations = 30}, {limit})
        .deviation.max;
  };
  const double free = run_within(std::numeric_limits<double>::infinity());
  const QualityReport best = measure_quality(mesh);
  EXPECT_LE(run_within(0.7 * free), 0.7 * free);
  // In which of several minima such a run ends is chance, and the worst triangle with it.
  EXPECT_GT(measure_quality(mesh).min_angle_deg, best.min_angle_deg - 20);
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, best.mean_min_angle_deg - 0.5);
}

TEST(BoundedRun, TellsWhichFeaturesHoldTheWorstTriangle) {
  // A flat box: its narrow sides are cut into needles between corners.
  TriangleMesh box;
  for (unsigned i = 0; i < 8; ++i) box.positions.emplace_back(i & 1U, (i >> 1U) & 1U, (i >> 2U) * 0.1);
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const auto notes = [&](const ProblemOptions& options) {
    TriangleMesh mesh = box;
    const auto told = run_bounded(mesh.positions, mesh.triangles, options,
                                  [](const SmoothingProblem& problem) { return make_newton(problem); },
                                  {.iterations = 2}, {});
    return std::ranges::count_if(told.notes, [](const std::string& note) {
      return note.starts_with(
          "the smallest angle, 5.71 degrees, is in triangle 4, of which 3 vertices are "
          "corners (0, 1, 5)");
    });
  };
  EXPECT_EQ(notes({}), 1);
  EXPECT_EQ(notes({.features = FeatureOptions::none()}), 0);
}

TEST(BoundedRun, ThinShellsDoNotComeToCrossThemselves) {
  TriangleMesh shell = generate(ShapeKind::sphere, {.seed = 5, .triangles = 1500, .jitter = 0.6});
  add_copy(shell, true, [](const Vec3& x) { return 0.997 * x; });
  const auto crossings = [&](const TriangleMesh& mesh) {
    return crossing_pairs({mesh.positions, mesh.triangles}, mesh.positions, mesh.triangles).size();
  };
  ASSERT_EQ(crossings(shell), 0U);
  TriangleMesh mesh = shell;
  // Wider than the shell is thick.
  const BoundedResult result =
      run_bounded(mesh.positions, mesh.triangles, {},
                  [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
                  {.iterations = 30}, {0.002});
  EXPECT_EQ(crossings(mesh), 0U);
  EXPECT_LE(result.deviation.max, 0.002);
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, measure_quality(shell).mean_min_angle_deg + 8);
}

TEST(BoundedRun, FreeBordersDoNotComeToOverlap) {
  TriangleMesh two = generate(ShapeKind::random_square, {.seed = 5, .triangles = 300});
  add_copy(two, false, [](const Vec3& x) { return Vec3(x + Vec3(1.002, 0, 0)); });
  const Topology topology(two.triangles, two.vertex_count());
  for (const double limit : {0.001, 0.02}) {
    TriangleMesh mesh = two;
    run_bounded(mesh.positions, mesh.triangles, {.boundary = BoundaryRule::free},
                [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
                {.iterations = 60}, {limit});
    EXPECT_TRUE(crossing_borders(mesh.positions, mesh.triangles, topology, Vec3::UnitZ()).empty()) << limit;
    EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, measure_quality(two).mean_min_angle_deg + 8);
  }
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
