#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Cosine of the turn over an edge beyond which it counts as a fold of a triangle: 150 degrees.
inline constexpr double kFoldCosine = -0.86602540378443865;

/// Ids of the triangles that lie upside down, ascending.
///
/// A mesh in one plane (to 1e-6 of its bounding-box diagonal): those whose signed area has the other sign
/// than the total signed area. Any other surface has no such sign, and a sharp crease is no fault; there a
/// triangle is inverted when it is folded over on its surroundings:
///   - the surface turns by more than 150 degrees across at least two of its edges (or across every edge that
///     has a triangle beyond it, where that is only one), and
///   - its normal opposes the area-weighted mean normal of the triangles that share a vertex with it,
/// or when it belongs to a patch that is folded over as a whole (folded_patches).
/// Only edges with exactly two triangles of consistent orientation are looked at. A degenerate triangle has
/// no side and is never inverted.
[[nodiscard]] std::vector<Index> inverted_triangles(std::span<const Vec3> positions,
                                                    std::span<const Triangle> triangles,
                                                    const Topology& topology, unsigned threads = 0);

/// The unit normal of a mesh that lies in one plane (to 1e-6 of its bounding-box diagonal), with the sign of
/// its total area; none for any other surface and where the total area is zero.
[[nodiscard]] std::optional<Vec3> plane_normal(std::span<const Vec3> positions,
                                               std::span<const Triangle> triangles, const Topology& topology,
                                               unsigned threads = 0);

}  // namespace isorelax
