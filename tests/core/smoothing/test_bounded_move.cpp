#include "smoothing/bounded_move.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace isorelax {
namespace {

double model(const NewtonBlock& block, const Vec3& g, const Vec3& m) {
  const double a = block.t1.dot(m), b = block.t2.dot(m);
  return g.dot(m) - 0.5 * (block.h11 * a * a + 2 * block.h12 * a * b + block.h22 * b * b);
}

bool is_within(const Vec3& m, std::span<const MoveBound> bounds) {
  return std::ranges::all_of(bounds, [&](const MoveBound& b) {
    return b.gradient.dot(m) + b.slack >= -1e-9 * (1 + b.gradient.norm());
  });
}

TEST(BestMove, IsNewtonsWithinNoBounds) {
  NewtonBlock block(Mobility::plane, Vec3::UnitZ());
  block.h11 = 2, block.h12 = 0.5, block.h22 = 1;
  const Vec3 g(1, -2, 3);
  EXPECT_LT((best_move(block, g, {}) - block.solve(g)).norm(), 1e-15);
}

TEST(BestMove, SlidesAlongABound) {
  NewtonBlock block(Mobility::plane, Vec3::UnitZ());
  block.h11 = block.h22 = 1;
  const MoveBound wall{-Vec3::UnitX(), 0.25};  // x <= 0.25
  EXPECT_LT((best_move(block, {1, 2, 0}, std::span(&wall, 1)) - Vec3(0.25, 2, 0)).norm(), 1e-15);
}

TEST(BestMove, StaysInACornerThatItIsPressedInto) {
  NewtonBlock block(Mobility::plane, Vec3::UnitZ());
  block.h11 = block.h22 = 1;
  const std::array<MoveBound, 2> walls = {{{-Vec3::UnitX(), 0}, {-Vec3::UnitY(), 0}}};
  EXPECT_LT(best_move(block, {1, 2, 0}, walls).norm(), 1e-15);
}

// No point of a fine grid within the bounds is better.
TEST(BestMove, IsTheBestWithinRandomBounds) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 300; ++i) {
    NewtonBlock block(Mobility::plane, Vec3(u(engine), u(engine), u(engine)).normalized());
    const double a = u(engine), b = u(engine), c = u(engine);
    block.h11 = 0.2 + a * a, block.h12 = a * b, block.h22 = 0.2 + b * b + c * c;
    const Vec3 g(u(engine), u(engine), u(engine));
    std::vector<MoveBound> bounds;
    bounds.reserve(12);
    for (int k = 0; k < 12; ++k)
      bounds.push_back({Vec3(u(engine), u(engine), u(engine)), std::max(0.0, u(engine))});
    const Vec3 best = best_move(block, g, bounds);
    EXPECT_TRUE(is_within(best, bounds)) << "case " << i;
    for (double x = -4; x <= 4; x += 0.1) {
      for (double y = -4; y <= 4; y += 0.1) {
        const Vec3 m = x * block.t1 + y * block.t2;
        const bool within = std::ranges::all_of(
            bounds, [&](const MoveBound& bound) { return bound.gradient.dot(m) + bound.slack >= 0; });
        if (!within) continue;
        EXPECT_LE(model(block, g, m), model(block, g, best) + 1e-9) << "case " << i;
      }
    }
  }
}

}  // namespace
}  // namespace isorelax
