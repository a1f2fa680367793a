#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"
#include "surface/closest_point.h"

namespace isorelax {

/// Pairs of triangles that cross each other: an edge of one passes through the inside of the other, by more
/// than coordinates are rounded by. Each pair once, the smaller number first, in ascending order.
///
/// What only touches does not cross, nor do triangles that share an edge or lie in one plane.
///
/// `index` is that of the positions and triangles. The same for any number of threads.
[[nodiscard]] std::vector<std::array<Index, 2>> crossing_pairs(const ClosestPointIndex& index,
                                                               std::span<const Vec3> positions,
                                                               std::span<const Triangle> triangles,
                                                               unsigned threads = 0);

/// Those pairs of which at least one is among `some`.
[[nodiscard]] std::vector<std::array<Index, 2>> crossing_pairs_of(std::span<const Index> some,
                                                                  const ClosestPointIndex& index,
                                                                  std::span<const Vec3> positions,
                                                                  std::span<const Triangle> triangles,
                                                                  unsigned threads = 0);

/// Pairs of border edges that cross in a mesh that lies in the plane with this unit normal, each named by the
/// corner opposite to it: what it covers there, it covers twice. Else as above.
[[nodiscard]] std::vector<std::array<Corner, 2>> crossing_borders(std::span<const Vec3> positions,
                                                                  std::span<const Triangle> triangles,
                                                                  const Topology& topology,
                                                                  const Vec3& normal, unsigned threads = 0);

/// Whether two of the triangles cross.
[[nodiscard]] bool do_cross(std::span<const Vec3> positions, const Triangle& s, const Triangle& t);

}  // namespace isorelax
