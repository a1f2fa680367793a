#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Unit normals of the triangles at the start.
struct InitialNormals {
  std::vector<Vec3> own;                   ///< by triangle
  std::unordered_map<Index, Vec3> around;  ///< of the surroundings of triangles that stand on them
};

/// For SmoothingProblem::initial_normals. A sliver's own normal points anywhere: where the other triangles
/// about its corners that are on no ridge agree on one, it gets theirs, unless it opposes that or an edge
/// would seem to be folded by it. What stands on surroundings that agree is what noise makes of a thin
/// triangle. Zero for a triangle without area.
[[nodiscard]] InitialNormals initial_normals(std::span<const Vec3> positions,
                                             std::span<const Triangle> triangles, const Topology& topology,
                                             const VertexClasses& classes);

}  // namespace isorelax
