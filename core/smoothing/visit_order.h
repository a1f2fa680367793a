#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// In what order to look at the vertices and triangles of a mesh so that what is needed next is near in
/// memory. Both empty where their numbers do that already, as those of grids and of most programs; scans and
/// triangulations of scattered points are numbered at random. No result depends on it.
struct VisitOrder {
  std::vector<Index> vertices, triangles;

  VisitOrder() = default;
  /// Along a space-filling curve.
  VisitOrder(std::span<const Vec3> positions, std::span<const Triangle> triangles);
};

}  // namespace isorelax
