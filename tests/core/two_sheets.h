#pragma once

#include <utility>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Adds the mesh to itself once more, with each vertex where `place` says, and turned over if it is to face
/// the other way.
template <typename Place>
void add_copy(TriangleMesh& mesh, bool turned_over, const Place& place) {
  const Index first = mesh.vertex_count();
  for (Index v = 0; v < first; ++v) mesh.positions.emplace_back(place(Vec3(mesh.positions[v])));
  for (std::size_t t = 0, count = mesh.triangles.size(); t < count; ++t) {
    auto [a, b, c] = mesh.triangles[t];
    if (turned_over) std::swap(a, b);
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
}

}  // namespace isorelax
