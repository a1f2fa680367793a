#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// Length of the diagonal of the positions' bounding box; 0 of none.
[[nodiscard]] double bounding_diagonal(std::span<const Vec3> positions);

/// How far a surface whose vertices moved is from what it was.
struct Deviation {
  double max = 0;  ///< largest distance between the two surfaces, over the original's bounding-box diagonal
  double rms = 0;  ///< root of the mean squared distance over the area of both, over the same diagonal
  /// (new - old) / old enclosed volume, whichever way the surface faces; 0 where nothing is enclosed.
  double volume_change = 0;
  /// Whether the surface encloses a volume (encloses_volume): volume_change means something.
  bool has_volume = false;
  double normal_change_deg = 0;  ///< largest turn of a triangle's normal, of triangles that have area
  double max_to_original = 0;  ///< largest distance from a point of the new surface to the original, relative
  double max_to_new = 0;       ///< and from a point of the original to the new one
};

/// Whether a largest distance is over a limit, both over the diagonal, by more than rounding: the distance of
/// a surface from itself is not always 0.
[[nodiscard]] constexpr bool is_over_limit(double max, double limit) {
  constexpr double kRounding = 1e-14;
  return max > limit && max > kRounding;
}

/// Measures both ways, from the new surface to the original and from the original to the new one, each by an
/// exact closest-point search (method Sec. 9).
///
/// For the mean, every vertex, every edge's midpoint, every triangle's centroid and three more points inside,
/// barycentric (2/3, 1/6, 1/6), are looked at: the mean square weighs each triangle by its area, with the
/// mean of two quadrature rules that are both exact for quadratics: (vertices 1/20, midpoints 2/15, centroid
/// 9/20) and the three inner points. The largest distance is found to about a thousandth: measure_both_ways.
///
/// Infinite where a position is not finite, or so large that squares of distances are not.
///
/// `topology` is that of `triangles`; all indices below both sizes. The same for any number of threads.
[[nodiscard]] Deviation measure_deviation(std::span<const Vec3> original, std::span<const Vec3> changed,
                                          std::span<const Triangle> triangles, const Topology& topology,
                                          unsigned threads = 0);

/// A deviation and where it is.
struct DeviationByTriangle {
  Deviation whole;
  /// Largest distance that was found on each triangle of the new surface, either way, over the diagonal; the
  /// largest of all is whole.max. A part of the original counts for the triangle that its farthest sample is
  /// nearest to: who keeps a limit takes back the triangles above it and measures again.
  std::vector<double> largest;
};

/// The same measurement, with its largest distance for each triangle.
[[nodiscard]] DeviationByTriangle measure_deviation_by_triangle(std::span<const Vec3> original,
                                                                std::span<const Vec3> changed,
                                                                std::span<const Triangle> triangles,
                                                                const Topology& topology,
                                                                unsigned threads = 0);

/// Volume enclosed by consistently oriented triangles, positive with normals to the outside: the divergence
/// theorem about the mean of the vertices. Cubed length units; meaningless for an open surface.
[[nodiscard]] double enclosed_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                     unsigned threads = 0);

/// Whether the surface is closed, consistently oriented and encloses a volume; not that of a flat one.
/// `topology` is that of `triangles`.
[[nodiscard]] bool encloses_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                   const Topology& topology, unsigned threads = 0);

/// Whether the front sides of a surface look into what it encloses: it is closed, or but for holes of less
/// than a quarter of its area, consistently oriented, and its volume is negative.
[[nodiscard]] bool faces_inward(std::span<const Vec3> positions, std::span<const Triangle> triangles);

}  // namespace isorelax
