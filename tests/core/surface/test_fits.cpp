#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "surface/feature_curves.h"
#include "surface/height_fit.h"

namespace isorelax {
namespace {

/// Samples of z = f(x, y) about the origin with the normals of the surface.
template <typename F>
std::vector<FitSample> samples_of(const F& f, int count, double radius = 1) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-radius, radius);
  std::vector<FitSample> samples;
  for (int i = 0; i < count; ++i) {
    const double x = u(random), y = u(random), e = 1e-6;
    const double fx = (f(x + e, y) - f(x - e, y)) / (2 * e), fy = (f(x, y + e) - f(x, y - e)) / (2 * e);
    samples.push_back({{x, y, f(x, y)}, Vec3(-fx, -fy, 1).normalized()});
  }
  return samples;
}

TEST(HeightFit, IsExactForAQuarticAndPassesThroughTheVertex) {
  const auto f = [](double x, double y) {
    return 0.1 * x - 0.2 * y + 0.3 * x * x + 0.1 * x * y - 0.2 * y * y + 0.05 * x * x * y +
           0.04 * std::pow(x, 4) - 0.03 * x * x * y * y + 0.02 * std::pow(y, 4);
  };
  const HeightFit fit(Vec3::Zero(), Vec3::UnitZ(), samples_of(f, 30));
  EXPECT_EQ(fit.degree(), 4);
  EXPECT_LT(fit.lift(Vec3::Zero()).norm(), 1e-15);
  for (const auto& [x, y] : {std::pair{0.3, 0.4}, {-0.5, 0.1}, {0.2, -0.7}}) {
    const Vec3 lifted = fit.lift({x, y, 5});
    EXPECT_NEAR(lifted.x(), x, 1e-14);
    EXPECT_NEAR(lifted.y(), y, 1e-14);
    EXPECT_NEAR(lifted.z(), f(x, y), 1e-12);
  }
}

TEST(HeightFit, TakesTheDegreeThatTheSamplesDetermine) {
  const auto f = [](double x, double y) { return x * x + y * y; };
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), samples_of(f, 21)).degree(), 4);
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), samples_of(f, 20)).degree(), 3);
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), samples_of(f, 8)).degree(), 2);
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), samples_of(f, 7)).degree(), 0);
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), {}).degree(), 0);
  auto on_a_line = samples_of(f, 30);
  for (FitSample& s : on_a_line) s.point.y() = 0.5 * s.point.x();
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), on_a_line).degree(), 0);
  EXPECT_EQ(HeightFit(Vec3::Zero(), Vec3::UnitZ(), on_a_line).lift({1, 2, 3}), Vec3(1, 2, 3));
}

TEST(HeightFit, IgnoresWhatTurnsAway) {
  auto samples = samples_of([](double x, double y) { return x * x + y * y; }, 40);
  for (int i = 0; i < 10; ++i) samples.push_back({{0.1 * i, 0.2, -3}, -Vec3::UnitZ()});
  EXPECT_NEAR(HeightFit(Vec3::Zero(), Vec3::UnitZ(), samples).lift({0.3, 0.3, 0}).z(), 0.18, 1e-12);
}

TEST(HeightFit, OfAPlaneIsThePlane) {
  const HeightFit fit(Vec3::Zero(), Vec3::UnitZ(), samples_of([](double, double) { return 0.0; }, 30));
  EXPECT_EQ(fit.lift({0.3, 0.4, 0}), Vec3(0.3, 0.4, 0));
}

TEST(CurveFit, ComesCloseToACircle) {
  std::vector<Vec3> around;
  for (const int i : {1, 2, 3, -1, -2, -3}) around.emplace_back(std::sin(0.1 * i), 1 - std::cos(0.1 * i), 0);
  const CurveFit fit(Vec3::Zero(), Vec3::UnitX(), around);
  for (const double angle : {-0.08, 0.03, 0.09}) {
    const Vec3 lifted = fit.lift({std::sin(angle), 0, 0});
    EXPECT_NEAR((lifted - Vec3(0, 1, 0)).norm(), 1, 1e-6);
  }
}

/// A polyline of `count` edges on an arc of the unit circle.
std::vector<Vec3> arc(int count, double angle) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i)
    points.emplace_back(std::cos(angle * i / count), std::sin(angle * i / count), 0.5);
  return points;
}

std::vector<FeatureCurves::Edge> chain(Index count) {
  std::vector<FeatureCurves::Edge> edges;
  for (Index i = 0; i < count; ++i) {
    // Directions and order as they come.
    if (i % 2 == 0) edges.push_back({i, i + 1});
    if (i % 2 == 1) edges.push_back({i + 1, i});
  }
  std::reverse(edges.begin(), edges.end());
  return edges;
}

TEST(FeatureCurves, FollowAnArcAndStopAtItsEnds) {
  const std::vector<Vec3> points = arc(20, 2);
  const std::vector<std::uint8_t> corners(points.size(), 0);
  const FeatureCurves curves(points, chain(20), corners);
  Index edge = curves.edge_of(0);
  for (double angle = -0.3; angle < 2.3; angle += 0.01) {
    const CurvePoint found = curves.project({1.05 * std::cos(angle), 1.05 * std::sin(angle), 0.52}, edge);
    edge = found.edge;
    EXPECT_NEAR(std::hypot(found.point.x(), found.point.y()), 1, 1e-5);  // the flat edges: 1e-3
    EXPECT_DOUBLE_EQ(found.point.z(), 0.5);
    const double at = std::atan2(found.point.y(), found.point.x());
    EXPECT_NEAR(at, std::clamp(angle, 0.0, 2.0), 3e-3);
  }
}

TEST(FeatureCurves, KeepTheirVertices) {
  const std::vector<Vec3> points = arc(9, 3);
  const FeatureCurves curves(points, chain(9), std::vector<std::uint8_t>(points.size(), 0));
  for (Index v = 0; v < points.size(); ++v)
    EXPECT_EQ(curves.project(points[v], curves.edge_of(v)).point, points[v]);
}

TEST(FeatureCurves, StayStraightWhereALineRunsIntoAnArc) {
  std::vector<Vec3> points = arc(10, 1);
  for (int i = 1; i <= 10; ++i) points.insert(points.begin(), {1, -0.1 * i, 0.5});
  const FeatureCurves curves(points, chain(20), std::vector<std::uint8_t>(points.size(), 0));
  for (double y = -0.99; y < 0; y += 0.013)
    EXPECT_EQ(curves.project({1.01, y, 0.5}, curves.edge_of(3)).point.x(), 1);
  for (double a = 0.02; a < 1; a += 0.013) {
    const Vec3 on_arc = curves.project({std::cos(a), std::sin(a), 0.5}, curves.edge_of(15)).point;
    EXPECT_NEAR(std::hypot(on_arc.x(), on_arc.y()), 1, 1e-5);  // the flat edges: 1e-3
  }
}

TEST(FeatureCurves, DoNotPassACorner) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const FeatureCurves curves(points, chain(3), std::vector<std::uint8_t>{0, 1, 0, 0});
  EXPECT_EQ(curves.project({0.7, 1, 0}, curves.edge_of(2)).point, Vec3(1, 0, 0));
  EXPECT_EQ(curves.project({2.7, 1, 0}, curves.edge_of(2)).point, Vec3(2.7, 0, 0));
}

}  // namespace
}  // namespace isorelax
