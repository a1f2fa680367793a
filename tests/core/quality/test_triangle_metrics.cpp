#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

const double kRoot3 = std::sqrt(3.0);

TEST(TriangleMetrics, EquilateralIsIdealInEveryMeasure) {
  const TriangleMetrics m = measure_triangle({0, 0, 0}, {2, 0, 0}, {1, kRoot3, 0});
  EXPECT_NEAR(m.min_angle_deg, 60, 1e-12);
  EXPECT_NEAR(m.max_angle_deg, 60, 1e-12);
  EXPECT_NEAR(m.area, kRoot3, 1e-12);
  EXPECT_NEAR(m.shape, 2, 1e-12);
  EXPECT_NEAR(m.radius_ratio, 1, 1e-12);
  EXPECT_NEAR(m.scaled_jacobian, 1, 1e-12);
  EXPECT_NEAR(m.aspect_ratio, 1, 1e-12);
  EXPECT_FALSE(m.degenerate);
}

TEST(TriangleMetrics, RightIsoscelesHasItsTextbookValues) {
  const TriangleMetrics m = measure_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const double root2 = std::sqrt(2.0);
  EXPECT_NEAR(m.min_angle_deg, 45, 1e-12);
  EXPECT_NEAR(m.max_angle_deg, 90, 1e-12);
  EXPECT_DOUBLE_EQ(m.area, 0.5);
  EXPECT_NEAR(m.shape, 4 / kRoot3, 1e-12);
  EXPECT_NEAR(m.radius_ratio, 2 * (root2 - 1), 1e-12);  // r = 1 - 1/sqrt 2, R = 1/sqrt 2
  EXPECT_NEAR(m.scaled_jacobian, 2 / kRoot3 * std::sin(std::atan(1.0)), 1e-12);
  EXPECT_NEAR(m.aspect_ratio, root2 * (2 + root2) / (2 * kRoot3), 1e-12);
}

TEST(TriangleMetrics, SliverAnglesKeepTheirDigits) {
  const double height = 1e-9;
  const TriangleMetrics m = measure_triangle({0, 0, 0}, {1, 0, 0}, {0.25, height, 0});
  const double degrees = 45 / std::atan(1.0);
  EXPECT_NEAR(m.min_angle_deg / (std::atan(height / 0.75) * degrees), 1, 1e-12);
  EXPECT_NEAR(180 - m.max_angle_deg, (height / 0.75 + height / 0.25) * degrees, 1e-12);
  EXPECT_FALSE(m.degenerate);
}

TEST(TriangleMetrics, NoAreaMeansDegenerateWithInfiniteShape) {
  const Vec3 o(0, 0, 0);
  const Vec3 x(1, 0, 0);
  const std::vector<std::array<Vec3, 3>> cases = {{o, x, Vec3(2, 0, 0)}, {o, x, x}, {x, x, x}};
  for (const auto& [a, b, c] : cases) {
    const TriangleMetrics m = measure_triangle(a, b, c);
    EXPECT_TRUE(m.degenerate);
    EXPECT_EQ(m.min_angle_deg, 0);
    EXPECT_EQ(m.max_angle_deg, 180);
    EXPECT_EQ(m.area, 0);
    EXPECT_TRUE(std::isinf(m.shape));
    EXPECT_TRUE(std::isinf(m.aspect_ratio));
    EXPECT_EQ(m.radius_ratio, 0);
    EXPECT_EQ(m.scaled_jacobian, 0);
  }
}

TEST(TriangleMetrics, HeightAtRoundingErrorIsDegenerateAndTenTimesThatIsNot) {
  EXPECT_TRUE(measure_triangle({0, 0, 0}, {1, 0, 0}, {0.5, 1e-14, 0}).degenerate);
  EXPECT_FALSE(measure_triangle({0, 0, 0}, {1, 0, 0}, {0.5, 1e-13, 0}).degenerate);
}

TEST(TriangleMetrics, RotationScaleAndCornerOrderChangeNothing) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = vector();
    const Vec3 b = vector();
    const Vec3 c = vector();
    const TriangleMetrics m = measure_triangle(a, b, c);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(normal(random), vector().normalized()).toRotationMatrix();
    const double scale = std::exp(normal(random));
    const Vec3 shift = vector();
    const auto move = [&](const Vec3& p) -> Vec3 { return scale * (turn * p) + shift; };
    const TriangleMetrics n = measure_triangle(move(c), move(a), move(b));
    EXPECT_NEAR(n.min_angle_deg, m.min_angle_deg, 1e-8);
    EXPECT_NEAR(n.max_angle_deg, m.max_angle_deg, 1e-8);
    EXPECT_NEAR(n.shape / m.shape, 1, 1e-9);
    EXPECT_NEAR(n.radius_ratio, m.radius_ratio, 1e-9);
    EXPECT_NEAR(n.aspect_ratio / m.aspect_ratio, 1, 1e-9);
    EXPECT_NEAR(n.area / (scale * scale * m.area), 1, 1e-9);
  }
}

TEST(TriangleMetrics, ScaledJacobianIsTheSineOfTheSmallestAngle) {
  const TriangleMetrics m = measure_triangle({0.3, -1, 2}, {1.7, 0.2, 0.1}, {-0.4, 3, 1});
  EXPECT_NEAR(m.scaled_jacobian, 2 / kRoot3 * std::sin(m.min_angle_deg * std::atan(1.0) / 45), 1e-12);
}

TEST(FaceMetric, NamesLeadBackToTheirMetric) {
  for (const auto metric :
       {FaceMetric::min_angle, FaceMetric::max_angle, FaceMetric::area, FaceMetric::relative_area,
        FaceMetric::shape, FaceMetric::radius_ratio, FaceMetric::scaled_jacobian, FaceMetric::aspect_ratio}) {
    EXPECT_EQ(metric_by_name(metric_name(metric)), metric);
  }
  EXPECT_FALSE(metric_by_name("beauty").has_value());
}

TEST(FaceMetric, RelativeAreasHaveMeanOne) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-3, 0, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto values = face_metric(FaceMetric::relative_area, positions, triangles);
  EXPECT_DOUBLE_EQ(values[0], 0.5);
  EXPECT_DOUBLE_EQ(values[1], 1.5);
}

}  // namespace
}  // namespace isorelax
