#include "surface/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/parallel.h"
#include "surface/line_bound.h"
#include "surface/walk.h"

namespace isorelax {
namespace {

/// What can be farther than the largest distance by less than this share of it is not looked into.
constexpr double kTolerance = 1e-3;
/// An edge is divided that often at most, one part in another, and not too near to an end.
constexpr unsigned kDivisions = 12;
constexpr double kLeastPart = 0.05;
/// Triangles that are searched all over first, halvings of their parts, one in another, and samples for each.
constexpr std::size_t kSearched = 64;
constexpr unsigned kHalvings = 40;
constexpr unsigned kSamples = 2000;

class Measurement {
 public:
  Measurement(const IndexedSurface& from, const IndexedSurface& to, unsigned threads)
      : from_(from), to_(to), x_(from.positions), triangles_(from.triangles), threads_(threads) {}

  void sample_vertices() {
    vertex_.assign(x_.size(), {});
    parallel_for_blocks(x_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto corners = from_.topology.corners_of(static_cast<Index>(v));
        if (!corners.empty()) vertex_[v] = sample(x_[v], corners[0] / 3);
      }
    });
  }

  /// Once the vertices of both surfaces are sampled.
  OneWayDistance run(const Measurement& other_way) {
    sample_edges();
    sample_triangles();
    note_largest();
    sample_under(other_way.vertex_);
    divide_edges();
    search_farthest();
    note_largest();
    search_others();
    note_largest();
    return std::move(result_);
  }

 private:
  /// A part of a triangle that is still to be looked into.
  struct Part {
    std::array<FarPoint, 3> corners;
    double bound;  ///< on the distance from any of its points
    unsigned halvings;
  };

  /// A walk from the hint, where the other surface has that triangle, mostly ends at the closest point: that
  /// leaves little to search.
  [[nodiscard]] FarPoint sample(const Vec3& point, Index hint) const {
    if (hint < to_.triangles.size()) hint = walk(point, hint);
    const SurfacePoint found = to_.index.closest(point, hint);
    return {found.distance, point, found.triangle};
  }

  [[nodiscard]] Index walk(const Vec3& point, Index from) const {
    const auto foot = [&](Index t) { return to_.index.closest_of(t, point); };
    return walk_over_mesh(foot(from), foot, to_.triangles, to_.topology).triangle;
  }

  void note(Index t, const FarPoint& point) {
    if (point.distance > result_.by_triangle[t].distance) result_.by_triangle[t] = point;
  }
  void note_largest() {
    for (const FarPoint& p : result_.by_triangle)
      if (p.distance > result_.farthest.distance) result_.farthest = p;
  }

  // Samples ------------------------------------------------------------------------------------------------

  /// The corner that stands for the edge opposite to `corner`: the smaller of the two.
  [[nodiscard]] Corner owner(Corner corner) const {
    return std::min(corner, from_.topology.opposite(corner));
  }

  /// Calls work(corner, first end, second end) for every edge, and notes what it leaves in edge_.
  template <typename Work>
  void for_edges(const Work& work) {
    parallel_for_blocks(edge_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (Corner c = static_cast<Corner>(begin); c < end; ++c) {
        const Triangle& t = triangles_[c / 3];
        if (owner(c) == c) work(c, t[next(c % 3)], t[previous(c % 3)]);
      }
    });
    for (Corner c = 0; c < edge_.size(); ++c) note(c / 3, edge_[owner(c)]);
  }

  void sample_edges() {
    edge_.assign(3 * triangles_.size(), {});
    result_.by_triangle.assign(triangles_.size(), {});
    for_edges([&](Corner c, Index a, Index b) { edge_[c] = sample(0.5 * (x_[a] + x_[b]), c / 3); });
  }

  void sample_triangles() {
    struct Sums {
      double squares = 0, area = 0;
    };
    std::vector<Sums> parts(block_count(triangles_.size()));
    parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      Sums& part = parts[begin / kBlockSize];
      for (std::size_t t = begin; t < end; ++t) {
        const auto& [a, b, c] = triangles_[t];
        const double area = 0.5 * area_vector(x_[a], x_[b], x_[c]).norm();
        part.squares += area * mean_square(static_cast<Index>(t));
        part.area += area;
      }
    });
    for (const Sums& part : parts) {
      result_.squares += part.squares;
      result_.area += part.area;
    }
  }

  double mean_square(Index t) {
    const auto& [a, b, c] = triangles_[t];
    const Vec3 centre = (x_[a] + x_[b] + x_[c]) / 3;
    double corners = 0, middles = 0, inner = 0;
    const auto squared = [&](const FarPoint& point) {
      note(t, point);
      return point.distance * point.distance;
    };
    for (unsigned k = 0; k < 3; ++k) {
      const Index v = triangles_[t][k];
      corners += squared(vertex_[v]);
      middles += squared(edge_[owner(3 * t + k)]);
      inner += squared(sample(0.5 * (centre + x_[v]), t));
    }
    const double centroid = squared(sample(centre, t));
    return 0.5 * (corners / 20 + middles * 2 / 15 + centroid * 9 / 20) + 0.5 * inner / 3;
  }

  /// What is closest to a vertex of the other surface is no farther from that surface than from the vertex.
  void sample_under(std::span<const FarPoint> vertices) {
    for (const FarPoint& vertex : vertices) {
      if (vertex.nearest == kNone || vertex.distance <= more_than(result_.farthest.distance)) continue;
      const SurfacePoint under = from_.index.closest_of(vertex.nearest, vertex.point);
      note(vertex.nearest, sample(under.point, vertex.nearest));
    }
  }

  // The largest distance -----------------------------------------------------------------------------------

  [[nodiscard]] double distance(const FarPoint& from, Index triangle) const {
    if (from.nearest == triangle) return from.distance;
    return to_.index.closest_of(triangle, from.point).distance;
  }
  [[nodiscard]] static double more_than(double largest) { return (1 + kTolerance) * largest; }

  void divide_edges() {
    for_edges([&](Corner c, Index a, Index b) {
      const FarPoint middle = edge_[c];
      divide(vertex_[a], middle, kDivisions, edge_[c]);
      divide(middle, vertex_[b], kDivisions, edge_[c]);
    });
  }

  /// Looks between two points of an edge for what is farther than all before.
  void divide(const FarPoint& a, const FarPoint& b, unsigned divisions, FarPoint& peak) const {
    const LineBound most =
        bound_between(a.distance, distance(b, a.nearest), distance(a, b.nearest), b.distance);
    if (divisions == 0 || most.distance <= more_than(std::max(result_.farthest.distance, peak.distance)))
      return;
    const double share = std::clamp(most.share, kLeastPart, 1 - kLeastPart);
    const FarPoint between = sample((1 - share) * a.point + share * b.point, a.nearest);
    if (between.distance > peak.distance) peak = between;
    divide(a, between, divisions - 1, peak);
    divide(between, b, divisions - 1, peak);
  }

  /// The triangles that are farthest as far as is known: each for the point of it that is.
  void search_farthest() {
    std::vector<Index> order(triangles_.size());
    std::iota(order.begin(), order.end(), Index{0});
    const std::size_t count = std::min(kSearched, order.size());
    std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](Index a, Index b) {
      const double x = result_.by_triangle[a].distance, y = result_.by_triangle[b].distance;
      return x != y ? x > y : a < b;
    });
    searched_.assign(triangles_.size(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      search(order[i], 0);
      searched_[order[i]] = 1;
    }
  }

  /// All others that may hold a point that is farther than any.
  void search_others() {
    parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        if (searched_[t] == 0) search(static_cast<Index>(t), result_.farthest.distance);
    });
  }

  /// Halves parts of a triangle until none can be farther than what was found on it, or than `known`.
  void search(Index t, double known) {
    const auto& [a, b, c] = triangles_[t];
    const std::array<FarPoint, 3> corners{vertex_[a], vertex_[b], vertex_[c]};
    const auto known_here = [&] { return more_than(std::max(known, result_.by_triangle[t].distance)); };
    std::vector<Part> parts = {{corners, bound_of(corners, known_here()), 0}};
    for (unsigned samples = 0; !parts.empty() && samples < kSamples;) {
      const Part part = parts.back();
      parts.pop_back();
      if (part.bound <= known_here() || part.halvings == kHalvings) continue;
      const unsigned apex = opposite_to_longest_side(part);
      const Vec3 between = 0.5 * (part.corners[next(apex)].point + part.corners[previous(apex)].point);
      const FarPoint middle = sample(between, part.corners[apex].nearest);
      ++samples;
      note(t, middle);
      for (const unsigned k : {next(apex), previous(apex)}) {
        Part half = part;
        half.corners[k] = middle;
        half.bound = std::min(part.bound, bound_of(half.corners, known_here()));
        ++half.halvings;
        parts.push_back(half);
      }
      if (const std::size_t n = parts.size(); parts[n - 1].bound < parts[n - 2].bound)
        std::swap(parts[n - 1], parts[n - 2]);
    }
  }

  [[nodiscard]] static unsigned opposite_to_longest_side(const Part& part) {
    const auto side = [&](unsigned k) {
      return (part.corners[next(k)].point - part.corners[previous(k)].point).squaredNorm();
    };
    const unsigned apex = side(1) > side(0) ? 1 : 0;
    return side(2) > side(apex) ? 2 : apex;
  }

  /// The distance to any one triangle is largest at a corner of a part. Where that does not show that all of
  /// it is near enough, a part that lies over two neighbours is cut between them.
  [[nodiscard]] double bound_of(const std::array<FarPoint, 3>& corners, double enough) const {
    double least = INFINITY;
    for (const FarPoint& one : corners) {
      double largest = 0;
      for (const FarPoint& corner : corners) largest = std::max(largest, distance(corner, one.nearest));
      least = std::min(least, largest);
    }
    for (unsigned k = 0; k < 3 && least > enough; ++k)
      least = std::min(least, bound_over_both(corners, corners[k].nearest, corners[next(k)].nearest));
    return least;
  }

  /// A bound from two triangles of the other surface with an edge in common: that to the one on its side of
  /// the plane that stands on that edge, that to the other on the other. Infinite for any other two.
  [[nodiscard]] double bound_over_both(const std::array<FarPoint, 3>& corners, Index one, Index other) const {
    unsigned side = 0;
    while (side < 3 && to_.topology.opposite(3 * one + side) / 3 != other) ++side;
    if (one == other || side == 3) return INFINITY;
    const std::span<const Vec3> x = to_.positions;
    const auto normal = [&](Index t) -> Vec3 {
      const auto& [a, b, c] = to_.triangles[t];
      return area_vector(x[a], x[b], x[c]).stableNormalized();
    };
    const Vec3& first = x[to_.triangles[one][next(side)]];
    const Vec3 edge = x[to_.triangles[one][previous(side)]] - first;
    const Vec3 across = edge.cross(normal(one) + normal(other));
    std::array<double, 3> beyond;
    for (unsigned k = 0; k < 3; ++k) beyond[k] = across.dot(corners[k].point - first);
    double largest = 0;
    const auto look = [&](const Vec3& point, Index t) {
      largest = std::max(largest, to_.index.closest_of(t, point).distance);
    };
    for (unsigned k = 0; k < 3; ++k) {
      look(corners[k].point, beyond[k] > 0 ? other : one);
      const double here = beyond[k], there = beyond[next(k)];
      if ((here > 0) == (there > 0)) continue;
      const Vec3 between =
          corners[k].point + here / (here - there) * (corners[next(k)].point - corners[k].point);
      look(between, one);
      look(between, other);
    }
    return largest;
  }

  const IndexedSurface& from_;
  const IndexedSurface& to_;
  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  unsigned threads_;
  std::vector<FarPoint> vertex_, edge_;
  std::vector<std::uint8_t> searched_;  // triangles, all over
  OneWayDistance result_;
};

}  // namespace

std::array<OneWayDistance, 2> measure_both_ways(const IndexedSurface& a, const IndexedSurface& b,
                                                unsigned threads) {
  Measurement there(a, b, threads), back(b, a, threads);
  there.sample_vertices();
  back.sample_vertices();
  return {there.run(back), back.run(there)};
}

}  // namespace isorelax
