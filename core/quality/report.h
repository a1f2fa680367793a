#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// The quality of a mesh in a few numbers; the definitions per triangle stand in TriangleMetrics. Means and
/// shares run over all triangles, degenerate ones included. A number that is infinite because a triangle has
/// no area stays infinite here (JSON writes null).
struct QualityReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  double min_angle_deg = 0;
  double max_angle_deg = 0;
  double mean_min_angle_deg = 0;  ///< mean over triangles of each one's smallest angle
  double below_20_deg = 0;        ///< share (0..1) of triangles whose smallest angle is under 20 degrees
  double below_30_deg = 0;
  double above_120_deg = 0;  ///< share of triangles whose largest angle is over 120 degrees
  double area_max_over_min = 0;
  double area_std_over_mean = 0;  ///< population standard deviation
  double shape_mean = 0;
  double shape_max = 0;
  double radius_ratio_min = 0;
  double scaled_jacobian_min = 0;
  double aspect_ratio_max = 0;
  std::size_t inverted = 0;    ///< see inverted_triangles()
  std::size_t degenerate = 0;  ///< see TriangleMetrics
};

/// Measures a mesh. Results do not depend on `threads` (0: all).
///
/// Precondition: `topology` belongs to `triangles`. Throws MeshError when there is no triangle.
[[nodiscard]] QualityReport measure_quality(std::span<const Vec3> positions,
                                            std::span<const Triangle> triangles, const Topology& topology,
                                            unsigned threads = 0);
/// The same for a mesh whose topology is not at hand.
[[nodiscard]] QualityReport measure_quality(const TriangleMesh& mesh, unsigned threads = 0);

}  // namespace isorelax
