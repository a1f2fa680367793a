#include "smoothing/fold_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "generate/generate.h"

namespace isorelax {
namespace {

using Points = std::array<Vec3, 3>;
const Points kTriangle = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

TEST(FoldFreeShare, IsOneForAMoveThatKeepsTheTriangle) {
  EXPECT_EQ(fold_free_share(kTriangle, kTriangle), 1);
  EXPECT_EQ(fold_free_share(kTriangle, {Vec3{5, 5, 5}, Vec3{6, 5, 5}, Vec3{5, 6, 5}}), 1);
}

TEST(FoldFreeShare, StopsAtTheSafeFractionOfTheWayToZeroArea) {
  // The apex crosses the base line after a quarter of the way.
  EXPECT_NEAR(fold_free_share(kTriangle, {kTriangle[0], kTriangle[1], Vec3{0, -3, 0}}), 0.6 * 0.25, 1e-15);
}

TEST(FoldFreeShare, FindsTheFirstRootWhenTheTriangleTurnsOverAndBack) {
  // Both legs turn by half a circle in a straight motion: the area along it is (1 - 2 a)^2.
  EXPECT_NEAR(fold_free_share(kTriangle, {kTriangle[0], -kTriangle[1], -kTriangle[2]}), 0.6 * 0.5, 1e-12);
}

TEST(FoldFreeShare, LeavesAreaForRandomMoves) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(-2, 2);
  const auto point = [&] { return Vec3(u(engine), u(engine), u(engine)); };
  for (int i = 0; i < 2000; ++i) {
    const Points x = {point(), point(), point()};
    const Points y = {point(), point(), point()};
    const double share = fold_free_share(x, y);
    ASSERT_GT(share, 0);
    ASSERT_LE(share, 1);
    const Vec3 normal = area_vector(x[0], x[1], x[2]);
    for (double a = 0; a <= 1; a += 0.05) {
      const auto at = [&](unsigned k) { return Vec3(x[k] + a * share * (y[k] - x[k])); };
      EXPECT_GT(area_vector(at(0), at(1), at(2)).dot(normal), 0) << "case " << i << " at " << a;
    }
  }
}

/// Moves under which a square's vertices slide in x by this much, to the right in every other of the bands
/// of this width, else to the left.
StepRecord banded_moves(const SmoothingProblem& problem, std::span<const Vec3> x, double move, double width) {
  StepRecord record;
  for (Index v = 0; v < problem.vertex_count(); ++v) {
    const bool right = static_cast<int>(x[v].x() / width) % 2 == 0;
    const bool moves = problem.mobility[v] != Mobility::none;
    record.displacement.emplace_back(!moves ? 0 : right ? move : -move, 0, 0);
  }
  record.alpha.assign(x.size(), 1);
  record.limits = problem.fixed_limits;
  return record;
}

// Where groups of vertices are sent into each other, single ones are held up, then those that run into them,
// and so on, where a shorter way is open to all.
TEST(FoldControl, CutsMovesThatGoTogetherBackAlike) {
  const TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 2000, .jitter = 0});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const double edge = problem.mean_edge_length;
  const auto cut = [&](bool together) {
    StepRecord record = banded_moves(problem, mesh.positions, 2 * edge, 2.2 * edge);
    Trial trial(problem);
    FoldControl control(problem);
    trial.start(mesh.positions, record);
    control.limit(trial, record, together);
    for (const auto& [a, b, c] : mesh.triangles) {
      EXPECT_GT(area_vector(trial.to()[a], trial.to()[b], trial.to()[c]).z(), 0);
    }
    return record;
  };
  const StepRecord alone = cut(false), together = cut(true);
  const double most = *std::ranges::max_element(together.alpha, {}, [](double a) { return a < 1 ? a : 0; });
  EXPECT_GE(most, 1.0 / 16);
  const auto inner = std::ranges::count(problem.mobility, Mobility::plane);
  EXPECT_GT(std::ranges::count(together.alpha, most), inner * 7 / 10);
  EXPECT_LT(std::ranges::count(alone.alpha, most), inner / 2);
  for (Index v = 0; v < problem.vertex_count(); ++v) {
    const bool moves = problem.mobility[v] != Mobility::none;
    EXPECT_EQ((together.limits[v] & kLimitFold) != 0, moves) << v;
  }
}

// A few that are in each other's way are no reason to cut back all.
TEST(FoldControl, CutsASingleFoldBackAlone) {
  const TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 2000, .jitter = 0});
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  StepRecord record = banded_moves(problem, mesh.positions, 0.1 * problem.mean_edge_length, INFINITY);
  const auto inner = std::ranges::find(problem.mobility, Mobility::plane) - problem.mobility.begin();
  record.displacement[static_cast<std::size_t>(inner)] *= 30;
  Trial trial(problem);
  FoldControl control(problem);
  trial.start(mesh.positions, record);
  control.limit(trial, record, true);
  EXPECT_GT(std::ranges::count(record.alpha, 1.0), static_cast<std::ptrdiff_t>(record.alpha.size()) * 9 / 10);
  EXPECT_LT(record.alpha[static_cast<std::size_t>(inner)], 1);
}

}  // namespace
}  // namespace isorelax
