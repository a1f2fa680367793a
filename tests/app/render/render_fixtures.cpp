#include "app/render/render_fixtures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace isorelax::render {
namespace {

std::array<double, 3> angles_of(const TriangleMesh& mesh, const Triangle& t) {
  std::array<double, 3> angles{};
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 u = mesh.positions[t[next(k)]] - mesh.positions[t[k]];
    const Vec3 v = mesh.positions[t[previous(k)]] - mesh.positions[t[k]];
    angles[k] = std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
  }
  return angles;
}

double double_area(const TriangleMesh& mesh, const Triangle& t) {
  return area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).norm();
}

std::vector<double> per_triangle(const TriangleMesh& mesh,
                                 const std::function<double(const Triangle&)>& value) {
  std::vector<double> values;
  for (const Triangle& t : mesh.triangles) values.push_back(value(t));
  return values;
}

/// Two triangles per cell of a grid whose rows and columns are numbered by `vertex`.
void add_cells(TriangleMesh& mesh, Index rows, Index columns,
               const std::function<Index(Index, Index)>& vertex) {
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = vertex(i, j);
      const Index b = vertex(i + 1, j);
      const Index c = vertex(i + 1, j + 1);
      const Index d = vertex(i, j + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
}

/// A torus whose vertex (i, j) stands at the angle turned(u, v) around the z axis.
void add_ring_of_rings(TriangleMesh& mesh, Index around, Index across,
                       const std::function<double(double, double)>& turned) {
  for (Index j = 0; j < across; ++j)
    for (Index i = 0; i < around; ++i) {
      const double v = 2 * std::numbers::pi * j / across;
      const double u = turned(2 * std::numbers::pi * i / around, v);
      const double r = 1 + 0.4 * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
    }
  add_cells(mesh, across, around, [&](Index i, Index j) { return (j % across) * around + i % around; });
}

}  // namespace

TriangleMesh jittered_square(Index cells, double jitter) {
  TriangleMesh mesh;
  std::uint32_t state = 1;
  const auto noise = [&] {
    state = state * 1664525U + 1013904223U;
    return (state >> 8U) / static_cast<double>(1U << 24U) - 0.5;
  };
  for (Index j = 0; j <= cells; ++j)
    for (Index i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      const double dx = inner ? 2 * jitter * noise() : 0;
      const double dy = inner ? 2 * jitter * noise() : 0;
      mesh.positions.emplace_back((i + dx) / cells, (j + dy) / cells, 0);
    }
  add_cells(mesh, cells, cells, [&](Index i, Index j) { return j * (cells + 1) + i; });
  return mesh;
}

TriangleMesh torus(Index around, Index across) {
  TriangleMesh mesh;
  add_ring_of_rings(mesh, around, across, [](double u, double) { return u; });
  return mesh;
}

TriangleMesh uneven_torus(Index around, Index across) {
  TriangleMesh mesh;
  add_ring_of_rings(mesh, around, across,
                    [](double u, double v) { return u + 0.45 * std::sin(u) + 0.12 * std::sin(6 * v); });
  return mesh;
}

std::vector<double> min_angles(const TriangleMesh& mesh) {
  return per_triangle(mesh, [&](const Triangle& t) { return std::ranges::min(angles_of(mesh, t)); });
}

std::vector<double> max_angles(const TriangleMesh& mesh) {
  return per_triangle(mesh, [&](const Triangle& t) { return std::ranges::max(angles_of(mesh, t)); });
}

std::vector<double> relative_areas(const TriangleMesh& mesh) {
  std::vector<double> areas = per_triangle(mesh, [&](const Triangle& t) { return double_area(mesh, t); });
  const double mean = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
  for (double& area : areas) area /= mean;
  return areas;
}

std::vector<double> shape_energies(const TriangleMesh& mesh) {
  return per_triangle(mesh, [&](const Triangle& t) {
    double squares = 0;
    for (unsigned k = 0; k < 3; ++k)
      squares += (mesh.positions[t[next(k)]] - mesh.positions[t[k]]).squaredNorm();
    return squares / (std::numbers::sqrt3 * double_area(mesh, t));
  });
}

}  // namespace isorelax::render
