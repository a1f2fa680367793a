#include "smoothing/limit_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"

namespace isorelax {
namespace {

AutomaticLimits limits_of(const TriangleMesh& mesh, const ProblemOptions& options = {}) {
  return automatic_limits(mesh.positions, make_problem(mesh.positions, mesh.triangles, options), options);
}

struct Smoothed {
  QualityReport quality;
  BoundedResult result;
  std::size_t attempts = 0;
  TriangleMesh mesh;
};

Smoothed smooth(TriangleMesh mesh, const DeviationLimit& limit,
                const std::optional<PolishOptions>& polish = {}) {
  Smoothed smoothed;
  smoothed.result = run_bounded(
      mesh.positions, mesh.triangles, {},
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, limit,
      {}, polish, [&](const RunPart& part, auto) { smoothed.attempts += part.done == 0 ? 1 : 0; });
  smoothed.quality = measure_quality(mesh);
  smoothed.mesh = std::move(mesh);
  return smoothed;
}

TriangleMesh sphere() {
  return generate(ShapeKind::random_sphere, {.seed = 3, .vertices = 2000});
}

/// Flat but for a bump in the middle, whose triangles are much higher than those of the mean.
TriangleMesh bump(double height = 0.25) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 1, .triangles = 1200});
  for (Vec3& x : mesh.positions) {
    const double squared = (x - Vec3(0.5, 0.5, 0)).squaredNorm();
    x.z() = height * std::exp(-squared / 0.02);
  }
  return mesh;
}

TEST(LimitChoice, FineSurfacesHaveANearerLimit) {
  EXPECT_LT(limits_of(sphere()).nearest, 0.5 * 0.003);
  EXPECT_EQ(limits_of(sphere()).widest, 0.003);
  EXPECT_EQ(limits_of(bump(0.02)).nearest, 0.003 / 8);
}

TEST(LimitChoice, CoarseSurfacesPlanesAndFreeBordersDoNot) {
  for (const AutomaticLimits& limits : {limits_of(generate(ShapeKind::sphere, {.vertices = 200})),
                                        limits_of(generate(ShapeKind::random_square, {.triangles = 200})),
                                        limits_of(bump(), {.boundary = BoundaryRule::free}),
                                        limits_of(sphere(), {.surface = SurfaceRule::tangent})})
    EXPECT_EQ(limits.nearest, limits.widest);
}

TEST(LimitChoice, WithoutABorderNothingIsFree) {
  EXPECT_EQ(limits_of(sphere(), {.boundary = BoundaryRule::free}).nearest, limits_of(sphere()).nearest);
  EXPECT_EQ(limits_of(sphere(), {.boundary = BoundaryRule::free}).widest, limits_of(sphere()).widest);
}

TEST(LimitChoice, ASphereStaysNearSinceThatCostsNothing) {
  const Smoothed wide = smooth(sphere(), {0.003});
  const Smoothed chosen = smooth(sphere(), {});
  EXPECT_EQ(chosen.attempts, 1U);
  EXPECT_EQ(chosen.result.deviation_limit, limits_of(sphere()).nearest);
  EXPECT_LE(chosen.result.deviation.max, chosen.result.deviation_limit);
  EXPECT_LT(chosen.result.deviation.max, 0.85 * wide.result.deviation.max);
  EXPECT_GT(chosen.quality.min_angle_deg, wide.quality.min_angle_deg - 1);
  EXPECT_LT(chosen.quality.max_angle_deg, wide.quality.max_angle_deg + 2);
  EXPECT_GT(chosen.quality.mean_min_angle_deg, wide.quality.mean_min_angle_deg - 0.3);
}

/// Largest change of the distance from the middle.
double off_sphere(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& x : mesh.positions) largest = std::max(largest, std::abs(x.norm() - 1));
  return largest;
}

TEST(LimitChoice, ASphereStaysRoundWhereItsTrianglesAreFarBelow) {
  const Smoothed chosen = smooth(sphere(), {});
  EXPECT_LT(off_sphere(chosen.mesh), 1e-5);
  const Smoothed stated = smooth(sphere(), {chosen.result.deviation_limit});
  EXPECT_GT(off_sphere(stated.mesh), 1e-4) << "within a stated limit, height is given up before way";
  EXPECT_GE(stated.quality.mean_min_angle_deg, chosen.quality.mean_min_angle_deg);
}

TEST(LimitChoice, OnlySurfacesWhoseFitsAgreeAreHeldToThem) {
  EXPECT_TRUE(limits_of(sphere()).on_fits);
  EXPECT_FALSE(limits_of(bump()).on_fits);
  EXPECT_FALSE(limits_of(generate(ShapeKind::random_square, {.triangles = 200})).on_fits);
  const TriangleMesh torus = generate(ShapeKind::torus, {.seed = 2, .triangles = 2000, .jitter = 0.6});
  EXPECT_GT(limits_of(torus).widest, 0.005);
  EXPECT_GT(smooth(torus, {}).quality.min_angle_deg, 54);
}

TEST(LimitChoice, EitherLimitCanBeAskedFor) {
  const AutomaticLimits limits = limits_of(bump());
  ASSERT_LT(limits.nearest, limits.widest);
  for (const auto& [asked, expected] : {std::pair(AutomaticLimit::nearest, limits.nearest),
                                        std::pair(AutomaticLimit::widest, limits.widest)}) {
    const Smoothed smoothed = smooth(bump(), {.max = {}, .automatic = asked});
    EXPECT_EQ(smoothed.attempts, 1U);
    EXPECT_EQ(smoothed.result.deviation_limit, expected);
    EXPECT_LE(smoothed.result.deviation.max, expected);
  }
}

TEST(LimitChoice, ABumpGetsTheWiderLimitSinceThatPays) {
  const Smoothed near = smooth(bump(), {limits_of(bump()).nearest});
  const Smoothed wide = smooth(bump(), {0.003});
  ASSERT_GT(wide.quality.min_angle_deg, near.quality.min_angle_deg + 1);
  const Smoothed chosen = smooth(bump(), {});
  EXPECT_EQ(chosen.attempts, 2U);
  EXPECT_EQ(chosen.result.deviation_limit, 0.003);
  EXPECT_EQ(chosen.quality.min_angle_deg, wide.quality.min_angle_deg);
  EXPECT_EQ(chosen.quality.mean_min_angle_deg, wide.quality.mean_min_angle_deg);
}

class CountingSmoother : public Smoother {
 public:
  CountingSmoother(std::unique_ptr<Smoother> smoother, std::size_t& steps)
      : smoother_(std::move(smoother)), steps_(steps) {}
  void step(std::span<const Vec3> positions, StepRecord& record) override {
    ++steps_;
    smoother_->step(positions, record);
  }

 private:
  std::unique_ptr<Smoother> smoother_;
  std::size_t& steps_;
};

TEST(LimitChoice, AShortRunMakesNoLongTrial) {
  TriangleMesh mesh = sphere();
  std::size_t steps = 0;
  run_bounded(mesh.positions, mesh.triangles, {},
              [&](const SmoothingProblem& problem) {
                return std::make_unique<CountingSmoother>(make_smoother(problem, Solver::automatic), steps);
              },
              {.iterations = 2}, {});
  EXPECT_GT(steps, 2U);
  EXPECT_LE(steps, 6U);
}

TEST(LimitChoice, ThePolishMayGoToTheWiderLimit) {
  const Smoothed run = smooth(sphere(), {});
  const Smoothed polished = smooth(sphere(), {}, PolishOptions{});
  EXPECT_EQ(polished.result.run.iterations, run.result.run.iterations);
  EXPECT_EQ(polished.result.deviation_limit, 0.003);
  EXPECT_GT(polished.quality.min_angle_deg, run.quality.min_angle_deg);
  EXPECT_LT(polished.quality.max_angle_deg, run.quality.max_angle_deg);
}

}  // namespace
}  // namespace isorelax
