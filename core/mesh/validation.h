#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesh/boundary.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// An edge between vertices a < b and its triangles, ascending.
struct EdgeFinding {
  Index a = 0;
  Index b = 0;
  std::vector<Index> triangles;
};

enum class DegenerateReason { repeated_vertex, zero_area };

struct DegenerateFinding {
  Index triangle = 0;
  DegenerateReason reason = DegenerateReason::zero_area;
};

/// A triangle on the same three vertices as an earlier one, in whatever order.
struct DuplicateFinding {
  Index triangle = 0;
  Index first = 0;
};

/// Triangles that hang together by edges.
struct ComponentFinding {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t boundary_loops = 0;
  bool orientable = true;
  /// vertices - edges + triangles.
  long euler_characteristic = 0;
  /// (2 - euler - boundary loops) / 2; none unless the component is manifold and orientable.
  std::optional<long> genus;
};

/// What a mesh is and what is wrong with it, every flaw with its ids (from 0, in file order, ascending).
struct ValidationReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  /// Edges with three or more triangles.
  std::vector<EdgeFinding> non_manifold_edges;
  /// Vertices on such an edge, and vertices in which several fans of triangles meet.
  std::vector<Index> non_manifold_vertices;
  /// Edges whose two triangles run along them in the same direction.
  std::vector<EdgeFinding> inconsistent_edges;
  std::vector<DegenerateFinding> degenerate;
  std::vector<DuplicateFinding> duplicates;
  std::vector<Index> isolated_vertices;
  std::vector<ComponentFinding> components;
  std::vector<BoundaryLoop> boundary;
  /// vertices in use - edges + triangles.
  long euler_characteristic = 0;
  /// Sum over the components; none where one of them has none.
  std::optional<long> genus;
  /// There are triangles and no edge has only one.
  bool closed = false;
  /// No inconsistent edge.
  bool oriented = true;
  /// Turning triangles over can make it oriented.
  bool orientable = true;

  [[nodiscard]] bool manifold() const { return non_manifold_edges.empty() && non_manifold_vertices.empty(); }
};

/// Triangles that name a vertex twice or have no area (see has_no_area), ascending.
[[nodiscard]] std::vector<DegenerateFinding> find_degenerate_triangles(const TriangleMesh& mesh);

/// Triangles on the same three vertices as an earlier one, ascending. O(T log T).
[[nodiscard]] std::vector<DuplicateFinding> find_duplicate_triangles(const TriangleMesh& mesh);

/// Looks at a mesh with whatever flaws. O(V + T log T). Throws nothing of its own.
[[nodiscard]] ValidationReport validate(const TriangleMesh& mesh);

}  // namespace isorelax
