#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generate/random.h"
#include "generate/triangulation.h"
#include "mesh/error.h"
#include "mesh/validation.h"

namespace isorelax {
namespace {

using GridPoints = std::vector<GridPoint>;

double area_of(const GridPoints& points, const std::vector<Triangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const auto cross = (points[b].x - points[a].x) * (points[c].y - points[a].y) -
                       (points[b].y - points[a].y) * (points[c].x - points[a].x);
    area += static_cast<double>(cross) / 2;
  }
  return area;
}

/// Every triangle counter-clockwise with no point inside its circle; every point used.
void expect_delaunay(const GridPoints& points, const std::vector<Triangle>& triangles) {
  std::vector<bool> used(points.size(), false);
  for (const auto& [a, b, c] : triangles) {
    EXPECT_EQ(orient_plane(points[a], points[b], points[c]), 1);
    for (const Index v : {a, b, c}) used[v] = true;
    for (const GridPoint& p : points) EXPECT_LE(in_circle(points[a], points[b], points[c], p), 0);
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

GridPoints random_points(std::size_t count, std::int64_t size) {
  Random random(5);
  GridPoints points;
  while (points.size() < count) {
    const GridPoint p{static_cast<std::int64_t>(random.below(size)),
                      static_cast<std::int64_t>(random.below(size)), 0};
    const bool taken = std::any_of(points.begin(), points.end(),
                                   [&](const GridPoint& q) { return q.x == p.x && q.y == p.y; });
    if (!taken) points.push_back(p);
  }
  return points;
}

TEST(Delaunay, RandomPointsHaveEmptyCircles) {
  const GridPoints points = random_points(300, 1 << 29);
  expect_delaunay(points, delaunay_triangles(points));
}

TEST(Delaunay, PointsOnACoarseGridWithManyLinesAndCirclesInCommonWork) {
  const GridPoints points = random_points(150, 16);
  expect_delaunay(points, delaunay_triangles(points));
}

TEST(Delaunay, FullLatticeIsCoveredOnce) {
  GridPoints points;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) points.push_back({x, y, 0});
  }
  const auto triangles = delaunay_triangles(points);
  EXPECT_EQ(triangles.size(), 2U * 19 * 19);
  EXPECT_EQ(area_of(points, triangles), 19.0 * 19);
  expect_delaunay(points, triangles);
}

TEST(Delaunay, RingsOfPointsWork) {
  GridPoints points;
  for (int ring = 1; ring <= 4; ++ring) {
    for (int i = 0; i < 24; ++i) {
      const double angle = i * std::atan(1.0) / 3;
      points.push_back(
          {std::llround(1e6 * ring * std::cos(angle)), std::llround(1e6 * ring * std::sin(angle)), 0});
    }
  }
  expect_delaunay(points, delaunay_triangles(points));
}

TEST(Delaunay, RefusesALineAndCoincidingPoints) {
  EXPECT_THROW(static_cast<void>(delaunay_triangles(GridPoints{{0, 0, 0}, {1, 1, 0}, {5, 5, 0}})),
               UsageError);
  EXPECT_THROW(static_cast<void>(delaunay_triangles(GridPoints{{0, 0, 0}, {1, 1, 0}, {5, 0, 0}, {1, 1, 0}})),
               UsageError);
  EXPECT_THROW(static_cast<void>(delaunay_triangles(GridPoints{})), UsageError);
}

TEST(Hull, OfACubeAndItsFaceCentresPushedOutHasEveryPointOnIt) {
  GridPoints points;
  for (int i = 0; i < 8; ++i) points.push_back({i % 2 * 20 - 10, i / 2 % 2 * 20 - 10, i / 4 * 20 - 10});
  for (const int d : {-11, 11}) {
    points.push_back({d, 0, 0});
    points.push_back({0, d, 0});
    points.push_back({0, 0, d});
  }
  const auto triangles = hull_triangles(points);
  EXPECT_EQ(triangles.size(), 2 * points.size() - 4);
  for (const auto& [a, b, c] : triangles) {
    for (const GridPoint& p : points) EXPECT_LE(orient_space(points[a], points[b], points[c], p), 0);
  }
}

TEST(Hull, RefusesAnInnerPointAndAPlane) {
  const GridPoints inner = {{-9, -9, -9}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {0, 0, 0}};
  EXPECT_THROW(static_cast<void>(hull_triangles(inner)), UsageError);
  const GridPoints flat = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {9, 9, 0}};
  EXPECT_THROW(static_cast<void>(hull_triangles(flat)), UsageError);
}

TEST(Predicates, AreExactWhereDoublesAreNot) {
  const std::int64_t big = std::int64_t{1} << 30;
  EXPECT_EQ(orient_plane({0, 0, 0}, {big, big - 1, 0}, {big - 1, big - 2, 0}), -1);
  const GridPoint a{big, 0, 0};
  const GridPoint b{0, big, 0};
  const GridPoint c{0, 0, 0};
  EXPECT_EQ(in_circle(c, a, b, {big, big, 0}), 0);
  EXPECT_EQ(in_circle(c, a, b, {big, big - 1, 0}), 1);
  const std::int64_t huge = std::int64_t{1} << 40;
  EXPECT_EQ(orient_space({huge, 0, 0}, {0, huge, 0}, {0, 0, huge}, {huge, -huge, huge}), 0);
  EXPECT_EQ(orient_space({huge, 0, 0}, {0, huge, 0}, {0, 0, huge}, {huge, -huge, huge + 1}), 1);
}

}  // namespace
}  // namespace isorelax
