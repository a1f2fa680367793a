#include "surface/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "core/surface/shapes.h"

namespace isorelax {
namespace {

OneWayDistance measure(const TriangleMesh& from, const TriangleMesh& to, unsigned threads = 1) {
  const Topology around_from(from.triangles, from.vertex_count());
  const Topology around_to(to.triangles, to.vertex_count());
  return measure_both_ways({from.positions, from.triangles, around_from},
                           {to.positions, to.triangles, around_to}, threads)[0];
}

/// Largest distance of a grid on every triangle of one surface from the other one.
double largest_on_grid(const TriangleMesh& from, const TriangleMesh& to, int steps) {
  const ClosestPointIndex index(to.positions, to.triangles);
  double largest = 0;
  for (const auto& [a, b, c] : from.triangles) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 p =
            (i * from.positions[a] + j * from.positions[b] + (steps - i - j) * from.positions[c]) / steps;
        largest = std::max(largest, index.closest(p).distance);
      }
    }
  }
  return largest;
}

void expect_largest(const TriangleMesh& from, const TriangleMesh& to, int steps) {
  const double found = measure(from, to).farthest.distance;
  const double grid = largest_on_grid(from, to, steps);
  EXPECT_GE(found, 0.999 * grid);
  EXPECT_LE(found, 1.01 * grid);
}

TEST(SurfaceDistance, FindsPeaksBetweenTheSamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-0.2, 0.2);
  for (int round = 0; round < 5; ++round) {
    const TriangleMesh mesh = with_vertices(ShapeKind::sphere, 12);
    TriangleMesh moved = mesh;
    for (Vec3& x : moved.positions) x += Vec3::NullaryExpr([&] { return u(random); });
    expect_largest(mesh, moved, 100);
    expect_largest(moved, mesh, 100);
  }
}

TEST(SurfaceDistance, FindsPeaksThatAreEverywhere) {
  const TriangleMesh then = saddle(16, 0, 0);
  const TriangleMesh now = saddle(16, 0.5, 0.35);
  expect_largest(then, now, 60);
  expect_largest(now, then, 60);
}

TEST(SurfaceDistance, OfOtherTrianglesNamesTheFarthestPoint) {
  const TriangleMesh low = saddle(2, 0, 0);
  TriangleMesh high = saddle(3, 0, 0);
  high.positions[5].z() = 0.75;
  const FarPoint there = measure(high, low).farthest;
  EXPECT_EQ(there.point, high.positions[5]);
  EXPECT_NEAR(there.distance, largest_on_grid(high, low, 10), 1e-12);
  EXPECT_NEAR(closest_point_of_triangle(there.point, low.positions, low.triangles, there.nearest).distance,
              there.distance, 1e-12);
}

TEST(SurfaceDistance, OfTrianglesThatLieInOthersDoesNotTakeLong) {
  // Each lies over several of the others, and none of those is near all of it.
  for (const ShapeKind kind : {ShapeKind::hexagonal_square, ShapeKind::random_square}) {
    const TriangleMesh then = generate(kind, {.seed = 1, .triangles = 2000});
    const TriangleMesh now = generate(kind, {.seed = 2, .triangles = 2000});
    const auto start = std::chrono::steady_clock::now();
    EXPECT_LT(measure(now, then).farthest.distance, 1e-15);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0);
  }
}

TEST(SurfaceDistance, IsTheSameForAnyNumberOfThreads) {
  // More triangles than one thread takes at once.
  const TriangleMesh then = saddle(33, 0, 0);
  const TriangleMesh now = saddle(33, 0.3, 0.4);
  const OneWayDistance one = measure(now, then, 1);
  for (const unsigned threads : {2U, 5U}) {
    const OneWayDistance other = measure(now, then, threads);
    EXPECT_EQ(one.farthest.distance, other.farthest.distance);
    EXPECT_EQ(one.farthest.point, other.farthest.point);
    EXPECT_EQ(one.squares, other.squares);
  }
}

}  // namespace
}  // namespace isorelax
