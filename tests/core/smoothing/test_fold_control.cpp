#include "smoothing/fold_control.h"

#include <gtest/gtest.h>

#include <random>

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

}  // namespace
}  // namespace isorelax
