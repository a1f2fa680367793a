#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "surface/closest_point.h"

namespace isorelax {

/// A surface whose distance to another one is measured. Keeps references to all that it is made from.
struct IndexedSurface {
  IndexedSurface(std::span<const Vec3> x, std::span<const Triangle> t, const Topology& around);

  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  const Topology& topology;
  ClosestPointIndex index;
  std::vector<Vec3> normals;  ///< unit, of the triangles; zero where there is no area
  double rounding = 0;        ///< length that coordinates may be rounded by
};

/// The point of a triangle that was found to be farthest from the other surface.
struct FarPoint {
  double distance = 0;
  Vec3 point = Vec3::Zero();
  Index nearest = kNone;  ///< triangle of the other surface
};

/// How far one surface is from another.
struct OneWayDistance {
  FarPoint farthest;
  double squares = 0;  ///< integral of the squared distance over the surface that is measured
  double area = 0;     ///< of that surface
  std::vector<FarPoint> by_triangle;
};

/// Measures how far the points of surface a are from surface b, and those of b from a, by exact closest-point
/// searches.
///
/// The integral is from samples: vertices, midpoints of edges, centroids and points inside. The largest
/// distance is found to a thousandth, or to what coordinates are rounded by: where a triangle is not shown to
/// be nearer than the largest that was found (point_beyond), it is halved until it is. How often is bounded:
/// where surfaces are far from lying over each other, less may be found. Never above the true distance. The
/// same for any number of threads.
[[nodiscard]] std::array<OneWayDistance, 2> measure_both_ways(const IndexedSurface& a,
                                                              const IndexedSurface& b, unsigned threads);

}  // namespace isorelax
