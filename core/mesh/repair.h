#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

// Repairs happen only when asked for. Each changes the mesh, its attributes with it, and returns the ids
// (before the change, ascending) of what it changed: an empty list means that there was nothing to do.

/// Takes out triangles that name a vertex twice or have no area (see has_no_area).
std::vector<Index> remove_degenerate_triangles(TriangleMesh& mesh);

/// Takes out every triangle on the same three vertices as an earlier one.
std::vector<Index> remove_duplicate_triangles(TriangleMesh& mesh);

/// Takes out vertices in no triangle; the others keep their order and move up.
std::vector<Index> remove_isolated_vertices(TriangleMesh& mesh);

/// Turns triangles over (their second and third corner change places) so that neighbours agree: in each
/// component the fewest that will do. A component with one side only is left as it is.
std::vector<Index> orient_consistently(TriangleMesh& mesh);

}  // namespace isorelax
