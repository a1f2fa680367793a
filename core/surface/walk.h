#pragma once

#include "mesh/topology.h"
#include "surface/closest_point.h"

namespace isorelax {

/// From triangle to triangle as long as that comes nearer to a point, over the edge or about the vertex that
/// the closest point of the last one lies on: mostly the closest point of all. Never worse than `start`.
/// `foot` tells the closest point of a triangle, `across` the corner opposite to a corner's edge or kNone,
/// `about` the corners about a corner's vertex that the walk may go to.
template <typename Foot, typename Across, typename About>
SurfacePoint walk_nearer(const SurfacePoint& start, const Foot& foot, const Across& across,
                         const About& about) {
  // Rounding must not decide between an edge and its end, or a triangle and its edge: these are weights.
  constexpr double kAtVertex = 1 - 1e-3;
  constexpr double kAtEdge = 1e-9;
  constexpr int kMaxSteps = 1000;
  SurfacePoint best = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    SurfacePoint nearest = best;
    const auto look_at = [&](Index triangle) {
      const SurfacePoint found = foot(triangle);
      if (found.distance < nearest.distance) nearest = found;
    };
    for (unsigned k = 0; k < 3; ++k) {
      const Corner corner = 3 * best.triangle + k;
      if (best.barycentric[k] >= kAtVertex) {
        for (const Corner c : about(corner)) look_at(c / 3);
      } else if (best.barycentric[k] <= kAtEdge && across(corner) != kNone) {
        look_at(across(corner) / 3);
      }
    }
    if (nearest.triangle == best.triangle) break;
    best = nearest;
  }
  return best;
}

/// walk_nearer over all edges and about all vertices of a mesh.
template <typename Foot>
SurfacePoint walk_over_mesh(const SurfacePoint& start, const Foot& foot, std::span<const Triangle> triangles,
                            const Topology& topology) {
  return walk_nearer(
      start, foot, [&](Corner c) { return topology.opposite(c); },
      [&](Corner c) { return topology.corners_of(triangles[c / 3][c % 3]); });
}

}  // namespace isorelax
