#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Numbers for the vertices and triangles of a mesh under which what is needed together is near in memory:
/// along a space-filling curve.
struct Renumbering {
  /// By new number the old one. Both empty where the old numbers do, as those of grids and of most programs;
  /// scans and triangulations of scattered points are numbered at random.
  std::vector<Index> vertices, triangles;

  Renumbering() = default;
  Renumbering(std::span<const Vec3> positions, std::span<const Triangle> triangles);

  [[nodiscard]] bool empty() const { return vertices.empty(); }
};

/// values[order[0]], values[order[1]], ...; nothing where there are no values.
template <typename Values>
[[nodiscard]] auto in_order(std::span<const Index> order, const Values& values) {
  std::vector<typename Values::value_type> ordered;
  if (values.empty()) return ordered;
  ordered.reserve(order.size());
  for (const Index old : order) ordered.push_back(values[old]);
  return ordered;
}

/// By old number the new one.
[[nodiscard]] std::vector<Index> inverse(std::span<const Index> order);

}  // namespace isorelax
