#pragma once

#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Unit normals of the triangles, for SmoothingProblem::initial_normals. A sliver's own normal points
/// anywhere: inside a face, where it is farther than a triangle may turn (TurnLimit) from the one on which
/// the other triangles about its corners agree, it gets theirs. Zero for a triangle without area.
[[nodiscard]] std::vector<Vec3> initial_normals(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                const VertexClasses& classes);

}  // namespace isorelax
