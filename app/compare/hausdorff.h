#pragma once

#include "mesh/triangle_mesh.h"

namespace isorelax::compare {

/// The farthest that one surface is from another.
struct OneSided {
  double distance = 0;       ///< length units
  Vec3 from = Vec3::Zero();  ///< the point that is so far away
  Vec3 to = Vec3::Zero();    ///< what is closest to it on the other surface
};

/// Hausdorff distance from every point of `from` to the surface `to`, whatever the connectivity of both:
/// vertices, edges' midpoints, triangles' centroids and three more points inside each are sampled by an exact
/// closest-point search; the 64 triangles that hold the largest distances are searched on a finer grid. Never
/// above the true distance. Precondition: both have triangles.
[[nodiscard]] OneSided farthest(const TriangleMesh& from, const TriangleMesh& to);

}  // namespace isorelax::compare
