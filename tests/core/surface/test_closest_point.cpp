#include "surface/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/surface/shapes.h"

namespace isorelax {
namespace {

Vec3 random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> u(-size, size);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

/// Alternating projections onto a fine grid of weights: slow, and shares nothing with the code under test.
double distance_by_grid(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 centre = Vec3::Constant(1.0 / 3);
  double best = std::numeric_limits<double>::infinity();
  for (double size = 2; size > 1e-9; size *= 0.5) {
    const Vec3 from = centre;
    for (int i = -4; i <= 4; ++i) {
      for (int j = -4; j <= 4; ++j) {
        Vec3 w = from + size * 0.25 * Vec3(i, j, -i - j);
        w = w.cwiseMax(0);
        w /= w.sum();
        const double d = (p - (w[0] * a + w[1] * b + w[2] * c)).norm();
        if (d < best) best = d, centre = w;
      }
    }
  }
  return best;
}

void expect_consistent(const Vec3& p, const SurfacePoint& found, const Vec3& a, const Vec3& b,
                       const Vec3& c) {
  EXPECT_GE(found.barycentric.minCoeff(), 0);
  EXPECT_NEAR(found.barycentric.sum(), 1, 1e-12);
  const Vec3 from_weights = found.barycentric[0] * a + found.barycentric[1] * b + found.barycentric[2] * c;
  EXPECT_LT((from_weights - found.point).norm(), 1e-12);
  EXPECT_NEAR((p - found.point).norm(), found.distance, 1e-12);
}

TEST(ClosestPoint, OfOneTriangleIsTheSmallestDistanceInEveryRegion) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_point(random, 1), b = random_point(random, 1), p = random_point(random, 2);
    Vec3 c = random_point(random, 1);
    if (i % 3 == 0) c = 0.5 * (a + b) + 1e-3 * c;  // obtuse and thin
    const SurfacePoint found = closest_point_of_triangle(p, a, b, c);
    expect_consistent(p, found, a, b, c);
    EXPECT_NEAR(found.distance, distance_by_grid(p, a, b, c), 1e-5);
    EXPECT_LE(found.distance, distance_by_grid(p, a, b, c) + 1e-12);
  }
}

TEST(ClosestPoint, OfATriangleWithoutAreaIsThatOfItsEdges) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0);
  EXPECT_DOUBLE_EQ(closest_point_of_triangle({2, 1, 0}, a, b, c).distance, 1);
  EXPECT_DOUBLE_EQ(closest_point_of_triangle({2, 1, 0}, c, a, b).distance, 1);
  EXPECT_DOUBLE_EQ(closest_point_of_triangle({5, 0, 0}, b, c, a).distance, 2);
  EXPECT_DOUBLE_EQ(closest_point_of_triangle({0, 3, 4}, a, a, a).distance, 5);
  expect_consistent({2, 1, 0}, closest_point_of_triangle({2, 1, 0}, a, b, c), a, b, c);
}

TEST(ClosestPoint, OverANeedleIsItsFoot) {
  std::mt19937 random(5);
  for (const double height : {1e-2, 1e-4, 1e-6}) {
    const Vec3 a = random_point(random, 1), along = random_point(random, 1);
    const Vec3 normal = along.unitOrthogonal(), across = height * normal.cross(along);
    const Vec3 b = a + along, c = a + 0.4 * along + across;
    const Vec3 foot = 0.2 * a + 0.3 * b + 0.5 * c;
    const SurfacePoint found = closest_point_of_triangle(foot + 0.1 * normal, a, b, c);
    EXPECT_NEAR(found.distance, 0.1, 1e-13);
    EXPECT_LT((found.point - foot).norm(), 1e-14 / height);
  }
}

TEST(ClosestPoint, AtACornerIsThatCornerToTheLastBit) {
  const Vec3 a(0.1, 0.2, 0.3), b(1.7, 0.4, 0.9), c(0.3, 1.1, 0.7);
  for (const Vec3& corner : {a, b, c}) {
    const SurfacePoint found = closest_point_of_triangle(corner, a, b, c);
    EXPECT_EQ(found.distance, 0);
    EXPECT_EQ(found.point, corner);
  }
}

struct Soup {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

Soup random_soup(std::mt19937& random, Index triangles) {
  Soup soup;
  for (Index t = 0; t < triangles; ++t) {
    const Vec3 at = random_point(random, 1);
    for (int k = 0; k < 3; ++k) soup.positions.emplace_back(at + random_point(random, 0.2));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    if (t % 17 == 0) soup.triangles.back()[2] = 3 * t;  // repeats a vertex
  }
  return soup;
}

TEST(ClosestPointIndex, FindsWhatTryingEveryTriangleFinds) {
  std::mt19937 random(2);
  for (const Index count : {1U, 3U, 4U, 5U, 9U, 700U}) {
    const Soup soup = random_soup(random, count);
    const ClosestPointIndex index(soup.positions, soup.triangles);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random_point(random, i % 2 ? 1 : 4);
      SurfacePoint best;
      best.distance = std::numeric_limits<double>::infinity();
      for (Index t = 0; t < count; ++t) {
        const auto& [a, b, c] = soup.triangles[t];
        SurfacePoint one =
            closest_point_of_triangle(p, soup.positions[a], soup.positions[b], soup.positions[c]);
        one.triangle = t;
        ASSERT_EQ(index.closest_of(t, p).point, one.point);
        if (one.distance < best.distance) best = one;
      }
      const SurfacePoint found = index.closest(p);
      EXPECT_EQ(found.triangle, best.triangle);
      EXPECT_EQ(found.distance, best.distance);
      EXPECT_EQ(found.point, best.point);
    }
  }
}

TEST(ClosestPointIndex, GivesTheSameAnswerWithAnyHint) {
  const TriangleMesh mesh = with_triangles(ShapeKind::torus, 3000);
  const ClosestPointIndex index(mesh.positions, mesh.triangles);
  std::mt19937 random(3);
  std::uniform_int_distribution<Index> any(0, mesh.triangle_count() - 1);
  for (int i = 0; i < 3000; ++i) {
    const Triangle& t = mesh.triangles[any(random)];
    Vec3 p = random_point(random, 1.5);
    if (i % 3 == 0) p = mesh.positions[t[0]];                                 // ties between a fan
    if (i % 3 == 1) p = 0.5 * (mesh.positions[t[0]] + mesh.positions[t[1]]);  // and across an edge
    const SurfacePoint plain = index.closest(p);
    const SurfacePoint hinted = index.closest(p, any(random));
    EXPECT_EQ(plain.triangle, hinted.triangle);
    EXPECT_EQ(plain.distance, hinted.distance);
  }
}

TEST(ClosestPointIndex, OfEqualDistancesTakesTheFirstTriangle) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> same(40, Triangle{0, 1, 2});
  const ClosestPointIndex index(positions, same);
  EXPECT_EQ(index.closest({0.2, 0.2, 1}).triangle, 0U);
  EXPECT_EQ(index.closest({0.2, 0.2, 1}, 33).triangle, 0U);
}

TEST(ClosestPointIndex, WithoutTrianglesOrForNotANumberFindsNothing) {
  EXPECT_EQ(ClosestPointIndex().closest({0, 0, 0}).triangle, kNone);
  EXPECT_TRUE(std::isinf(ClosestPointIndex().closest({0, 0, 0}, 3).distance));
  const TriangleMesh mesh = generate(ShapeKind::cube, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ClosestPointIndex(mesh.positions, mesh.triangles).closest({nan, 0, 0}, 5).triangle, kNone);
}

}  // namespace
}  // namespace isorelax
