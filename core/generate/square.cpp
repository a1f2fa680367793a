#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "generate/random.h"
#include "generate/shake.h"
#include "generate/shapes.h"
#include "generate/triangulation.h"

namespace isorelax {
namespace {

/// Points of the random square are multiples of 2^-29: their triangulation is exact.
constexpr double kSquareGrid = 0x1p29;

/// Points evenly on the boundary, counter-clockwise from the origin; `count` >= 4 gives all corners.
std::vector<GridPoint> boundary_of_square(std::size_t count) {
  std::vector<GridPoint> points;
  const auto one = static_cast<std::int64_t>(kSquareGrid);
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t on_side = count / 4 + (side < count % 4 ? 1 : 0);
    for (std::size_t i = 0; i < on_side; ++i) {
      const auto along = static_cast<std::int64_t>(
          std::floor(kSquareGrid * static_cast<double>(i) / static_cast<double>(on_side)));
      const std::pair<std::int64_t, std::int64_t> at[4] = {
          {along, 0}, {one, along}, {one - along, one}, {0, one - along}};
      points.push_back({at[side].first, at[side].second, 0});
    }
  }
  return points;
}

}  // namespace

TriangleMesh make_random_square(const RandomSquareSize& size) {
  std::vector<GridPoint> points = boundary_of_square(size.boundary);
  std::set<std::pair<std::int64_t, std::int64_t>> taken;
  Random random(size.seed);
  while (points.size() < size.vertices) {
    const GridPoint p{static_cast<std::int64_t>(kSquareGrid * random.uniform()),
                      static_cast<std::int64_t>(kSquareGrid * random.uniform()), 0};
    if (p.x > 0 && p.y > 0 && taken.emplace(p.x, p.y).second) points.push_back(p);
  }
  TriangleMesh mesh;
  for (const GridPoint& p : points) {
    mesh.positions.emplace_back(static_cast<double>(p.x) / kSquareGrid,
                                static_cast<double>(p.y) / kSquareGrid, 0);
  }
  mesh.triangles = delaunay_triangles(points);
  return mesh;
}

namespace {

struct Lattice {
  std::size_t columns = 1;
  std::size_t strips = 1;
};

/// Rows of `columns` and `columns` + 1 edges in turn: strips * (2 columns + 1) triangles. Of the lattices
/// near equilateral the one that comes closest to the number asked for.
Lattice choose_lattice(std::size_t triangles) {
  const double wanted = static_cast<double>(triangles);
  const double equilateral = 2 / std::sqrt(3.0);
  const auto middle = static_cast<long>(std::lround(std::sqrt(wanted / (2 * equilateral))));
  Lattice best;
  double best_cost = wanted;
  for (long columns = std::max(1L, middle - 3); columns <= middle + 3; ++columns) {
    const double per_strip = 2.0 * static_cast<double>(columns) + 1;
    const auto strips = std::max(1L, std::lround(wanted / per_strip));
    const double stretch = static_cast<double>(strips) / (equilateral * static_cast<double>(columns));
    // A lattice of the right size that is stretched by more than a tenth is worse than one of another size.
    const double miss = std::abs(static_cast<double>(strips) * per_strip - wanted) / wanted;
    const double cost = miss + 10 * std::max(0.0, std::abs(std::log(stretch)) - std::log(1.1));
    if (cost < best_cost) {
      best = {static_cast<std::size_t>(columns), static_cast<std::size_t>(strips)};
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace

TriangleMesh make_hexagonal_square(const ShapeSize& size) {
  const auto [columns, strips] = choose_lattice(size.triangles);
  const double step = 1.0 / static_cast<double>(columns);
  TriangleMesh mesh;
  std::vector<Index> row_start;
  for (std::size_t row = 0; row <= strips; ++row) {
    row_start.push_back(mesh.vertex_count());
    const double y = static_cast<double>(row) / static_cast<double>(strips);
    const bool shifted = row % 2 == 1;
    for (std::size_t i = 0; i <= columns + (shifted ? 1 : 0); ++i) {
      const double x = (static_cast<double>(i) - (shifted ? 0.5 : 0)) * step;
      mesh.positions.emplace_back(i == columns && !shifted ? 1 : std::clamp(x, 0.0, 1.0), y, 0);
    }
  }
  for (std::size_t row = 0; row < strips; ++row) {
    const Index low = row_start[row];
    const Index high = row_start[row + 1];
    const bool shifted = row % 2 == 1;
    for (Index i = 0; i < columns; ++i) {
      if (shifted) {
        mesh.triangles.push_back({low + i, low + i + 1, high + i});
        mesh.triangles.push_back({low + i + 1, high + i + 1, high + i});
      } else {
        mesh.triangles.push_back({low + i, high + i + 1, high + i});
        mesh.triangles.push_back({low + i, low + i + 1, high + i + 1});
      }
    }
    const auto n = static_cast<Index>(columns);
    if (shifted) {
      mesh.triangles.push_back({low + n, low + n + 1, high + n});
    } else {
      mesh.triangles.push_back({low + n, high + n + 1, high + n});
    }
  }
  const std::vector<Vec3> regular = mesh.positions;
  Random random(size.seed);
  shake(
      mesh, size.jitter * step,
      [&](Index v, double s, double t) -> Vec3 {
        const Vec3& p = regular[v];
        const bool inside = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
        return inside ? Vec3(p + Vec3(s, t, 0)) : p;
      },
      random);
  return mesh;
}

}  // namespace isorelax
