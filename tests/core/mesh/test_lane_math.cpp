#include "mesh/lane_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace isorelax {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double angle_of(double y, double x) {
  Lanes ys{}, xs{}, angles{};
  ys.at[3] = y;
  xs.at[3] = x;
  angles_deg(ys, xs, angles);
  return angles.at[3];
}

double exp_of(double x) {
  Lanes xs{}, powers{};
  xs.at[5] = x;
  exp_of_negative(xs, powers);
  return powers.at[5];
}

TEST(LaneMath, AnglesOfTheAxesAndDiagonalsAreExact) {
  EXPECT_EQ(angle_of(0, 1), 0);
  EXPECT_EQ(angle_of(1, 1), 45);
  EXPECT_EQ(angle_of(1, 0), 90);
  EXPECT_EQ(angle_of(1, -1), 135);
  EXPECT_EQ(angle_of(0, -1), 180);
  EXPECT_EQ(angle_of(0, 0), 0);
}

TEST(LaneMath, AnglesAreThoseOfTheLibrary) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double size = std::exp2(200 * (u(engine) - 0.5));
    const double tilt = std::exp2(60 * (u(engine) - 0.5));
    const double y = size * u(engine), x = size * tilt * (2 * u(engine) - 1);
    const double expected = std::atan2(y, x) * 180 / std::numbers::pi;
    // A small angle is as exact as a large one.
    EXPECT_NEAR(angle_of(y, x), expected, 4 * kEpsilon * (x > 0 ? expected : 180)) << y << ", " << x;
  }
}

TEST(LaneMath, PowersAreThoseOfTheLibrary) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(0, 1);
  EXPECT_EQ(exp_of(0), 1);
  EXPECT_EQ(exp_of(-std::numeric_limits<double>::infinity()), 0);
  for (int i = 0; i < 20000; ++i) {
    const double x = -690 * std::pow(u(engine), 4);
    EXPECT_NEAR(exp_of(x), std::exp(x), 4 * kEpsilon * std::exp(x)) << x;
  }
}

}  // namespace
}  // namespace isorelax
