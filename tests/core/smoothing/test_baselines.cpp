#include "smoothing/baselines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.h"
#include "quality/report.h"
#include "smoothing/unguarded_run.h"

namespace isorelax {
namespace {

struct Baseline {
  const char* name;
  SmootherFactory make;
};

std::vector<Baseline> baselines(BaselineGuard guard) {
  const auto laplacian = [guard](LaplacianWeighting weighting) {
    return [=](const SmoothingProblem& problem) {
      return make_laplacian(problem, {.weighting = weighting, .guard = guard});
    };
  };
  const auto angle_based = [guard](AngleWeighting weighting) {
    return [=](const SmoothingProblem& problem) {
      return make_angle_based(problem, {.weighting = weighting, .guard = guard});
    };
  };
  return {{"uniform Laplacian", laplacian(LaplacianWeighting::uniform)},
          {"length-weighted Laplacian", laplacian(LaplacianWeighting::length)},
          {"plain angle-based", angle_based(AngleWeighting::plain)},
          {"weighted angle-based", angle_based(AngleWeighting::angle)}};
}

/// Vertex 0 inside a polygon, joined to all its corners.
TriangleMesh fan(const Vec3& middle, const std::vector<Vec3>& polygon) {
  TriangleMesh mesh;
  mesh.positions = {middle};
  mesh.positions.insert(mesh.positions.end(), polygon.begin(), polygon.end());
  const auto n = static_cast<Index>(polygon.size());
  for (Index i = 0; i < n; ++i) mesh.triangles.push_back({0, i + 1, (i + 1) % n + 1});
  return mesh;
}

const std::vector<Vec3> kPentagon = {{2, 0, 0}, {1, 2, 0}, {-1, 1.5, 0}, {-2, -1, 0}, {1, -1.5, 0}};

/// Where the middle of a fan goes in one step.
Vec3 stepped(const TriangleMesh& mesh, const SmootherFactory& make) {
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  StepRecord record;
  make(problem)->step(mesh.positions, record);
  std::vector<Vec3> moved = mesh.positions;
  apply_step(record, moved);
  return moved[0];
}

TEST(Laplacian, GoesToTheMeanOfTheNeighbours) {
  const TriangleMesh mesh = fan({0.3, 0.1, 0}, kPentagon);
  const auto make = [](const SmoothingProblem& problem) {
    return make_laplacian(problem, {.weighting = LaplacianWeighting::uniform});
  };
  EXPECT_LT((stepped(mesh, make) - Vec3(0.2, 0.2, 0)).norm(), 1e-14);
}

TEST(Laplacian, WeightsNeighboursByTheLengthOfTheEdge) {
  const TriangleMesh mesh = fan({0.3, 0.1, 0}, kPentagon);
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const Vec3& p : kPentagon) {
    const double length = (p - mesh.positions[0]).norm();
    sum += length * p;
    total += length;
  }
  const auto whole = [](const SmoothingProblem& problem) {
    return make_laplacian(problem, {.relaxation = 1});
  };
  const auto half = [](const SmoothingProblem& problem) { return make_laplacian(problem); };
  EXPECT_LT((stepped(mesh, whole) - sum / total).norm(), 1e-14);
  EXPECT_LT((stepped(mesh, half) - 0.5 * (mesh.positions[0] + sum / total)).norm(), 1e-14);
}

TEST(AngleBased, TurnsToTheBisectorsAtTheNeighbours) {
  const TriangleMesh mesh = fan({0.3, 0.1, 0}, kPentagon);
  for (const AngleWeighting weighting : {AngleWeighting::plain, AngleWeighting::angle}) {
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (std::size_t j = 0; j < 5; ++j) {
      // On the bisector of the polygon's angle at j, as far from j as before.
      const Vec3 to_next = (kPentagon[(j + 1) % 5] - kPentagon[j]).normalized();
      const Vec3 to_previous = (kPentagon[(j + 4) % 5] - kPentagon[j]).normalized();
      const double angle = std::acos(to_next.dot(to_previous));
      const double weight = weighting == AngleWeighting::plain ? 1 : 1 / (angle * angle);
      const double distance = (mesh.positions[0] - kPentagon[j]).norm();
      sum += weight * (kPentagon[j] + distance * (to_next + to_previous).normalized());
      total += weight;
    }
    const auto make = [&](const SmoothingProblem& problem) {
      return make_angle_based(problem, {.weighting = weighting});
    };
    EXPECT_LT((stepped(mesh, make) - sum / total).norm(), 1e-14);
  }
}

TEST(Baselines, LeaveARegularMeshWhereItIs) {
  const TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 500, .jitter = 0});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  for (const Baseline& baseline : baselines(BaselineGuard::on)) {
    StepRecord record;
    baseline.make(problem)->step(mesh.positions, record);
    std::size_t inner = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& p = mesh.positions[v];
      if (std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.2) continue;
      ++inner;
      EXPECT_LT(record.displacement[v].norm(), 1e-12) << baseline.name;
    }
    EXPECT_GT(inner, 20U);
  }
}

TEST(Baselines, FoldAnArrowWithoutAGuardAndKeepItWithOne) {
  // From the middle of the tip the mean of the corners lies beyond the notch.
  const TriangleMesh mesh = fan({0, 1.8, 0}, {{0, 1.5, 0}, {3, -3, 0}, {0, 2, 0}, {-3, -3, 0}});
  for (const BaselineGuard guard : {BaselineGuard::off, BaselineGuard::on}) {
    for (const Baseline& baseline : {baselines(guard)[0], baselines(guard)[1]}) {
      TriangleMesh copy = mesh;
      const UnguardedResult result =
          run_unguarded(copy.positions, copy.triangles, {}, baseline.make, {.iterations = 5});
      EXPECT_EQ(result.turned_over.size(), guard == BaselineGuard::on ? 0U : 2U) << baseline.name;
      EXPECT_EQ(measure_quality(copy).inverted, result.turned_over.size()) << baseline.name;
    }
  }
}

TEST(Baselines, NeverTurnATriangleWithAGuard) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::random_sphere, ShapeKind::part}) {
    const TriangleMesh mesh = generate(kind, {.seed = 9, .triangles = 1000});
    const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
    for (const Baseline& baseline : baselines(BaselineGuard::on)) {
      std::vector<Vec3> x = mesh.positions;
      const auto smoother = baseline.make(problem);
      StepRecord record;
      for (int i = 0; i < 15; ++i) {
        const std::vector<Vec3> before = x;
        smoother->step(before, record);
        apply_step(record, x);
        for (const Triangle& t : problem.triangles) {
          const Vec3 was = area_vector(before[t[0]], before[t[1]], before[t[2]]);
          const Vec3 is = area_vector(x[t[0]], x[t[1]], x[t[2]]);
          ASSERT_GT(was.dot(is), 0) << baseline.name << " step " << i;
        }
      }
    }
  }
}

TEST(Baselines, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 4, .vertices = 3000});
  for (const Baseline& baseline : baselines(BaselineGuard::on)) {
    std::vector<std::vector<Vec3>> results;
    for (const unsigned threads : {1U, 2U, 5U}) {
      std::vector<Vec3> x = mesh.positions;
      const SmoothingProblem problem = make_problem(x, mesh.triangles, {.threads = threads});
      run(*baseline.make(problem), problem, x, {.iterations = 5});
      results.push_back(std::move(x));
    }
    EXPECT_EQ(results[0], results[1]) << baseline.name;
    EXPECT_EQ(results[0], results[2]) << baseline.name;
  }
}

TEST(Baselines, ReachOnRandomSquaresWhatIsKnownOfThem) {
  // Smallest and largest angle and mean of the smallest ones after 50 steps, over three meshes.
  struct Known {
    double least, most, mean;
  };
  const std::array<Known, 4> known = {{{2, 176, 43.8}, {1, 178, 43.3}, {11, 152, 42.2}, {12, 147, 42.4}}};
  const auto all = baselines(BaselineGuard::off);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = seed, .triangles = 2126});
      const UnguardedResult result =
          run_unguarded(mesh.positions, mesh.triangles, {}, all[i].make, {.iterations = 50, .tolerance = 0});
      const QualityReport quality = measure_quality(mesh);
      EXPECT_TRUE(result.turned_over.empty()) << all[i].name;
      EXPECT_GT(quality.min_angle_deg, known[i].least) << all[i].name << " seed " << seed;
      EXPECT_LT(quality.max_angle_deg, known[i].most) << all[i].name << " seed " << seed;
      EXPECT_NEAR(quality.mean_min_angle_deg, known[i].mean, 1.5) << all[i].name << " seed " << seed;
    }
  }
}

TEST(Baselines, StayOnACurvedSurface) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 2, .vertices = 1500});
  for (const Baseline& baseline : baselines(BaselineGuard::on)) {
    TriangleMesh copy = mesh;
    run_bounded(copy.positions, copy.triangles, {}, baseline.make, {.iterations = 20}, {.max = 0.01});
    for (const Vec3& p : copy.positions) ASSERT_NEAR(p.norm(), 1, 1e-3) << baseline.name;
    EXPECT_GT(measure_quality(copy).mean_min_angle_deg, measure_quality(mesh).mean_min_angle_deg + 8)
        << baseline.name;
  }
}

TEST(Baselines, StopWhenNothingMovesThoughTheEnergyMayRise) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 300});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  for (const Baseline& baseline : baselines(BaselineGuard::on)) {
    std::vector<Vec3> x = mesh.positions;
    const RunResult result =
        run(*baseline.make(problem), problem, x, {.iterations = 3000, .tolerance = 1e-6});
    EXPECT_EQ(result.stopped, StopReason::movement) << baseline.name;
    EXPECT_LE(result.relative_move, 1e-6) << baseline.name;
  }
}

}  // namespace
}  // namespace isorelax
