#include "surface/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "surface/overlay.h"
#include "surface/walk.h"

namespace isorelax {
namespace {

/// What can be farther than the largest distance by less than this share of it is not looked into.
constexpr double kTolerance = 1e-3;
/// Share of the largest coordinate that may be lost to rounding.
constexpr double kRounding = 1e-14;
/// Halvings of a triangle's parts, one in another, and samples for each triangle.
constexpr unsigned kHalvings = 40;
constexpr unsigned kSamples = 2000;

class Measurement {
 public:
  Measurement(const IndexedSurface& from, const IndexedSurface& to, unsigned threads)
      : from_(from), to_(to), x_(from.positions), triangles_(from.triangles), threads_(threads) {}

  OneWayDistance run() {
    sample_vertices();
    sample_edges();
    sample_triangles();
    note_largest();
    look_over_triangles();
    note_largest();
    search_triangles();
    note_largest();
    return std::move(result_);
  }

 private:
  /// A part of a triangle that is still to be looked into.
  struct Part {
    std::array<FarPoint, 3> corners;
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

  template <typename Work>
  void for_triangles(const Work& work) const {
    parallel_for_blocks(triangles_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) work(static_cast<Index>(t));
    });
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

  void sample_vertices() {
    vertex_.assign(x_.size(), {});
    parallel_for_blocks(x_.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto corners = from_.topology.corners_of(static_cast<Index>(v));
        if (!corners.empty()) vertex_[v] = sample(x_[v], corners[0] / 3);
      }
    });
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

  // The largest distance -----------------------------------------------------------------------------------

  /// What is to be looked for on a triangle is farther than that.
  [[nodiscard]] double known(Index t) const {
    const double largest = std::max(result_.farthest.distance, result_.by_triangle[t].distance);
    return std::max((1 + kTolerance) * largest, to_.rounding);
  }

  [[nodiscard]] Part whole(Index t) const {
    const auto& [a, b, c] = triangles_[t];
    return {{vertex_[a], vertex_[b], vertex_[c]}, 0};
  }

  [[nodiscard]] double distance(const FarPoint& from, Index triangle) const {
    if (from.nearest == triangle) return from.distance;
    return to_.index.closest_of(triangle, from.point).distance;
  }

  /// Whether a part is shown to be nearer than all that is known: to one triangle, or to those that it lies
  /// over. If not, notes a point of it.
  bool is_near(Index t, const Part& part) {
    const double enough = known(t);
    const auto& corners = part.corners;
    for (const FarPoint& one : corners) {
      const auto near_one = [&](const FarPoint& corner) { return distance(corner, one.nearest) <= enough; };
      if (std::ranges::all_of(corners, near_one)) return true;
    }
    const std::optional<Vec3> point =
        point_beyond(enough, {corners[0].point, corners[1].point, corners[2].point}, to_, corners[0].nearest);
    if (point) note(t, sample(*point, corners[0].nearest));
    return !point;
  }

  /// Marks those that may hold a point that is farther than any, and notes one of each.
  void look_over_triangles() {
    is_open_.assign(triangles_.size(), 0);
    if (to_.triangles.empty()) return;
    for_triangles([&](Index t) { is_open_[t] = is_near(t, whole(t)) ? 0 : 1; });
  }

  void search_triangles() {
    for_triangles([&](Index t) {
      if (is_open_[t] != 0) search(t);
    });
  }

  /// Halves parts of a triangle until none can be farther than what was found.
  void search(Index t) {
    std::vector<Part> parts = {whole(t)};
    for (unsigned samples = 0; !parts.empty() && samples < kSamples; ++samples) {
      Part part = parts.back();
      parts.pop_back();
      const double before = known(t);
      if (is_near(t, part) || part.halvings == kHalvings) continue;
      if (known(t) > before) {
        parts.push_back(part);
        continue;
      }
      const unsigned apex = opposite_to_longest_side(part);
      const Vec3 between = 0.5 * (part.corners[next(apex)].point + part.corners[previous(apex)].point);
      const FarPoint middle = sample(between, part.corners[apex].nearest);
      note(t, middle);
      ++part.halvings;
      for (const unsigned k : {next(apex), previous(apex)}) {
        parts.push_back(part);
        parts.back().corners[k] = middle;
      }
    }
  }

  [[nodiscard]] static unsigned opposite_to_longest_side(const Part& part) {
    const auto side = [&](unsigned k) {
      return (part.corners[next(k)].point - part.corners[previous(k)].point).squaredNorm();
    };
    const unsigned apex = side(1) > side(0) ? 1 : 0;
    return side(2) > side(apex) ? 2 : apex;
  }

  const IndexedSurface& from_;
  const IndexedSurface& to_;
  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  unsigned threads_;
  std::vector<FarPoint> vertex_, edge_;
  std::vector<std::uint8_t> is_open_;  // triangles that may hold the farthest point
  OneWayDistance result_;
};

}  // namespace

IndexedSurface::IndexedSurface(std::span<const Vec3> x, std::span<const Triangle> t, const Topology& around)
    : positions(x), triangles(t), topology(around), index(x, t) {
  for (const Vec3& p : x) rounding = std::max(rounding, kRounding * p.cwiseAbs().maxCoeff());
  normals.reserve(t.size());
  for (const auto& [a, b, c] : t) normals.push_back(area_vector(x[a], x[b], x[c]).stableNormalized());
}

std::array<OneWayDistance, 2> measure_both_ways(const IndexedSurface& a, const IndexedSurface& b,
                                                unsigned threads) {
  return {Measurement(a, b, threads).run(), Measurement(b, a, threads).run()};
}

}  // namespace isorelax
