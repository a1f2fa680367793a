#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// Which way each triangle of a surface ought to face.
struct OrientationField {
  std::vector<Vec3> normals;         ///< unit, one per triangle
  std::vector<std::uint8_t> judged;  ///< per triangle: whether the field may say that it is upside down
  bool planar = false;               ///< one normal for all
};

/// The field of a mesh in which some triangles may lie upside down. In a plane (to 1e-6 of the extent) the
/// normal of the whole, which judges all.
OrientationField find_orientation(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, unsigned threads = 0);

}  // namespace isorelax
