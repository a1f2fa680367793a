#include "quality/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "quality/inverted.h"
#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is gathered over one block of triangles.
struct Tally {
  double min_angle = kInfinity;
  double max_angle = 0;
  double min_angle_sum = 0;
  double area_sum = 0;
  double area_min = kInfinity;
  double area_max = 0;
  double shape_sum = 0;
  double shape_max = 0;
  double radius_ratio_min = kInfinity;
  double scaled_jacobian_min = kInfinity;
  double aspect_ratio_max = 0;
  std::size_t below_20 = 0;
  std::size_t below_30 = 0;
  std::size_t above_120 = 0;
  std::size_t degenerate = 0;

  void add(const TriangleMetrics& m);
  void add(const Tally& other);
};

void Tally::add(const TriangleMetrics& m) {
  min_angle = std::min(min_angle, m.min_angle_deg);
  max_angle = std::max(max_angle, m.max_angle_deg);
  min_angle_sum += m.min_angle_deg;
  area_sum += m.area;
  area_min = std::min(area_min, m.area);
  area_max = std::max(area_max, m.area);
  shape_sum += m.shape;
  shape_max = std::max(shape_max, m.shape);
  radius_ratio_min = std::min(radius_ratio_min, m.radius_ratio);
  scaled_jacobian_min = std::min(scaled_jacobian_min, m.scaled_jacobian);
  aspect_ratio_max = std::max(aspect_ratio_max, m.aspect_ratio);
  below_20 += m.min_angle_deg < 20 ? 1 : 0;
  below_30 += m.min_angle_deg < 30 ? 1 : 0;
  above_120 += m.max_angle_deg > 120 ? 1 : 0;
  degenerate += m.degenerate ? 1 : 0;
}

void Tally::add(const Tally& other) {
  min_angle = std::min(min_angle, other.min_angle);
  max_angle = std::max(max_angle, other.max_angle);
  min_angle_sum += other.min_angle_sum;
  area_sum += other.area_sum;
  area_min = std::min(area_min, other.area_min);
  area_max = std::max(area_max, other.area_max);
  shape_sum += other.shape_sum;
  shape_max = std::max(shape_max, other.shape_max);
  radius_ratio_min = std::min(radius_ratio_min, other.radius_ratio_min);
  scaled_jacobian_min = std::min(scaled_jacobian_min, other.scaled_jacobian_min);
  aspect_ratio_max = std::max(aspect_ratio_max, other.aspect_ratio_max);
  below_20 += other.below_20;
  below_30 += other.below_30;
  above_120 += other.above_120;
  degenerate += other.degenerate;
}

QualityReport measure(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                      const Topology& topology, unsigned threads) {
  std::vector<double> areas(triangles.size());
  std::vector<Tally> tallies(block_count(triangles.size()));
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    Tally& tally = tallies[begin / kBlockSize];
    for (std::size_t t = begin; t < end; ++t) {
      const TriangleMetrics m = measure_triangle(positions, triangles[t]);
      areas[t] = m.area;
      tally.add(m);
    }
  });
  Tally all;
  for (const Tally& tally : tallies) all.add(tally);

  const auto count = static_cast<double>(triangles.size());
  const double area_mean = all.area_sum / count;
  double squares = 0;
  for (const double area : areas) squares += (area - area_mean) * (area - area_mean);

  QualityReport report;
  report.vertices = positions.size();
  report.triangles = triangles.size();
  report.min_angle_deg = all.min_angle;
  report.max_angle_deg = all.max_angle;
  report.mean_min_angle_deg = all.min_angle_sum / count;
  report.below_20_deg = static_cast<double>(all.below_20) / count;
  report.below_30_deg = static_cast<double>(all.below_30) / count;
  report.above_120_deg = static_cast<double>(all.above_120) / count;
  report.area_max_over_min = all.area_min > 0 ? all.area_max / all.area_min : kInfinity;
  report.area_std_over_mean = area_mean > 0 ? std::sqrt(squares / count) / area_mean : 0;
  report.shape_mean = all.shape_sum / count;
  report.shape_max = all.shape_max;
  report.radius_ratio_min = all.radius_ratio_min;
  report.scaled_jacobian_min = all.scaled_jacobian_min;
  report.aspect_ratio_max = all.aspect_ratio_max;
  report.degenerate = all.degenerate;
  report.inverted = inverted_triangles(positions, triangles, topology, threads).size();
  return report;
}

}  // namespace

QualityReport measure_quality(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                              const Topology& topology, unsigned threads) {
  if (triangles.empty()) throw MeshError("the mesh has no triangles to measure");
  // Every number in the report is free of units.
  const std::vector<Vec3> resized = resized_if_extreme(positions);
  return measure(resized.empty() ? positions : resized, triangles, topology, threads);
}

QualityReport measure_quality(const TriangleMesh& mesh, unsigned threads) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  return measure_quality(mesh.positions, mesh.triangles, topology, threads);
}

}  // namespace isorelax
