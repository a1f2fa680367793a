#include "quality/triangle_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mesh/angle.h"
#include "mesh/degenerate.h"
#include "mesh/parallel.h"

namespace isorelax {
namespace {

constexpr std::array<std::pair<FaceMetric, std::string_view>, 8> kNames{{
    {FaceMetric::min_angle, "min-angle"},
    {FaceMetric::max_angle, "max-angle"},
    {FaceMetric::area, "area"},
    {FaceMetric::relative_area, "relative-area"},
    {FaceMetric::shape, "shape"},
    {FaceMetric::radius_ratio, "radius-ratio"},
    {FaceMetric::scaled_jacobian, "scaled-jacobian"},
    {FaceMetric::aspect_ratio, "aspect-ratio"},
}};

double value_of(const TriangleMetrics& m, FaceMetric metric) {
  switch (metric) {
    case FaceMetric::min_angle:
      return m.min_angle_deg;
    case FaceMetric::max_angle:
      return m.max_angle_deg;
    case FaceMetric::area:
    case FaceMetric::relative_area:
      return m.area;
    case FaceMetric::shape:
      return m.shape;
    case FaceMetric::radius_ratio:
      return m.radius_ratio;
    case FaceMetric::scaled_jacobian:
      return m.scaled_jacobian;
    case FaceMetric::aspect_ratio:
      return m.aspect_ratio;
  }
  return 0;
}

}  // namespace

TriangleMetrics measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Edge k is opposite to corner k; sorted by length, so that the smallest angle faces edge 0, the largest
  // edge 2.
  std::array<std::pair<double, Vec3>, 3> edges{{{0, c - b}, {0, a - c}, {0, b - a}}};
  for (auto& [squared, edge] : edges) squared = edge.squaredNorm();
  std::sort(edges.begin(), edges.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  const auto& [short2, short_edge] = edges[0];
  const auto& [middle2, middle_edge] = edges[1];
  const auto& [long2, long_edge] = edges[2];
  const double twice_area = short_edge.cross(middle_edge).norm();

  TriangleMetrics m;
  m.area = 0.5 * twice_area;
  m.degenerate = has_no_area(twice_area, long2);
  if (!(twice_area > 0)) {
    m.shape = std::numeric_limits<double>::infinity();
    m.aspect_ratio = m.shape;
    return m;
  }
  // The edges run head to tail: the angle between two of them has the cosine of minus their product.
  m.min_angle_deg = kDegrees * std::atan2(twice_area, -middle_edge.dot(long_edge));
  m.max_angle_deg = kDegrees * std::atan2(twice_area, -short_edge.dot(middle_edge));
  const double l0 = std::sqrt(short2);
  const double l1 = std::sqrt(middle2);
  const double l2 = std::sqrt(long2);
  const double perimeter = l0 + l1 + l2;
  m.shape = (short2 + middle2 + long2) / (std::numbers::sqrt3 * twice_area);
  m.radius_ratio = 4 * (twice_area / (l1 * l2)) * (twice_area / (l0 * perimeter));
  m.scaled_jacobian = 2 * twice_area / (std::numbers::sqrt3 * l1 * l2);
  m.aspect_ratio = l2 * perimeter / (2 * std::numbers::sqrt3 * twice_area);
  return m;
}

std::string_view metric_name(FaceMetric metric) {
  return std::find_if(kNames.begin(), kNames.end(), [&](const auto& n) { return n.first == metric; })->second;
}

std::optional<FaceMetric> metric_by_name(std::string_view name) {
  for (const auto& [metric, its_name] : kNames) {
    if (its_name == name) return metric;
  }
  return std::nullopt;
}

std::vector<Vec3> resized_if_extreme(std::span<const Vec3> positions) {
  double largest = 0;
  for (const Vec3& p : positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  if (largest == 0 || (largest > 1e-60 && largest < 1e60)) return {};
  const int exponent = -std::ilogb(largest);
  std::vector<Vec3> resized(positions.begin(), positions.end());
  for (Vec3& p : resized) {
    for (double& x : p) x = std::scalbn(x, exponent);
  }
  return resized;
}

std::vector<double> face_metric(FaceMetric metric, std::span<const Vec3> positions,
                                std::span<const Triangle> triangles, unsigned threads) {
  std::vector<Vec3> resized;
  if (metric != FaceMetric::area) resized = resized_if_extreme(positions);
  if (!resized.empty()) positions = resized;
  std::vector<double> values(triangles.size());
  std::vector<double> block_sums(block_count(triangles.size()), 0);
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      values[t] = value_of(measure_triangle(positions, triangles[t]), metric);
      sum += values[t];
    }
    block_sums[begin / kBlockSize] = sum;
  });
  if (metric == FaceMetric::relative_area) {
    double total = 0;
    for (const double sum : block_sums) total += sum;
    const double mean = total / static_cast<double>(values.size());
    if (mean > 0) {
      for (double& value : values) value /= mean;
    }
  }
  return values;
}

}  // namespace isorelax
