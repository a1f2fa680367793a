#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// What is special about a vertex's surroundings; a bit mask.
enum VertexFlag : std::uint8_t {
  kBoundaryVertex = 1,      ///< on an edge with one triangle
  kNonManifoldVertex = 2,   ///< on an edge with three or more triangles, or several fans meet in it
  kIsolatedVertex = 4,      ///< in no triangle
  kInconsistentVertex = 8,  ///< on an edge whose two triangles run along it in the same direction
  kRepeatedVertex = 16,     ///< in a triangle that names a vertex twice
};

/// Who touches whom, as flat arrays (compressed rows). Built once for a set of triangles; positions play no
/// part.
///
/// Accepts any triangles whose indices are below `vertex_count`, flawed ones too. O(V + T).
class Topology {
 public:
  Topology() = default;
  Topology(std::span<const Triangle> triangles, Index vertex_count);

  [[nodiscard]] Index vertex_count() const { return static_cast<Index>(flags_.size()); }
  [[nodiscard]] Index triangle_count() const { return static_cast<Index>(opposite_.size() / 3); }

  /// Corners at a vertex in ascending order: a sum over them is the same in any run.
  [[nodiscard]] std::span<const Corner> corners_of(Index vertex) const {
    return {corners_.data() + offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]};
  }
  /// Row starts of `corners_of`: vertex_count() + 1 entries.
  [[nodiscard]] std::span<const std::uint32_t> corner_offsets() const { return offsets_; }

  /// The corner that faces this one across the edge they are both opposite to; kNone on a boundary edge and
  /// on an edge with three or more triangles.
  [[nodiscard]] Corner opposite(Corner corner) const { return opposite_[corner]; }
  /// Whether the edge opposite to this corner has exactly this one triangle.
  [[nodiscard]] bool is_boundary_edge(Corner corner) const { return edge_triangles_[corner] == 1; }
  /// Triangles at the edge opposite to this corner; 255 means 255 or more; 0: the edge joins a vertex to
  /// itself.
  [[nodiscard]] unsigned edge_triangle_count(Corner corner) const { return edge_triangles_[corner]; }

  /// Bits of VertexFlag.
  [[nodiscard]] std::uint8_t flags(Index vertex) const { return flags_[vertex]; }
  [[nodiscard]] bool is_boundary(Index vertex) const { return (flags_[vertex] & kBoundaryVertex) != 0; }

 private:
  void pair_edges(std::span<const Triangle> triangles);
  void find_several_fans(std::span<const Triangle> triangles);
  Corner across(std::span<const Triangle> triangles, Corner edge, Index pivot) const;

  std::vector<std::uint32_t> offsets_;
  std::vector<Corner> corners_;
  std::vector<Corner> opposite_;
  std::vector<std::uint8_t> edge_triangles_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace isorelax
