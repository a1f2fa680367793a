#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/random.h"
#include "generate/shake.h"
#include "generate/shapes.h"
#include "generate/triangulation.h"

namespace isorelax {
namespace {

/// Grid for the hull of points on the unit sphere: fine enough that points a millionth apart are all corners.
constexpr double kSphereGrid = 0x1p39;

TriangleMesh hull_of_sphere(std::vector<Vec3> points) {
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const Vec3& p : points) {
    grid.push_back({std::llround(kSphereGrid * p.x()), std::llround(kSphereGrid * p.y()),
                    std::llround(kSphereGrid * p.z())});
  }
  TriangleMesh mesh;
  mesh.triangles = hull_triangles(grid);
  mesh.positions = std::move(points);
  return mesh;
}

void shake_sphere(TriangleMesh& mesh, const ShapeSize& size) {
  const std::vector<Vec3> original = mesh.positions;
  Random random(size.seed);
  shake(
      mesh, size.jitter * spacing_for(4 * std::numbers::pi, size.triangles),
      [&](Index v, double s, double t) -> Vec3 {
        const Vec3& p = original[v];
        const Vec3 first = p.unitOrthogonal();
        return (p + s * first + t * p.cross(first)).normalized();
      },
      random);
}

}  // namespace

TriangleMesh make_fibonacci_sphere(const ShapeSize& size) {
  const std::size_t count = (size.triangles + 4) / 2;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double radius = std::sqrt((1 - z) * (1 + z));
    const double angle = golden_angle * static_cast<double>(i);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  TriangleMesh mesh = hull_of_sphere(std::move(points));
  shake_sphere(mesh, size);
  return mesh;
}

TriangleMesh make_random_sphere(const ShapeSize& size) {
  const std::size_t count = (size.triangles + 4) / 2;
  Random random(size.seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = random.uniform(-1, 1);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double radius = std::sqrt((1 - z) * (1 + z));
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return hull_of_sphere(std::move(points));
}

TriangleMesh make_torus(const ShapeSize& size) {
  constexpr double kMajor = 1;
  constexpr double kMinor = 0.4;
  constexpr double kTurn = 2 * std::numbers::pi;
  // Rows shifted by half a step in turn make nearly equilateral triangles; so their number must be even.
  const double spacing = spacing_for(kTurn * kTurn * kMajor * kMinor, size.triangles);
  const double row_height = std::sqrt(0.75) * spacing;
  const auto rows = 2 * std::max<Index>(2, static_cast<Index>(std::lround(kTurn * kMajor / row_height / 2)));
  const auto columns =
      std::max<Index>(3, static_cast<Index>(std::lround(static_cast<double>(size.triangles) / (2.0 * rows))));
  const auto place = [&](Index v, double s, double t) -> Vec3 {
    const Index row = v / columns;
    const double u = kTurn * row / rows + s / kMajor;
    const double w = kTurn * (v % columns + (row % 2 == 1 ? 0.5 : 0)) / columns + t / kMinor;
    const double radius = kMajor + kMinor * std::cos(w);
    return {radius * std::cos(u), radius * std::sin(u), kMinor * std::sin(w)};
  };
  TriangleMesh mesh;
  for (Index v = 0; v < rows * columns; ++v) mesh.positions.push_back(place(v, 0, 0));
  for (Index row = 0; row < rows; ++row) {
    const Index low = row * columns;
    const Index high = (row + 1) % rows * columns;
    for (Index i = 0; i < columns; ++i) {
      const Index j = (i + 1) % columns;
      if (row % 2 == 0) {
        mesh.triangles.push_back({low + i, high + i, low + j});
        mesh.triangles.push_back({low + j, high + i, high + j});
      } else {
        mesh.triangles.push_back({low + i, high + i, high + j});
        mesh.triangles.push_back({low + i, high + j, low + j});
      }
    }
  }
  Random random(size.seed);
  shake(mesh, size.jitter * spacing, place, random);
  return mesh;
}

}  // namespace isorelax
