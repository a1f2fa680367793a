#include "smoothing/worst_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generate/generate.h"
#include "quality/report.h"

namespace isorelax {
namespace {

double degrees_of_cot(double cot) {
  return std::atan2(1, cot) * 180 / std::numbers::pi;
}

TEST(WorstAngles, AreThoseOfTheQualityReport) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::random_sphere, ShapeKind::part}) {
    const TriangleMesh mesh = generate(kind, {.triangles = 500});
    const std::vector<std::uint8_t> all(mesh.triangles.size(), 1);
    const WorstAngles worst = WorstAngles::of(mesh.positions, mesh.triangles, all);
    const QualityReport report = measure_quality(mesh);
    EXPECT_NEAR(degrees_of_cot(worst.smallest_cot), report.min_angle_deg, 1e-7);
    EXPECT_NEAR(degrees_of_cot(worst.largest_cot), report.max_angle_deg, 1e-7);
  }
}

TEST(WorstAngles, LeaveOutTrianglesThatAreNotFlagged) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -0.1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 3, 1}};
  const WorstAngles worst = WorstAngles::of(positions, triangles, std::vector<std::uint8_t>{1, 0});
  EXPECT_NEAR(degrees_of_cot(worst.smallest_cot), 45, 1e-12);
  EXPECT_NEAR(degrees_of_cot(worst.largest_cot), 90, 1e-12);
}

}  // namespace
}  // namespace isorelax
