#include "surface/overlay.h"

#include <gtest/gtest.h>

#include "core/surface/shapes.h"

namespace isorelax {
namespace {

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, Index t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

/// Largest distance of a grid on a triangle from a surface.
double largest_over(const std::array<Vec3, 3>& corners, const ClosestPointIndex& index) {
  constexpr int kSteps = 60;
  double largest = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const Vec3 p = (i * corners[0] + j * corners[1] + (kSteps - i - j) * corners[2]) / kSteps;
      largest = std::max(largest, index.closest(p).distance);
    }
  return largest;
}

TEST(PointBeyond, IsThereAsLongAsTheTriangleIsFarther) {
  const TriangleMesh then = saddle(12, 0, 0);
  const TriangleMesh now = saddle(12, 0.4, 0.3);
  const Topology topology(then.triangles, then.vertex_count());
  const IndexedSurface surface(then.positions, then.triangles, topology);
  for (Index t = 0; t < now.triangles.size(); ++t) {
    const auto corners = corners_of(now, t);
    const Index near = surface.index.closest(corners[0]).triangle;
    const double largest = largest_over(corners, surface.index);
    EXPECT_FALSE(point_beyond(1.02 * largest + 1e-12, corners, surface, near)) << t << ' ' << largest;
    if (largest < 1e-6) continue;
    const std::optional<Vec3> point = point_beyond(0.98 * largest, corners, surface, near);
    ASSERT_TRUE(point) << t;
    EXPECT_GT(surface.index.closest(*point).distance, 0.97 * largest) << t;
  }
}

TEST(PointBeyond, IsNowhereInTheSurfaceItself) {
  // Large triangles over many small ones, about vertices of which many meet.
  const auto square = [](std::uint64_t seed) {
    return generate(ShapeKind::random_square, {.seed = seed, .triangles = 400});
  };
  const TriangleMesh then = square(1), now = square(2);
  const Topology topology(then.triangles, then.vertex_count());
  const IndexedSurface surface(then.positions, then.triangles, topology);
  std::size_t shown = 0;
  for (Index t = 0; t < now.triangles.size(); ++t) {
    const auto corners = corners_of(now, t);
    if (!point_beyond(surface.rounding, corners, surface, surface.index.closest(corners[0]).triangle))
      ++shown;
  }
  EXPECT_GT(shown, now.triangles.size() * 4 / 5);
}

TEST(PointBeyond, IsTheCentreWhereItComesToTooManyPieces) {
  const TriangleMesh fine = generate(ShapeKind::hexagonal_square, {.seed = 1, .triangles = 2000});
  const Topology topology(fine.triangles, fine.vertex_count());
  const IndexedSurface surface(fine.positions, fine.triangles, topology);
  const std::array<Vec3, 3> corners = {Vec3(0.1, 0.1, 0), Vec3(0.9, 0.1, 0), Vec3(0.5, 0.7, 0)};
  const std::optional<Vec3> point =
      point_beyond(1e-9, corners, surface, surface.index.closest(corners[0]).triangle);
  ASSERT_TRUE(point);
  EXPECT_EQ(*point, Vec3((corners[0] + corners[1] + corners[2]) / 3));
}

}  // namespace
}  // namespace isorelax
