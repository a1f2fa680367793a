#include "surface/deviation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/angle.h"
#include "mesh/degenerate.h"
#include "mesh/parallel.h"
#include "surface/surface_distance.h"

namespace isorelax {
namespace {

/// A flat closed surface encloses rounding errors only: less than this share of its diagonal cubed.
constexpr double kLeastVolume = 1e-12;

/// The holes of a surface that is all but closed take less than this share of its area.
constexpr double kLargestHoles = 0.25;

bool is_oriented(const Topology& topology) {
  for (Corner c = 0; c < 3 * topology.triangle_count(); ++c)
    if (topology.edge_triangle_count(c) > 2) return false;
  for (Index v = 0; v < topology.vertex_count(); ++v)
    if (topology.flags(v) & kInconsistentVertex) return false;
  return topology.triangle_count() > 0;
}

bool is_closed(const Topology& topology) {
  for (Corner c = 0; c < 3 * topology.triangle_count(); ++c)
    if (topology.is_boundary_edge(c)) return false;
  return is_oriented(topology);
}

/// Whether the area vectors add up to little: those of a closed surface add up to nothing.
bool has_small_holes(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const Triangle& t : triangles) {
    const Vec3 vector = area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
    sum += vector;
    area += vector.norm();
  }
  return sum.norm() < kLargestHoles * area;
}

/// Whether squares of distances stay in range.
bool can_be_measured(std::span<const Vec3> positions) {
  constexpr double kLargestSquare = 1e300;
  return std::all_of(positions.begin(), positions.end(),
                     [](const Vec3& x) { return x.squaredNorm() <= kLargestSquare; });
}

double largest_normal_change(std::span<const Vec3> before, std::span<const Vec3> after,
                             std::span<const Triangle> triangles, unsigned threads) {
  std::vector<double> largest(block_count(triangles.size()), 0);
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = triangles[t];
      if (has_no_area(before[a], before[b], before[c]) || has_no_area(after[a], after[b], after[c])) continue;
      const Vec3 m = area_vector(before[a], before[b], before[c]);
      const Vec3 n = area_vector(after[a], after[b], after[c]);
      double& most = largest[begin / kBlockSize];
      most = std::max(most, angle_between(m, n));
    }
  });
  double all = 0;
  for (const double part : largest) all = std::max(all, part);
  return all * kDegrees;
}

}  // namespace

double bounding_diagonal(std::span<const Vec3> positions) {
  if (positions.empty()) return 0;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : positions) box.extend(x);
  return box.diagonal().norm();
}

double enclosed_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                       unsigned threads) {
  if (positions.empty()) return 0;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : positions) centre += x / static_cast<double>(positions.size());
  std::vector<double> parts(block_count(triangles.size()), 0);
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3 a = positions[triangles[t][0]] - centre;
      const Vec3 b = positions[triangles[t][1]] - centre;
      const Vec3 c = positions[triangles[t][2]] - centre;
      parts[begin / kBlockSize] += a.dot(b.cross(c)) / 6;
    }
  });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

bool encloses_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                     const Topology& topology, unsigned threads) {
  if (!is_closed(topology)) return false;
  const double diagonal = bounding_diagonal(positions);
  return std::abs(enclosed_volume(positions, triangles, threads)) >
         kLeastVolume * diagonal * diagonal * diagonal;
}

bool faces_inward(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  const double diagonal = bounding_diagonal(positions);
  const double volume = enclosed_volume(positions, triangles);
  // Most meshes need no topology to be told from these.
  if (!(volume < -kLeastVolume * diagonal * diagonal * diagonal)) return false;
  return has_small_holes(positions, triangles) &&
         is_oriented(Topology(triangles, static_cast<Index>(positions.size())));
}

Deviation measure_deviation(std::span<const Vec3> original, std::span<const Vec3> changed,
                            std::span<const Triangle> triangles, const Topology& topology, unsigned threads) {
  return measure_deviation_by_triangle(original, changed, triangles, topology, threads).whole;
}

DeviationByTriangle measure_deviation_by_triangle(std::span<const Vec3> original,
                                                  std::span<const Vec3> changed,
                                                  std::span<const Triangle> triangles,
                                                  const Topology& topology, unsigned threads) {
  DeviationByTriangle all{{}, std::vector<double>(triangles.size(), 0)};
  Deviation& result = all.whole;
  const double diagonal = bounding_diagonal(original);
  if (!can_be_measured(original) || !can_be_measured(changed)) {
    result.max = result.rms = result.max_to_original = result.max_to_new = INFINITY;
    std::fill(all.largest.begin(), all.largest.end(), INFINITY);
    return all;
  }
  if (triangles.empty() || !(diagonal > 0)) return all;
  const IndexedSurface then(original, triangles, topology);
  const IndexedSurface now(changed, triangles, topology);
  const auto [there, back] = measure_both_ways(now, then, threads);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    double& own = all.largest[t];
    own = std::max(own, there.by_triangle[t].distance / diagonal);
    const FarPoint& s = back.by_triangle[t];
    if (s.nearest != kNone) all.largest[s.nearest] = std::max(all.largest[s.nearest], s.distance / diagonal);
  }
  result.max_to_original = there.farthest.distance / diagonal;
  result.max_to_new = back.farthest.distance / diagonal;
  result.max = std::max(result.max_to_original, result.max_to_new);
  const double area = there.area + back.area;
  if (area > 0) result.rms = std::sqrt((there.squares + back.squares) / area) / diagonal;
  result.normal_change_deg = largest_normal_change(original, changed, triangles, threads);
  result.has_volume = encloses_volume(original, triangles, topology, threads);
  if (result.has_volume) {
    const double volume = enclosed_volume(original, triangles, threads);
    result.volume_change = (enclosed_volume(changed, triangles, threads) - volume) / volume;
  }
  return all;
}

}  // namespace isorelax
