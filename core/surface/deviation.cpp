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

/// A distance, and the triangle of the other surface that it leads to.
struct Sample {
  double distance = 0;
  Index nearest = kNone;
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
    refine();
    for (const Sample& s : worst_) result.max = std::max(result.max, s.distance);
    return result;
  }

  /// The farthest sample of each triangle.
  [[nodiscard]] std::span<const Sample> worst() const { return worst_; }

 private:
  void sample_vertices() {
    vertex_.assign(x_.size(), {});
    parallel_for_blocks(x_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto corners = topology_.corners_of(static_cast<Index>(v));
        if (!corners.empty()) vertex_[v] = sample(x_[v], corners[0] / 3);
      }
    });
  }

  /// The corner that measures the edge opposite to `corner`: the smaller of the two.
  [[nodiscard]] Corner owner(Corner corner) const { return std::min(corner, topology_.opposite(corner)); }

  void sample_edges() {
    edge_.assign(3 * triangles_.size(), {});
    parallel_for_blocks(edge_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (Corner c = static_cast<Corner>(begin); c < end; ++c) {
        if (owner(c) != c) continue;
        const Triangle& t = triangles_[c / 3];
        const Vec3 middle = 0.5 * (x_[t[next(c % 3)]] + x_[t[previous(c % 3)]]);
        edge_[c] = sample(middle, c / 3);
      }
    });
  }

  OneWay sample_triangles() {
    worst_.assign(triangles_.size(), {});
    std::vector<OneWay> parts(block_count(triangles_.size()));
    parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      OneWay& part = parts[begin / kBlockSize];
      for (std::size_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = triangles_[t];
        const double area = 0.5 * area_vector(x_[a], x_[b], x_[c]).norm();
        part.squares += area * mean_square(static_cast<Index>(t));
        part.area += area;
      }
    });
    OneWay all;
    for (const OneWay& part : parts) {
      all.squares += part.squares;
      all.area += part.area;
    }
    return all;
  }

  double mean_square(Index t) {
    double corners = 0, middles = 0, inner = 0;
    const auto squared = [&](const Sample& s) {
      if (s.distance > worst_[t].distance) worst_[t] = s;
      return s.distance * s.distance;
    };
    for (unsigned k = 0; k < 3; ++k) {
      Vec3 weights = Vec3::Constant(1.0 / 6);
      weights[k] = 2.0 / 3;
      corners += squared(vertex_[triangles_[t][k]]);
      middles += squared(edge_[owner(3 * t + k)]);
      inner += squared(sample(t, weights));
    }
    const double centroid = squared(sample(t, Vec3::Constant(1.0 / 3)));
    return 0.5 * (corners / 20 + middles * 2 / 15 + centroid * 9 / 20) + 0.5 * inner / 3;
  }

  [[nodiscard]] Sample sample(const Vec3& point, Index hint) const {
    const SurfacePoint found = index_.closest(point, hint);
    return {found.distance, found.triangle};
  }
  [[nodiscard]] Sample sample(Index t, const Vec3& weights) const {
    return sample(at(x_, triangles_[t], weights), t);
  }

  void refine() {
    std::vector<Index> order(triangles_.size());
    std::iota(order.begin(), order.end(), Index{0});
    const std::size_t count = std::min(kRefinedTriangles, order.size());
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](Index a, Index b) {
      const double x = worst_[a].distance, y = worst_[b].distance;
      return x != y ? x > y : a < b;
    });
    for (std::size_t i = 0; i < count; ++i) search_inside(order[i]);
  }

  /// Largest distance on a triangle: a grid over all of it, then finer ones about the best point so far.
  void search_inside(Index t) {
    Vec3 centre = Vec3::Constant(1.0 / 3);
    double size = 1, best = 0;
    for (int round = 0; round < kGridRounds; ++round, size *= 0.25) {
      const Vec3 from = centre;
      for (int i = 0; i <= kGridSteps; ++i) {
        for (int j = 0; i + j <= kGridSteps; ++j) {
          const Vec3 grid(i, j, kGridSteps - i - j);
          const Vec3 weights = from + size * (grid / kGridSteps - Vec3::Constant(1.0 / 3));
          if (weights.minCoeff() < -1e-12) continue;
          const Sample found = sample(t, weights);
          if (found.distance > worst_[t].distance) worst_[t] = found;
          if (found.distance > best) best = found.distance, centre = weights;
        }
      }
    }
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  unsigned threads_;
  ClosestPointIndex index_;
  std::vector<Sample> vertex_, edge_, worst_;
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
  return measure_deviation_by_triangle(original, changed, triangles, topology, threads).whole;
}

DeviationByTriangle measure_deviation_by_triangle(std::span<const Vec3> original,
                                                  std::span<const Vec3> changed,
                                                  std::span<const Triangle> triangles,
                                                  const Topology& topology, unsigned threads) {
  DeviationByTriangle all{{}, std::vector<double>(triangles.size(), 0)};
  Deviation& result = all.whole;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : original) box.extend(x);
  if (original.empty() || triangles.empty() || !(box.diagonal().norm() > 0)) return all;
  const double diagonal = box.diagonal().norm();
  Sampler from_changed(changed, original, triangles, topology, threads);
  Sampler from_original(original, changed, triangles, topology, threads);
  const OneWay there = from_changed.measure();
  const OneWay back = from_original.measure();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    double& own = all.largest[t];
    own = std::max(own, from_changed.worst()[t].distance / diagonal);
    const Sample& s = from_original.worst()[t];
    if (s.nearest != kNone) all.largest[s.nearest] = std::max(all.largest[s.nearest], s.distance / diagonal);
  }
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
  return all;
}

}  // namespace isorelax
