#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"
#include "surface/vertex_class.h"

namespace isorelax {

/// Vertices that a predicate names, ascending: what ProblemOptions::pinned takes.

/// All on the border, and on edges with more than two triangles.
[[nodiscard]] std::vector<Index> boundary_vertices(const Topology& topology);

/// All on ridges and in corners, classified with these options.
[[nodiscard]] std::vector<Index> feature_vertices(std::span<const Vec3> positions,
                                                  std::span<const Triangle> triangles,
                                                  const Topology& topology, const FeatureOptions& options,
                                                  unsigned threads = 0);

/// What a file marks by the groups of its elements (attributes kPhysicalGroup and kGeometricEntity): its
/// points, vertices on its lines inside the surface, those on the border where lines of two groups meet, and
/// those between triangles of two groups. Moved, they would change what the groups cover. None where elements
/// have no groups.
[[nodiscard]] std::vector<Index> marked_vertices(const TriangleMesh& mesh, const Topology& topology);

/// An axis-parallel box, faces included; infinite bounds are none.
struct Box {
  Vec3 low, high;
};
[[nodiscard]] std::vector<Index> vertices_in(const Box& box, std::span<const Vec3> positions);

}  // namespace isorelax
