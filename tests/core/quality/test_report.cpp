#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "mesh/error.h"
#include "quality/report.h"
#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

/// A grid of n x n squares, each cut in two, with its inner vertices shaken.
TriangleMesh shaken_grid(Index n) {
  TriangleMesh mesh;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  for (Index y = 0; y <= n; ++y) {
    for (Index x = 0; x <= n; ++x) {
      const bool inside = x > 0 && y > 0 && x < n && y < n;
      mesh.positions.emplace_back(x + (inside ? shake(random) : 0), y + (inside ? shake(random) : 0), 0);
    }
  }
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  }
  return mesh;
}

TEST(QualityReport, OneRightTriangleGivesItsOwnValues) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const QualityReport r = measure_quality(mesh);
  EXPECT_EQ(r.vertices, 3U);
  EXPECT_EQ(r.triangles, 1U);
  EXPECT_NEAR(r.min_angle_deg, 45, 1e-12);
  EXPECT_NEAR(r.max_angle_deg, 90, 1e-12);
  EXPECT_NEAR(r.mean_min_angle_deg, 45, 1e-12);
  EXPECT_EQ(r.below_30_deg, 0);
  EXPECT_DOUBLE_EQ(r.area_max_over_min, 1);
  EXPECT_EQ(r.area_std_over_mean, 0);
  EXPECT_NEAR(r.shape_mean, 4 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(r.inverted, 0U);
  EXPECT_EQ(r.degenerate, 0U);
}

TEST(QualityReport, SharesAndAreaSpreadFollowTheirDefinitions) {
  // Areas 1/2, 1/2, 1/2, 3/2 by sliding one corner out: one obtuse sliver, three right triangles.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {10, 0, 0}, {13, 0, 0}, {20, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {3, 4, 5}};
  const QualityReport r = measure_quality(mesh);
  EXPECT_DOUBLE_EQ(r.below_20_deg, 0.25);
  EXPECT_DOUBLE_EQ(r.below_30_deg, 0.25);
  EXPECT_DOUBLE_EQ(r.above_120_deg, 0.25);
  EXPECT_NEAR(r.area_max_over_min, 3, 1e-12);
  EXPECT_NEAR(r.area_std_over_mean, std::sqrt(0.1875) / 0.75, 1e-12);
}

TEST(QualityReport, DoesNotDependOnThreadsOrTriangleOrder) {
  TriangleMesh mesh = shaken_grid(60);
  const QualityReport one = measure_quality(mesh, 1);
  const QualityReport four = measure_quality(mesh, 4);
  EXPECT_EQ(one.mean_min_angle_deg, four.mean_min_angle_deg);
  EXPECT_EQ(one.area_std_over_mean, four.area_std_over_mean);
  EXPECT_EQ(one.shape_mean, four.shape_mean);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(1));
  const QualityReport shuffled = measure_quality(mesh);
  EXPECT_EQ(one.min_angle_deg, shuffled.min_angle_deg);
  EXPECT_NEAR(one.mean_min_angle_deg, shuffled.mean_min_angle_deg, 1e-10);
  EXPECT_NEAR(one.area_std_over_mean, shuffled.area_std_over_mean, 1e-12);
}

TEST(QualityReport, AgreesWithAPlainSecondComputation) {
  const TriangleMesh mesh = shaken_grid(20);
  double mean_min = 0;
  double worst = 180;
  for (const auto& [a, b, c] : mesh.triangles) {
    double smallest = 180;
    const Index ids[3] = {a, b, c};
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 u = (mesh.positions[ids[next(k)]] - mesh.positions[ids[k]]).normalized();
      const Vec3 v = (mesh.positions[ids[previous(k)]] - mesh.positions[ids[k]]).normalized();
      smallest = std::min(smallest, std::acos(u.dot(v)) * 45 / std::atan(1.0));
    }
    mean_min += smallest;
    worst = std::min(worst, smallest);
  }
  const QualityReport r = measure_quality(mesh);
  EXPECT_NEAR(r.min_angle_deg, worst, 1e-9);
  EXPECT_NEAR(r.mean_min_angle_deg, mean_min / mesh.triangle_count(), 1e-9);
}

TEST(QualityReport, HugeAndTinyCoordinatesMeasureLikeOrdinaryOnes) {
  const TriangleMesh mesh = shaken_grid(5);
  const QualityReport ordinary = measure_quality(mesh);
  for (const double scale : {1e150, 1e300, 1e-150, 1e-290}) {
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.positions) p *= scale;
    const QualityReport r = measure_quality(scaled);
    EXPECT_NEAR(r.min_angle_deg, ordinary.min_angle_deg, 1e-9) << scale;
    EXPECT_NEAR(r.shape_mean, ordinary.shape_mean, 1e-9) << scale;
    EXPECT_NEAR(r.area_max_over_min, ordinary.area_max_over_min, 1e-9) << scale;
    EXPECT_EQ(r.degenerate, 0U);
  }
}

TEST(QualityReport, DegenerateTriangleIsCountedAndMakesTheUnboundedMeasuresInfinite) {
  TriangleMesh mesh = shaken_grid(2);
  mesh.triangles.push_back({0, 1, 1});
  const QualityReport r = measure_quality(mesh);
  EXPECT_EQ(r.degenerate, 1U);
  EXPECT_EQ(r.inverted, 0U);
  EXPECT_EQ(r.min_angle_deg, 0);
  EXPECT_EQ(r.max_angle_deg, 180);
  EXPECT_TRUE(std::isinf(r.shape_max));
  EXPECT_TRUE(std::isinf(r.area_max_over_min));
  EXPECT_EQ(r.radius_ratio_min, 0);
}

TEST(QualityReport, RefusesAMeshWithoutTriangles) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  EXPECT_THROW(static_cast<void>(measure_quality(mesh)), MeshError);
}

}  // namespace
}  // namespace isorelax
