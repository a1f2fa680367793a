#pragma once

#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Unit normals of the triangles, for SmoothingProblem::initial_normals. A sliver's own normal points
/// anywhere: where the other triangles about its corners that are on no ridge agree on one, it gets theirs,
/// unless it opposes that or an edge would seem to be folded by it. Zero for a triangle without area.
[[nodiscard]] std::vector<Vec3> initial_normals(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles, const Topology& topology,
                                                const VertexClasses& classes);

}  // namespace isorelax
