#include "smoothing/turn_limit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "mesh/angle.h"

namespace isorelax {
namespace {

/// Two triangles with a common edge along y, the second one turned by an angle about it.
std::vector<Vec3> hinge(double turn_deg) {
  const double a = turn_deg / kDegrees;
  return {{0, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, {std::cos(a), 0.5, std::sin(a)}};
}
const std::vector<Triangle> kHinge = {{0, 1, 2}, {1, 0, 3}};

/// Whether triangle t turns back from the other one.
bool folds(const TurnLimit& limit, std::span<const Vec3> positions, Index t) {
  return limit.turns_back(t, limit.folds_of(positions, t));
}

SmoothingProblem problem_of(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  return make_problem(positions, triangles, {});
}

TEST(TurnLimit, AllowsAHingeToTurnByLessThan119Degrees) {
  const SmoothingProblem problem = problem_of(hinge(20), kHinge);
  const TurnLimit limit(problem);
  ASSERT_TRUE(limit.applies());
  for (const double turn : {0.0, 60.0, 118.9}) EXPECT_FALSE(folds(limit, hinge(turn), 0)) << turn;
  for (const double turn : {119.1, 150.0, 180.0}) {
    EXPECT_TRUE(folds(limit, hinge(turn), 0)) << turn;
    EXPECT_TRUE(folds(limit, hinge(turn), 1)) << turn;
  }
}

TEST(TurnLimit, LetsAnEdgeThatWasFoldedAlreadyTurnAsFarAsItsKind) {
  const auto turned = [](double from, double to) {
    const std::vector<Vec3> start = hinge(from);
    const SmoothingProblem problem = problem_of(start, kHinge);
    return folds(TurnLimit(problem), hinge(to), 0);
  };
  EXPECT_FALSE(turned(130, 148.9));
  EXPECT_TRUE(turned(130, 149.1));
  EXPECT_FALSE(turned(155, 175));
  // Between what is allowed and what counts as a fold it may stay.
  EXPECT_FALSE(turned(119.5, 119.5));
  EXPECT_TRUE(turned(119.5, 119.6));
}

TEST(TurnLimit, DoesNotApplyInAPlane) {
  const SmoothingProblem problem = problem_of(hinge(0), kHinge);
  EXPECT_FALSE(TurnLimit(problem).applies());
}

// Whatever two triangles do: where they fold onto each other, one is beyond its own cosine.
TEST(TurnLimit, FindsEveryFoldFromOneOfTheTwo) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(-1, 1);
  unsigned count = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Vec3> start = hinge(170 * u(engine));
    const SmoothingProblem problem = problem_of(start, kHinge);
    const TurnLimit limit(problem);
    if (!limit.applies()) continue;
    std::vector<Vec3> moved = start;
    for (Vec3& p : moved) p += Vec3(u(engine), u(engine), u(engine));
    if (!limit.folds_of(moved, 0).any()) continue;
    std::array<double, 2> squared{};
    for (Index t = 0; t < 2; ++t) {
      const auto& [a, b, c] = kHinge[t];
      const Vec3 area = area_vector(moved[a], moved[b], moved[c]);
      const double along = area.dot(problem.initial_normals[t]);
      squared[t] = along * std::abs(along) / area.squaredNorm();
    }
    const double most = TurnLimit::kLeastCosine * TurnLimit::kLeastCosine;
    EXPECT_TRUE(squared[0] <= limit.unfolded_cosine(0) || squared[1] <= most) << "case " << i;
    if (!folds(limit, moved, 0)) continue;
    ++count;
    EXPECT_TRUE(squared[0] <= limit.folding_cosine(0) + 1e-12 ||
                squared[1] <= limit.folding_cosine(1) + 1e-12)
        << "case " << i;
  }
  EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace isorelax
