#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// A chain of boundary edges, the vertices in order with the surface to the left.
struct BoundaryLoop {
  std::vector<Index> vertices;
  /// A loop that returns to its first vertex. False where an edge with three or more triangles cuts it off.
  bool closed = true;
  /// A triangle at the boundary: tells the component.
  Index triangle = 0;
};

/// Every boundary edge in exactly one loop. At a vertex where several fans of triangles meet, a loop follows
/// the fan it came along. Works on any triangles; O(T).
[[nodiscard]] std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles,
                                                       const Topology& topology);

}  // namespace isorelax
