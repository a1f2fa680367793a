#include "surface/deviation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mesh/degenerate.h"
#include "mesh/parallel.h"
#include "surface/closest_point.h"

namespace isorelax {
namespace {

constexpr std::size_t kRefinedTriangles = 64;
constexpr int kGridSteps = 8;   ///< intervals of a refinement grid along an edge
constexpr int kGridRounds = 4;  ///< each round's grid covers a quarter of the last one's

struct OneWay {
  double max = 0;
  double squares = 0;  ///< integral of the squared distance over the surface
  double area = 0;
};

Vec3 at(std::span<const Vec3> x, const Triangle& t, const Vec3& weights) {
  return weights[0] * x[t[0]] + weights[1] * x[t[1]] + weights[2] * x[t[2]];
}

/// Distances from samples of one surface to another of the same triangles: triangle t of the one is the hint
/// for the other.
class Sampler {
 public:
  Sampler(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const Triangle> triangles,
          const Topology& topology, unsigned threads)
      : x_(from), triangles_(triangles), topology_(topology), threads_(threads), index_(to, triangles) {}

  OneWay measure() {
    sample_vertices();
    sample_edges();
    OneWay result = sample_triangles();
    for (const double d : vertex_) result.max = std::max(result.max, d);
    result.max = std::max(result.max, refined());
    return result;
  }

 private:
  void sample_vertices() {
    vertex_.assign(x_.size(), 0);
    parallel_for_blocks(x_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto corners = topology_.corners_of(static_cast<Index>(v));
        if (!corners.empty()) vertex_[v] = index_.closest(x_[v], corners[0] / 3).distance;
      }
    });
  }

  /// The corner that measures the edge opposite to `corner`: the smaller of the two.
  [[nodiscard]] Corner owner(Corner corner) const { return std::min(corner, topology_.opposite(corner)); }

  void sample_edges() {
    edge_.assign(3 * triangles_.size(), 0);
    parallel_for_blocks(edge_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (Corner c = static_cast<Corner>(begin); c < end; ++c) {
        if (owner(c) != c) continue;
        const Triangle& t = triangles_[c / 3];
        const Vec3 middle = 0.5 * (x_[t[next(c % 3)]] + x_[t[previous(c % 3)]]);
        edge_[c] = index_.closest(middle, c / 3).distance;
      }
    });
  }

  OneWay sample_triangles() {
    worst_.assign(triangles_.size(), 0);
    std::vector<OneWay> parts(block_count(triangles_.size()));
    parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      OneWay& part = parts[begin / kBlockSize];
      for (std::size_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = triangles_[t];
        const double area = 0.5 * area_vector(x_[a], x_[b], x_[c]).norm();
        part.squares += area * mean_square(static_cast<Index>(t));
        part.area += area;
        part.max = std::max(part.max, worst_[t]);
      }
    });
    OneWay all;
    for (const OneWay& part : parts) {
      all.max = std::max(all.max, part.max);
      all.squares += part.squares;
      all.area += part.area;
    }
    return all;
  }

  double mean_square(Index t) {
    double corners = 0, middles = 0, inner = 0, worst = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const double corner = vertex_[triangles_[t][k]];
      const double middle = edge_[owner(3 * t + k)];
      Vec3 weights = Vec3::Constant(1.0 / 6);
      weights[k] = 2.0 / 3;
      const double inside = distance(t, weights);
      corners += corner * corner;
      middles += middle * middle;
      inner += inside * inside;
      worst = std::max({worst, corner, middle, inside});
    }
    const double centroid = distance(t, Vec3::Constant(1.0 / 3));
    worst_[t] = std::max(worst, centroid);
    return 0.5 * (corners / 20 + middles * 2 / 15 + centroid * centroid * 9 / 20) + 0.5 * inner / 3;
  }

  [[nodiscard]] double distance(Index t, const Vec3& weights) const {
    return index_.closest(at(x_, triangles_[t], weights), t).distance;
  }

  [[nodiscard]] double refined() const {
    std::vector<Index> order(triangles_.size());
    std::iota(order.begin(), order.end(), Index{0});
    const std::size_t count = std::min(kRefinedTriangles, order.size());
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](Index a, Index b) {
      return worst_[a] != worst_[b] ? worst_[a] > worst_[b] : a < b;
    });
    double max = 0;
    for (std::size_t i = 0; i < count; ++i) max = std::max(max, search_inside(order[i]));
    return max;
  }

  /// Largest distance on a triangle: a grid over all of it, then finer ones about the best point so far.
  [[nodiscard]] double search_inside(Index t) const {
    Vec3 centre = Vec3::Constant(1.0 / 3);
    double size = 1, best = 0;
    for (int round = 0; round < kGridRounds; ++round, size *= 0.25) {
      const Vec3 from = centre;
      for (int i = 0; i <= kGridSteps; ++i) {
        for (int j = 0; i + j <= kGridSteps; ++j) {
          const Vec3 grid(i, j, kGridSteps - i - j);
          const Vec3 weights = from + size * (grid / kGridSteps - Vec3::Constant(1.0 / 3));
          if (weights.minCoeff() < -1e-12) continue;
          const double d = distance(t, weights);
          if (d > best) best = d, centre = weights;
        }
      }
    }
    return best;
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  unsigned threads_;
  ClosestPointIndex index_;
  std::vector<double> vertex_, edge_, worst_;
};

bool is_closed(const Topology& topology) {
  for (Corner c = 0; c < 3 * topology.triangle_count(); ++c)
    if (topology.edge_triangle_count(c) != 2) return false;
  for (Index v = 0; v < topology.vertex_count(); ++v)
    if (topology.flags(v) & kInconsistentVertex) return false;
  return topology.triangle_count() > 0;
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
      most = std::max(most, std::atan2(m.cross(n).norm(), m.dot(n)));
    }
  });
  double all = 0;
  for (const double part : largest) all = std::max(all, part);
  return all * 180 / std::numbers::pi;
}

}  // namespace

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

Deviation measure_deviation(std::span<const Vec3> original, std::span<const Vec3> changed,
                            std::span<const Triangle> triangles, const Topology& topology, unsigned threads) {
  Deviation result;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : original) box.extend(x);
  if (original.empty() || triangles.empty() || !(box.diagonal().norm() > 0)) return result;
  const double diagonal = box.diagonal().norm();
  const OneWay there = Sampler(changed, original, triangles, topology, threads).measure();
  const OneWay back = Sampler(original, changed, triangles, topology, threads).measure();
  result.max_to_original = there.max / diagonal;
  result.max_to_new = back.max / diagonal;
  result.max = std::max(result.max_to_original, result.max_to_new);
  const double area = there.area + back.area;
  if (area > 0) result.rms = std::sqrt((there.squares + back.squares) / area) / diagonal;
  result.normal_change_deg = largest_normal_change(original, changed, triangles, threads);
  const double volume = enclosed_volume(original, triangles, threads);
  // A flat closed surface encloses rounding errors only.
  if (is_closed(topology) && std::abs(volume) > 1e-12 * diagonal * diagonal * diagonal) {
    result.has_volume = true;
    result.volume_change = (enclosed_volume(changed, triangles, threads) - volume) / std::abs(volume);
  }
  return result;
}

}  // namespace isorelax
