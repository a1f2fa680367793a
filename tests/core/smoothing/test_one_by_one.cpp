#include "smoothing/one_by_one.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "generate/generate.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"
#include "smoothing/surface_limit.h"

namespace isorelax {
namespace {

/// A random sphere from which the mesh may go so little that many vertices end at the limit.
TriangleMesh tight_sphere() {
  return generate(ShapeKind::random_sphere, {.seed = 3, .triangles = 800});
}

SmoothingProblem kept_near(const TriangleMesh& mesh) {
  ProblemOptions options;
  options.holds.distance = 0.002 * bounding_diagonal(mesh.positions);
  return make_problem(mesh.positions, mesh.triangles, options);
}

std::size_t at_limit(const StepRecord& record) {
  return std::ranges::count_if(record.limits, [](auto limits) { return (limits & kLimitSurface) != 0; });
}

TEST(OneByOne, FindsAWayDownWhereStepsForAllFindNone) {
  TriangleMesh mesh = tight_sphere();
  const SmoothingProblem problem = kept_near(mesh);
  const auto lbfgs = make_lbfgs(problem);
  ASSERT_EQ(run(*lbfgs, problem, mesh.positions, {}).stopped, StopReason::stalled);
  const auto smoother = make_one_by_one(problem, RecordDetail::stages);
  StepRecord record;
  smoother->step(mesh.positions, record);
  EXPECT_LT(record.after.energy, 0.99 * record.before.energy);
  EXPECT_GT(record.before.gradient_norm, 0);
  EXPECT_GT(record.moved, 50U);
  EXPECT_GT(at_limit(record), 50U);
  ASSERT_TRUE(record.detail);
  apply_step(record, mesh.positions);
  EXPECT_TRUE(SurfaceLimit(problem).too_far(mesh.positions, SurfaceLimit::Blame::all).empty());
  EXPECT_TRUE(inverted_triangles(mesh.positions, mesh.triangles, problem.topology).empty());
}

TEST(OneByOne, IsWhatAutomaticRunsGoOverTo) {
  TriangleMesh automatic = tight_sphere(), lbfgs = tight_sphere();
  const SmoothingProblem problem = kept_near(automatic);
  const RunResult all = run(*make_lbfgs(problem), problem, lbfgs.positions, {});
  const RunResult some = run(*make_smoother(problem, Solver::automatic), problem, automatic.positions, {});
  EXPECT_LT(some.after.energy, 0.98 * all.after.energy);
  EXPECT_GT(measure_quality(automatic).mean_min_angle_deg, measure_quality(lbfgs).mean_min_angle_deg + 0.5);
}

TEST(OneByOne, AVertexThatIsHeldBackIsNotCalledConverged) {
  TriangleMesh mesh = tight_sphere();
  const SmoothingProblem problem = kept_near(mesh);
  const auto smoother = make_one_by_one(problem, RecordDetail::vertices);
  StepRecord record;
  for (unsigned i = 0; i < 10; ++i) {
    smoother->step(mesh.positions, record);
    apply_step(record, mesh.positions);
  }
  std::size_t held = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if ((record.limits[v] & kLimitSurface) == 0 || !record.displacement[v].isZero(0)) continue;
    EXPECT_EQ(record.limits[v] & kLimitConverged, 0) << v;
    ++held;
  }
  EXPECT_GT(held, 10U);
}

}  // namespace
}  // namespace isorelax
