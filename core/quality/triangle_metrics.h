#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Everything that is measured on one triangle. With edges l0, l1, l2, area A, circumradius R and inradius r:
///
///   shape            (l0^2 + l1^2 + l2^2) / (2 sqrt(3) A)     2 when equilateral, grows without bound
///   radius_ratio     2 r / R = 16 A^2 / (l0 l1 l2 (l0+l1+l2)) 1 when equilateral, 0 when degenerate
///   scaled_jacobian  (2/sqrt(3)) sin(min angle), that is (2/sqrt(3)) 2 A over the product of the two longest
///                    edges                            1 when equilateral, 0 when degenerate
///   aspect_ratio     l_max (l0+l1+l2) / (4 sqrt(3) A)  1 when equilateral, grows without bound
///
/// `shape` is K of the near-isometry energy against the equilateral reference. The last three are the Verdict
/// library's, except that Verdict gives the radius ratio upside down (R / 2r, 1 and more): here the worst
/// triangle is the one with the smallest ratio.
///
/// A triangle is `degenerate` when A <= 1e-14 l_max^2: its height is at the rounding error of its
/// coordinates. At A = 0 exactly: min_angle_deg 0, max_angle_deg 180, shape and aspect_ratio infinite, the
/// others 0.
struct TriangleMetrics {
  double min_angle_deg = 0;
  double max_angle_deg = 180;
  double area = 0;
  double shape = 0;
  double radius_ratio = 0;
  double scaled_jacobian = 0;
  double aspect_ratio = 0;
  bool degenerate = true;
};

/// Metrics of the triangle (a, b, c). Angles by atan2(|cross|, dot), exact to rounding for slivers too.
[[nodiscard]] TriangleMetrics measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
/// Of a triangle of a mesh. Precondition: its indices are below positions.size().
[[nodiscard]] inline TriangleMetrics measure_triangle(std::span<const Vec3> positions,
                                                      const Triangle& triangle) {
  return measure_triangle(positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]);
}

/// One number per triangle, for colours, histograms and lists of the worst.
enum class FaceMetric {
  min_angle,
  max_angle,
  area,
  relative_area,  ///< area over the mean area of the mesh
  shape,
  radius_ratio,
  scaled_jacobian,
  aspect_ratio
};

/// Name used on the command line and in files: "min-angle", "max-angle", "area", "relative-area", "shape",
/// "radius-ratio", "scaled-jacobian", "aspect-ratio".
[[nodiscard]] std::string_view metric_name(FaceMetric metric);
[[nodiscard]] std::optional<FaceMetric> metric_by_name(std::string_view name);

/// Where fourth powers of lengths would leave the range of double, the positions at another size: a power of
/// two changes no digit of what is free of units. Else nothing.
[[nodiscard]] std::vector<Vec3> resized_if_extreme(std::span<const Vec3> positions);

/// The metric of every triangle, in triangle order; infinite where the metric is. Parallel, the same for any
/// number of threads (0: all). Precondition: indices below positions.size().
[[nodiscard]] std::vector<double> face_metric(FaceMetric metric, std::span<const Vec3> positions,
                                              std::span<const Triangle> triangles, unsigned threads = 0);

}  // namespace isorelax
