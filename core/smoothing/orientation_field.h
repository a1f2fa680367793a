#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// Which way each triangle of a surface ought to face.
struct OrientationField {
  std::vector<Vec3> normals;         ///< unit, one per triangle; zero where nothing tells
  std::vector<Vec3> vertex_normals;  ///< unit, one per vertex; empty in a plane
  bool planar = false;               ///< one normal for all
};

/// On a surface, the triangles that certainly lie upside down and those that may, ascending: that oppose the
/// mean normal at two of their vertices, or at one if they are near a certain one or beside a fold. That
/// normal does not depend on where its vertex itself is.
std::vector<Index> doubtful_triangles(const std::vector<Index>& inverted, std::span<const Vec3> x,
                                      std::span<const Triangle> triangles, const Topology& topology);

/// The field of a mesh in which the triangles `inverted` lie upside down. In a plane (to 1e-6 of the extent)
/// the normal of the whole. On other surfaces the normals of the triangles themselves where no vertex touches
/// an inverted one; elsewhere the mean of the normals at the vertices, which are interpolated harmonically
/// between those that touch none.
OrientationField find_orientation(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, std::span<const Index> inverted,
                                  unsigned threads = 0);

}  // namespace isorelax
