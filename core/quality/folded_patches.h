#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Cosine of the turn over an edge beyond which it cuts patches apart: 120 degrees.
inline constexpr double kPatchFoldCosine = -0.5;

/// One flag per triangle: whether it belongs to a patch that is folded over. Patches are what the edges
/// across which the surface turns by more than 120 degrees cut a mesh into. Those with more than a tenth of
/// the triangles of their connected part are right side up (a lens or a thin leaf has two such halves), else
/// the largest; from there every fold leads to the other side.
[[nodiscard]] std::vector<std::uint8_t> folded_patches(std::span<const Vec3> positions,
                                                       std::span<const Triangle> triangles,
                                                       const Topology& topology);

}  // namespace isorelax
