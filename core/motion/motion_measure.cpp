#include "motion/motion_measure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "quality/triangle_metrics.h"
#include "surface/deviation.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

/// An edge that turns by more is folded.
constexpr double kFoldedDeg = 120;
constexpr double kSmallAngleDeg = 15;

double percentile(std::span<const double> sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

MotionMeasure measure_motion(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                             const Topology& topology, unsigned threads) {
  MotionMeasure measure;
  std::vector<double> angles = face_metric(FaceMetric::min_angle, positions, triangles, threads);
  const std::vector<double> areas = face_metric(FaceMetric::area, positions, triangles, threads);
  std::ranges::sort(angles);
  double sum = 0;
  for (const double angle : angles) sum += angle;
  const auto count = static_cast<double>(angles.size());
  measure.min_angle_deg = angles.front();
  measure.mean_angle_deg = sum / count;
  measure.angle_p01_deg = percentile(angles, 0.01);
  measure.angle_p05_deg = percentile(angles, 0.05);
  measure.angle_p50_deg = percentile(angles, 0.5);
  measure.below_15_deg =
      static_cast<double>(std::ranges::lower_bound(angles, kSmallAngleDeg) - angles.begin()) / count;
  const auto [least, most] = std::ranges::minmax(areas);
  measure.area_max_over_min = most / least;
  for (const double area : areas) measure.area += area;
  measure.volume = enclosed_volume(positions, triangles, threads);
  for (Corner corner = 0; corner < 3 * triangles.size(); ++corner) {
    const Corner other = topology.opposite(corner);
    if (other != kNone && other > corner &&
        dihedral_turn_deg(positions, triangles, topology, corner) > kFoldedDeg)
      ++measure.folded_edges;
  }
  return measure;
}

Distances distance_from_sphere(std::span<const Vec3> positions, const Vec3& centre, double radius) {
  DistanceSum sum;
  for (const Vec3& x : positions) sum.add(std::abs((x - centre).norm() - radius));
  return sum.result();
}

}  // namespace isorelax
