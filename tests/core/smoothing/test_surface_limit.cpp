#include "smoothing/surface_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/surface/shapes.h"
#include "smoothing/run.h"

namespace isorelax {
namespace {

constexpr double kDistance = 0.1;

/// All may move, but none farther from the surface than this.
SmoothingProblem kept_near(std::span<const Vec3> x, std::span<const Triangle> triangles,
                           double distance = kDistance) {
  ProblemOptions options;
  options.surface = SurfaceRule::tangent;
  options.boundary = BoundaryRule::free;
  options.holds.distance = distance;
  return make_problem(x, triangles, options);
}

/// A pyramid without its base: vertex 0 is the tip, over a hexagon of radius 1.
std::vector<Vec3> tent_of(double height) {
  std::vector<Vec3> x{{0, 0, height}};
  for (int i = 0; i < 6; ++i)
    x.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0);
  return x;
}

struct Tent {
  std::vector<Vec3> x;
  SmoothingProblem problem;

  explicit Tent(double height)
      : x(tent_of(height)),
        problem(kept_near(
            x, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}})) {}

  /// Vertices to blame with the tip at `tip`.
  [[nodiscard]] std::vector<Index> blamed(const Vec3& tip) const {
    SurfaceLimit limit(problem);
    std::vector<Vec3> moved = x;
    moved[0] = tip;
    std::vector<Index> vertices;
    for (const auto& excess : limit.too_far(moved, SurfaceLimit::Blame::movers))
      if (vertices.empty() || vertices.back() != excess.vertex) vertices.push_back(excess.vertex);
    return vertices;
  }
};

TEST(SurfaceLimit, WithoutALimitNothingIsTooFar) {
  Tent tent(0.5);
  tent.problem.near.reset();
  EXPECT_TRUE(tent.blamed({0, 0, 100}).empty());
}

TEST(SurfaceLimit, AVertexThatLeavesTheSurfaceIsToBlame) {
  const Tent tent(0.5);
  EXPECT_TRUE(tent.blamed({0, 0, 0.5}).empty());
  EXPECT_TRUE(tent.blamed({0, 0, 0.5 + 0.9 * kDistance}).empty());
  EXPECT_EQ(tent.blamed({0, 0, 0.5 + 1.1 * kDistance}), std::vector<Index>{0});
}

// Else a long edge over small triangles was too far from what it lies on.
TEST(SurfaceLimit, ALongEdgeOverManyTrianglesOfAFlatPartIsNear) {
  constexpr Index kAcross = 80;
  std::vector<Vec3> x;
  for (Index i = 0; i <= kAcross; ++i)
    for (Index j = 0; j <= 2; ++j) x.emplace_back(i, j, 0);
  std::vector<Triangle> triangles;
  for (Index i = 0; i < kAcross; ++i) {
    for (Index j = 0; j < 2; ++j) {
      const Index a = 3 * i + j;
      triangles.push_back({a, a + 3, a + 4});
      triangles.push_back({a, a + 4, a + 1});
    }
  }
  const auto off = static_cast<Index>(x.size());  // one triangle that is not in the plane
  x.insert(x.end(), {{0, 5, 0}, {1, 5, 0}, {0, 5, 1}});
  triangles.push_back({off, off + 1, off + 2});
  const SmoothingProblem problem = kept_near(x, triangles, 1e-4);
  SurfaceLimit limit(problem);
  std::vector<Vec3> moved = x;
  moved[3 * 20 + 1] = {75.3, 1.2, 0};
  EXPECT_TRUE(limit.too_far(moved, SurfaceLimit::Blame::movers).empty());
}

TEST(SurfaceLimit, ATipThatIsCutOffIsTooFarThoughAllOfTheNewSurfaceIsNear) {
  const Tent tent(0.5);
  // Sunk by 1.05 of the distance, the new tip is nearer than that to the slopes.
  const Vec3 tip(0, 0, 0.5 - 1.05 * kDistance);
  EXPECT_LT(tent.problem.near->surface->closest(tip).distance, 0.95 * kDistance);
  EXPECT_EQ(tent.blamed(tip), std::vector<Index>{0});
  EXPECT_TRUE(tent.blamed({0, 0, 0.5 - 0.9 * kDistance}).empty());
}

TEST(SurfaceLimit, WhatIsTooFarAtTheStartGetsNoFarther) {
  const Tent tent(0.5);
  std::vector<Vec3> moved = tent.x;
  moved[0][2] -= 1.05 * kDistance;
  SurfaceLimit limit(tent.problem);
  limit.start(moved);
  moved[0][2] -= 0.03 * kDistance;
  EXPECT_FALSE(limit.keeps(moved, 0));
  moved[0][2] += 0.2 * kDistance;
  EXPECT_TRUE(limit.keeps(moved, 0));
}

TEST(SurfaceLimit, TellsTheDirectionAwayFromTheSurface) {
  const Tent tent(0.5);
  SurfaceLimit limit(tent.problem);
  std::vector<Vec3> moved = tent.x;
  moved[0][2] += 2 * kDistance;
  for (const auto& excess : limit.too_far(moved, SurfaceLimit::Blame::all)) {
    EXPECT_NEAR(excess.outwards.norm(), 1, 1e-12);
    EXPECT_GT(excess.outwards[2], 0.5);
  }
  moved[0][2] -= 4 * kDistance;
  for (const auto& excess : limit.too_far(moved, SurfaceLimit::Blame::all))
    EXPECT_LT(excess.outwards[2], -0.5) << "of vertex " << excess.vertex;
}

TEST(SurfaceLimit, SlidingInAPlaneIsNeverTooFar) {
  // The slightest tent: a plane for any distance, and no planar mesh, where nothing can leave.
  const Tent flat(1e-6);
  EXPECT_TRUE(flat.blamed({0.5, 0.3, 0}).empty());
  EXPECT_FALSE(flat.blamed({0.5, 0.3, 1.1 * kDistance}).empty());
}

TEST(SurfaceLimit, AnEdgeMayBeTooFarBetweenItsEnds) {
  // A strip of two squares folded along x = 0; its ends stay on it, the edge between them cuts the corner.
  const std::vector<Vec3> x{{-1, 0, -1}, {-1, 1, -1}, {0, 0, 0}, {0, 1, 0}, {1, 0, -1}, {1, 1, -1}};
  const std::vector<Triangle> triangles{{0, 2, 1}, {2, 3, 1}, {2, 4, 3}, {4, 5, 3}};
  const SmoothingProblem problem = kept_near(x, triangles);
  SurfaceLimit limit(problem);
  std::vector<Vec3> moved = x;
  moved[2] = {0.2, 0, -0.2};  // on the slope, but the edge to vertex 0 is not
  const auto far = limit.too_far(moved, SurfaceLimit::Blame::movers);
  ASSERT_FALSE(far.empty());
  EXPECT_TRUE(std::ranges::any_of(far, [](const auto& excess) { return excess.vertex == 2; }));
  moved[2] = {0.03, 0, -0.03};
  EXPECT_TRUE(limit.too_far(moved, SurfaceLimit::Blame::movers).empty());
}

TEST(SurfaceLimit, SlidingDownTheSlopesOfASharpRidgeIsNeverTooFar) {
  // The middle of one slope is nearer to its foot on the other slope than to all about that.
  const double width = 0.5;
  const std::vector<Vec3> x{{0, 0, 0},          {0, 1, 0},         {-width, 0, -1},     {-width, 1, -1},
                            {width, 0, -1},     {width, 1, -1},    {-2 * width, 0, -2}, {-2 * width, 1, -2},
                            {2 * width, 0, -2}, {2 * width, 1, -2}};
  const std::vector<Triangle> triangles{{2, 0, 1}, {2, 1, 3}, {0, 4, 1}, {4, 5, 1},
                                        {6, 2, 3}, {6, 3, 7}, {4, 8, 5}, {8, 9, 5}};
  const SmoothingProblem problem = kept_near(x, triangles);
  SurfaceLimit limit(problem);
  EXPECT_TRUE(limit.too_far(x, SurfaceLimit::Blame::all).empty());
  // Edges as they were now begin on one triangle of a slope and end on another one.
  std::vector<Vec3> moved = x;
  for (const Index v : {2U, 3U, 4U, 5U}) moved[v] = 0.5 * (x[v] + x[v % 2]);
  EXPECT_TRUE(limit.too_far(moved, SurfaceLimit::Blame::all).empty());
}

/// The largest distance of a mesh's edges from another one of the same triangles, looked for at both ends
/// and at places between them.
double farthest(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const Triangle> triangles,
                int between) {
  const ClosestPointIndex index(to, triangles);
  double found = 0;
  for (const Triangle& t : triangles) {
    for (unsigned k = 0; k < 3; ++k) {
      for (int i = 0; i <= between + 1; ++i) {
        const double share = static_cast<double>(i) / (between + 1);
        const Vec3 p = (1 - share) * from[t[k]] + share * from[t[next(k)]];
        found = std::max(found, index.closest(p).distance);
      }
    }
  }
  return found;
}

TEST(SurfaceLimit, TellsWhatIsTooFarWhereEdgesCrossThoughAllVerticesAreNear) {
  // Moved by half an edge both ways, vertices come over diagonals, which lie on the saddle, and edges along x
  // over edges along y.
  const TriangleMesh mesh = saddle(10);
  const std::vector<Vec3>& x = mesh.positions;
  const std::vector<Triangle>& triangles = mesh.triangles;
  const std::vector<Vec3> moved = saddle(10, 0.5, 0.5).positions;
  const double vertices = std::max(farthest(x, moved, triangles, 0), farthest(moved, x, triangles, 0));
  const double largest = std::max(farthest(x, moved, triangles, 60), farthest(moved, x, triangles, 60));
  ASSERT_LT(vertices, 1e-6);
  ASSERT_GT(largest, 0.01);
  const auto is_near_within = [&](double distance) {
    ProblemOptions options;
    options.holds.distance = distance;
    const SmoothingProblem problem = make_problem(x, triangles, options);
    return SurfaceLimit(problem).too_far(moved, SurfaceLimit::Blame::movers).empty();
  };
  EXPECT_TRUE(is_near_within(1.05 * largest));
  EXPECT_FALSE(is_near_within(0.95 * largest));
}

TEST(SurfaceLimit, KeepsTellsTheSameOfOneVertex) {
  const Tent tent(0.5);
  SurfaceLimit limit(tent.problem);
  std::vector<Vec3> x = tent.x;
  limit.start(x);
  const auto keeps_at = [&](double z) {
    x[0][2] = z;
    return limit.keeps(x, 0);
  };
  EXPECT_TRUE(keeps_at(0.5 + 0.9 * kDistance));
  EXPECT_FALSE(keeps_at(0.5 + 1.1 * kDistance));
  EXPECT_FALSE(keeps_at(0.5 - 1.05 * kDistance)) << "the tip as it was is too far";
  EXPECT_TRUE(keeps_at(0.5 - 0.9 * kDistance));
}

TEST(SurfaceLimit, RoundsThatItTakesAreInTheRecord) {
  const TriangleMesh torus = generate(ShapeKind::torus, {.seed = 3, .triangles = 1000, .jitter = 0.5});
  ProblemOptions options;
  options.holds.distance = 0.01;
  const SmoothingProblem problem = make_problem(torus.positions, torus.triangles, options);
  StepRecord record;
  make_smoother(problem, Solver::newton, RecordDetail::stages)->step(torus.positions, record);
  const auto& passes = record.detail->passes;
  EXPECT_TRUE(std::ranges::any_of(passes, [](const auto& pass) { return pass.why == kLimitSurface; }));
  EXPECT_EQ(passes.size(), record.fold_passes + record.energy_passes);
  EXPECT_EQ(alpha_after(record, passes.size()), record.alpha);
  EXPECT_GT(count_limits(record.limits)[6], 0U);
}

}  // namespace
}  // namespace isorelax
