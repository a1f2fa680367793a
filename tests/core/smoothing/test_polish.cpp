#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "generate/generate.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/angle_ring.h"
#include "smoothing/polish.h"
#include "smoothing/polish_state.h"

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

/// The twelve vertices of five triangles keep angles from rising that hundreds of triangles have.
TriangleMesh icosphere(unsigned divisions) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Vec3& x : {Vec3(a, b, 0), Vec3(0, a, b), Vec3(b, 0, a)})
        mesh.positions.push_back(x.normalized());
  // Each three that are one edge apart.
  const double edge = 2 / std::sqrt(1 + golden * golden) + 1e-9;
  const auto near = [&](Index i, Index j) { return (mesh.positions[i] - mesh.positions[j]).norm() < edge; };
  for (Index i = 0; i < 12; ++i)
    for (Index j = i + 1; j < 12; ++j)
      for (Index k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const auto& x = mesh.positions;
        const bool outwards = area_vector(x[i], x[j], x[k]).dot(x[i]) > 0;
        mesh.triangles.push_back(outwards ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  for (unsigned division = 0; division < divisions; ++division) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), mesh.vertex_count());
      if (is_new) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> parts;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        parts.push_back(t);
    }
    mesh.triangles = std::move(parts);
  }
  return mesh;
}

TEST(Polish, GivesNoMeanAwayWhereTheWorstCannotRise) {
  const TriangleMesh sphere = icosphere(2);
  ASSERT_EQ(sphere.triangle_count(), 320U);
  const Polished worst = polish(sphere, {});
  const QualityReport run = measure_quality(worst.smoothed);
  const QualityReport after = measure_quality(worst.polished);
  EXPECT_NEAR(after.min_angle_deg, run.min_angle_deg, 1e-3);
  EXPECT_GT(after.mean_min_angle_deg, run.mean_min_angle_deg - 0.11);
  const QualityReport both = measure_quality(polish(sphere, {}, {.goal = PolishGoal::both}).polished);
  EXPECT_GE(both.mean_min_angle_deg, run.mean_min_angle_deg - 1e-9);
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

TEST(Polish, MovesGroupsWhereVerticesOneByOneAreHeld) {
  // One by one they end at 132.95 degrees; a linear program over all vertices finds 130.0, where the smallest
  // angle is 20.
  const Polished p = polish(generate(ShapeKind::random_square, {.seed = 7, .triangles = 500}), {});
  const QualityReport after = measure_quality(p.polished);
  EXPECT_GT(after.min_angle_deg, 19.99);
  EXPECT_LT(after.max_angle_deg, 130.5);
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

/// The smallest and the largest angle beyond which a tenth of the triangles have theirs.
AngleRange tenth(const TriangleMesh& mesh) {
  std::vector<double> smallest, largest;
  for (const Triangle& t : mesh.triangles) {
    const AngleRange r = angle_range(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    smallest.push_back(r.min);
    largest.push_back(-r.max);
  }
  std::ranges::sort(smallest);
  std::ranges::sort(largest);
  return {smallest[smallest.size() / 10], -largest[largest.size() / 10]};
}

TEST(Polish, MakesNoneOfTheWorstTenthWorseWhereManyCannotChange) {
  // A second square is regular and held: the worst are all in the first.
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 1, .triangles = 1000});
  const TriangleMesh regular = generate(ShapeKind::hexagonal_square, {.triangles = 1000, .jitter = 0});
  const Index first = mesh.vertex_count();
  ProblemOptions options;
  for (const Vec3& x : regular.positions) {
    options.pinned.push_back(mesh.vertex_count());
    mesh.positions.emplace_back(x + Vec3(2, 0, 0));
  }
  for (const auto& [a, b, c] : regular.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  const Polished p = polish(mesh, options, {.goal = PolishGoal::mean});
  const auto smallest = [&mesh](const TriangleMesh& at, Index t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return angle_range(at.positions[a], at.positions[b], at.positions[c]).min;
  };
  std::vector<Index> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, {}, [&](Index t) { return smallest(p.smoothed, t); });
  EXPECT_GT(measure_quality(p.polished).mean_min_angle_deg,
            measure_quality(p.smoothed).mean_min_angle_deg + 0.2);
  for (std::size_t i = 0; i < order.size() / 10; ++i)
    EXPECT_GE(smallest(p.polished, order[i]), smallest(p.smoothed, order[i]) - 1e-9) << i;
}

TEST(Polish, RaisesTheMeanWhileTheWorstTenthStayAsGood) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::hexagonal_square, ShapeKind::torus}) {
    const bool random = kind == ShapeKind::random_square;
    const TriangleMesh mesh =
        generate(kind, {.seed = 5, .triangles = 200, .jitter = random ? std::nullopt : std::optional(0.45)});
    const Polished mean = polish(mesh, {.boundary = BoundaryRule::slide}, {.goal = PolishGoal::mean});
    const QualityReport before = measure_quality(mean.smoothed);
    const QualityReport after = measure_quality(mean.polished);
    EXPECT_GT(after.mean_min_angle_deg, before.mean_min_angle_deg + 0.2);
    EXPECT_GE(after.min_angle_deg, before.min_angle_deg - 1e-9);
    EXPECT_LE(after.max_angle_deg, before.max_angle_deg + 1e-9);
    EXPECT_GE(tenth(mean.polished).min, tenth(mean.smoothed).min - 1e-9);
    EXPECT_LE(tenth(mean.polished).max, tenth(mean.smoothed).max + 1e-9);
  }
}

TEST(Polish, RaisesTheMeanFartherWhereOnlyTheVeryWorstIsKept) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 5, .triangles = 200});
  const QualityReport tenth = measure_quality(polish(mesh, {}, {.goal = PolishGoal::mean}).polished);
  const Polished worst = polish(mesh, {}, {.goal = PolishGoal::mean, .worst_share = 0});
  EXPECT_GT(measure_quality(worst.polished).mean_min_angle_deg, tenth.mean_min_angle_deg + 0.2);
  EXPECT_GE(measure_quality(worst.polished).min_angle_deg,
            measure_quality(worst.smoothed).min_angle_deg - 1e-9);
  EXPECT_LE(measure_quality(worst.polished).max_angle_deg,
            measure_quality(worst.smoothed).max_angle_deg + 1e-9);
}

TEST(Polish, RaisesTheMeanAfterTheWorst) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 5, .triangles = 200});
  const QualityReport worst = measure_quality(polish(mesh, {}).polished);
  const QualityReport both = measure_quality(polish(mesh, {}, {.goal = PolishGoal::both}).polished);
  EXPECT_GT(both.mean_min_angle_deg, worst.mean_min_angle_deg + 0.2);
  EXPECT_GE(both.min_angle_deg, worst.min_angle_deg - 1e-9);
  EXPECT_LE(both.max_angle_deg, worst.max_angle_deg + 1e-9);
}

TEST(Polish, FindsTheBestMeanOfAVertexAmongFour) {
  // A vertex in a square has four triangles whose smallest angles sum up to 180 degrees in the middle, and on
  // both diagonals there is no more.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.25, 0}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const auto smoother = make_polish(problem, {.goal = PolishGoal::mean});
  run(*smoother, problem, mesh.positions, {.iterations = 300, .tolerance = 1e-12});
  EXPECT_NEAR(measure_quality(mesh).mean_min_angle_deg, 45, 1e-3);
}

TEST(Polish, StaysInThePlaneOfAFreeSquareHoweverItLies) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = seed, .triangles = 100});
    const Eigen::AngleAxisd turn(0.7 + 0.3 * static_cast<double>(seed), Vec3(0.3, 0.5, 0.8).normalized());
    for (Vec3& x : mesh.positions) x = turn * x;
    const Polished p = polish(mesh, {.boundary = BoundaryRule::free}, {.goal = PolishGoal::mean});
    for (const Vec3& x : p.polished.positions) EXPECT_NEAR((turn.inverse() * x).z(), 0, 1e-13);
  }
}

TEST(Polish, KeepsBordersRidgesAndTheSurface) {
  const TriangleMesh mesh = generate(ShapeKind::part, {.seed = 2, .triangles = 800});
  const Polished p = polish(mesh, {.boundary = BoundaryRule::slide}, {.goal = PolishGoal::both});
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

TEST(Polish, GoesAlongWhatHoldsAVertexBack) {
  TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 3, .triangles = 800});
  const auto smoother = [](const SmoothingProblem& p) { return make_smoother(p, Solver::automatic); };
  double smoothed = 0;
  run_bounded(mesh.positions, mesh.triangles, {.exponent = 2}, smoother, {}, {0.002}, {},
              PolishOptions{.goal = PolishGoal::mean}, [&](const RunPart& part, std::span<const Vec3> x) {
                if (part.polish)
                  smoothed = measure_quality({{x.begin(), x.end()}, mesh.triangles, {}}).mean_min_angle_deg;
              });
  EXPECT_GT(measure_quality(mesh).mean_min_angle_deg, smoothed + 0.5);
}

TEST(Polish, DoesNotDependOnThreads) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 4, .triangles = 1000});
  const PolishOptions both{.goal = PolishGoal::both};
  EXPECT_EQ(polish(mesh, {.threads = 1}, both).polished.positions,
            polish(mesh, {.threads = 2}, both).polished.positions);
}

TEST(Polish, LeavesARegularMeshAlone) {
  std::vector<Vec3> x = {Vec3::Zero()};
  std::vector<Triangle> triangles;
  for (Index k = 0; k < 6; ++k) {
    x.emplace_back(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
    triangles.push_back({0, k + 1, (k + 1) % 6 + 1});
  }
  const SmoothingProblem problem = make_problem(x, triangles, {});
  for (const PolishGoal goal : {PolishGoal::worst, PolishGoal::mean}) {
    StepRecord record;
    make_polish(problem, {.goal = goal})->step(x, record);
    EXPECT_LT(record.displacement[0].norm(), 1e-9);
  }
}

TEST(Polish, FollowsTheGradientsOfTheSoftMinima) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 9, .triangles = 100});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  AngleRing ring(problem);
  ring.aim_at({{10, 150}, 2});
  const double h = 1e-6 * problem.mean_edge_length;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (problem.mobility[v] == Mobility::none) continue;
    ring.look_at(mesh.positions, v);
    const Vec3 at = mesh.positions[v];
    const Vec3 of_all = ring.soft_minimum(at, 0.5).gradient;
    const Vec3 of_each = ring.sum_of_soft_minima(at, 0.5).gradient;
    for (unsigned k = 0; k < 2; ++k) {
      const Vec3 after = at + h * Vec3::Unit(k);
      const Vec3 before = at - h * Vec3::Unit(k);
      EXPECT_NEAR(of_all[k],
                  (ring.soft_minimum_value(after, 0.5) - ring.soft_minimum_value(before, 0.5)) / (2 * h),
                  1e-4 * (1 + of_all.norm()));
      EXPECT_NEAR(
          of_each[k],
          (ring.sum_of_soft_minima_value(after, 0.5) - ring.sum_of_soft_minima_value(before, 0.5)) / (2 * h),
          1e-4 * (1 + of_each.norm()));
    }
  }
}

TEST(PolishState, AVertexIsStuckUntilSomethingAboutItChanges) {
  const TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 200, .jitter = 0.1});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const Topology& topology = problem.topology;
  Index vertex = 0;
  while (topology.is_boundary(vertex)) ++vertex;
  const Corner corner = topology.corners_of(vertex)[0];
  const Index neighbour = mesh.triangles[corner / 3][next(corner % 3)];
  Index far = mesh.vertex_count() - 1;
  while (topology.is_boundary(far)) --far;
  PolishState state(problem);
  state.start(mesh.positions);
  EXPECT_FALSE(state.is_stuck(vertex));
  const auto move = [&](Index v) {
    state.look_at(v);
    state.move(v, state.positions()[v] + Vec3(1e-5, 0, 0));
  };
  state.note_stuck(vertex);
  EXPECT_TRUE(state.is_stuck(vertex));
  move(far);
  EXPECT_TRUE(state.is_stuck(vertex));
  move(neighbour);
  EXPECT_FALSE(state.is_stuck(vertex));
  state.note_stuck(vertex);
  move(vertex);
  EXPECT_FALSE(state.is_stuck(vertex));
  state.note_stuck(vertex);
  state.start(mesh.positions);
  EXPECT_FALSE(state.is_stuck(vertex));
}

TEST(Polish, DoesNotDependOnTheUnitOfLength) {
  const TriangleMesh mesh = generate(ShapeKind::cylinder, {.seed = 1, .triangles = 1000, .jitter = 0.8});
  constexpr double kUnit = 1 << 20;
  TriangleMesh small = mesh;
  for (Vec3& p : small.positions) p /= kUnit;
  const TriangleMesh polished = polish(mesh, {}).polished;
  const TriangleMesh small_polished = polish(small, {}).polished;
  double far = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    far = std::max(far, (polished.positions[v] - kUnit * small_polished.positions[v]).norm());
  EXPECT_LT(far, 1e-9);
}

}  // namespace
}  // namespace isorelax
