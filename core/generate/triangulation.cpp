#include "generate/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "generate/random.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

using Points = std::span<const GridPoint>;

/// Plane: the triangulation is closed over the hull's edges by triangles with one corner at infinity, so that
/// a point outside is inserted like one inside.
class PlaneRule {
 public:
  explicit PlaneRule(Points points) : points_(points), infinity_(static_cast<Index>(points.size())) {}

  [[nodiscard]] Index vertex_count() const { return infinity_ + 1; }

  [[nodiscard]] std::vector<Triangle> start(std::vector<Index>& order) const {
    bring_forward(order, 1, [&](Index p) { return differs(order[0], p); });
    bring_forward(order, 2, [&](Index p) {
      return orient_plane(points_[order[0]], points_[order[1]], points_[p]) != 0;
    });
    const Index a = order[0];
    Index b = order[1];
    Index c = order[2];
    if (orient_plane(points_[a], points_[b], points_[c]) < 0) std::swap(b, c);
    return {{a, b, c}, {b, a, infinity_}, {c, b, infinity_}, {a, c, infinity_}};
  }
  [[nodiscard]] static std::size_t start_size() { return 3; }

  /// Whether point p makes triangle t disappear.
  [[nodiscard]] bool conflicts(const Triangle& t, Index p) const {
    const GridPoint& d = points_[p];
    for (unsigned k = 0; k < 3; ++k) {
      if (t[k] != infinity_) continue;
      const GridPoint& a = points_[t[next(k)]];
      const GridPoint& b = points_[t[previous(k)]];
      const int side = orient_plane(a, b, d);
      if (side != 0) return side > 0;
      return (d.x - a.x) * (d.x - b.x) + (d.y - a.y) * (d.y - b.y) < 0;
    }
    return in_circle(points_[t[0]], points_[t[1]], points_[t[2]], d) > 0;
  }

  /// Whether p lies beyond the edge (a, b) of a triangle: which way to walk.
  [[nodiscard]] bool beyond(Index a, Index b, Index p) const {
    return a != infinity_ && b != infinity_ && orient_plane(points_[a], points_[b], points_[p]) < 0;
  }

  [[nodiscard]] bool is_real(const Triangle& t) const {
    return std::find(t.begin(), t.end(), infinity_) == t.end();
  }

 private:
  [[nodiscard]] bool differs(Index a, Index b) const {
    return points_[a].x != points_[b].x || points_[a].y != points_[b].y;
  }
  template <class Test>
  static void bring_forward(std::vector<Index>& order, std::size_t place, const Test& test) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(std::min(place, order.size()));
    const auto found = std::find_if(from, order.end(), test);
    if (found == order.end()) throw UsageError("the points of a triangulation all lie on a line");
    std::iter_swap(from, found);
  }

  Points points_;
  Index infinity_;
};

/// Space: the hull of points that are all corners of it.
class HullRule {
 public:
  explicit HullRule(Points points) : points_(points) {}

  [[nodiscard]] Index vertex_count() const { return static_cast<Index>(points_.size()); }

  [[nodiscard]] std::vector<Triangle> start(std::vector<Index>& order) const {
    for (std::size_t i = 3; i < order.size(); ++i) {
      const int side =
          orient_space(points_[order[0]], points_[order[1]], points_[order[2]], points_[order[i]]);
      if (side == 0) continue;
      std::swap(order[3], order[i]);
      const Index a = order[0];
      Index b = order[1];
      Index c = order[2];
      const Index d = order[3];
      if (side > 0) std::swap(b, c);
      return {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
    }
    throw UsageError("the points of a hull do not span space");
  }
  [[nodiscard]] static std::size_t start_size() { return 4; }

  [[nodiscard]] bool conflicts(const Triangle& t, Index p) const {
    return orient_space(points_[t[0]], points_[t[1]], points_[t[2]], points_[p]) > 0;
  }

  /// Walks by the cones that triangles make with the origin; where the origin is outside the hull the walk
  /// may miss and the search falls back on trying every triangle.
  [[nodiscard]] bool beyond(Index a, Index b, Index p) const {
    return orient_space(GridPoint{}, points_[a], points_[b], points_[p]) < 0;
  }

  [[nodiscard]] static bool is_real(const Triangle& /*t*/) { return true; }

 private:
  Points points_;
};

/// A closed triangulated surface that grows point by point: the triangles in conflict with a new point are
/// taken out and the hole is closed with a fan around it.
template <class Rule>
class Builder {
 public:
  explicit Builder(Rule rule) : rule_(rule), fan_(rule.vertex_count(), kNone) {}

  std::vector<Triangle> run(std::vector<Index> order) {
    begin(rule_.start(order));
    for (std::size_t i = Rule::start_size(); i < order.size(); ++i) insert(order[i]);
    std::vector<Triangle> real;
    std::copy_if(triangles_.begin(), triangles_.end(), std::back_inserter(real),
                 [&](const Triangle& t) { return rule_.is_real(t); });
    return real;
  }

 private:
  struct Rim {
    Index from, to;
    Index outside;  // the triangle that stays, across this edge
  };

  /// Links the first four triangles, of which any two share an edge.
  void begin(const std::vector<Triangle>& first) {
    triangles_ = first;
    neighbours_.assign(first.size(), {});
    mark_.assign(first.size(), 0);
    for (std::size_t t = 0; t < first.size(); ++t) {
      for (unsigned k = 0; k < 3; ++k) {
        for (std::size_t other = 0; other < first.size(); ++other) {
          const bool holds_corner =
              std::find(first[other].begin(), first[other].end(), first[t][k]) != first[other].end();
          if (other != t && !holds_corner) neighbours_[t][k] = static_cast<Index>(other);
        }
      }
    }
  }

  void insert(Index p) {
    const Index seed = find_conflict(p);
    ++round_;
    hole_.assign(1, seed);
    mark_[seed] = round_;
    rim_.clear();
    for (std::size_t i = 0; i < hole_.size(); ++i) {
      const Index t = hole_[i];
      for (unsigned k = 0; k < 3; ++k) {
        const Index n = neighbours_[t][k];
        if (mark_[n] == round_) continue;
        if (rule_.conflicts(triangles_[n], p)) {
          mark_[n] = round_;
          hole_.push_back(n);
        } else {
          rim_.push_back({triangles_[t][next(k)], triangles_[t][previous(k)], n});
        }
      }
    }
    close_hole(p);
  }

  /// One new triangle (from, to, p) per edge of the rim, in the places of the old ones and two more.
  void close_hole(Index p) {
    while (hole_.size() < rim_.size()) {
      hole_.push_back(static_cast<Index>(triangles_.size()));
      triangles_.push_back({});
      neighbours_.push_back({});
      mark_.push_back(0);
    }
    for (std::size_t i = 0; i < rim_.size(); ++i) {
      const Rim& edge = rim_[i];
      const Index t = hole_[i];
      triangles_[t] = {edge.from, edge.to, p};
      neighbours_[t][2] = edge.outside;
      const Triangle& outside = triangles_[edge.outside];
      for (unsigned k = 0; k < 3; ++k) {
        if (outside[k] != edge.from && outside[k] != edge.to) neighbours_[edge.outside][k] = t;
      }
      fan_[edge.from] = t;
    }
    for (std::size_t i = 0; i < rim_.size(); ++i) {
      const Index t = hole_[i];
      const Index following = fan_[rim_[i].to];
      neighbours_[t][0] = following;
      neighbours_[following][1] = t;
    }
    last_ = hole_[0];
  }

  Index find_conflict(Index p) {
    Index t = last_;
    const std::size_t limit = 100 + 4 * static_cast<std::size_t>(std::sqrt(triangles_.size()));
    for (std::size_t step = 0; step < limit; ++step) {
      const std::optional<unsigned> exit = way_out(t, p, static_cast<unsigned>(step % 3));
      if (!exit) break;
      t = neighbours_[t][*exit];
    }
    if (rule_.conflicts(triangles_[t], p)) return t;
    for (Index other = 0; other < triangles_.size(); ++other) {
      if (rule_.conflicts(triangles_[other], p)) return other;
    }
    throw UsageError("two points of a triangulation coincide, or one is no corner of the hull");
  }

  /// The edge of t beyond which p lies, if any; `first` varies where the search begins, so no walk circles.
  std::optional<unsigned> way_out(Index t, Index p, unsigned first) const {
    const Triangle& v = triangles_[t];
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned k = (first + i) % 3;
      if (rule_.beyond(v[next(k)], v[previous(k)], p)) return k;
    }
    return std::nullopt;
  }

  Rule rule_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<Index, 3>> neighbours_;
  std::vector<std::uint32_t> mark_;
  std::vector<Index> fan_;
  std::vector<Index> hole_;
  std::vector<Rim> rim_;
  std::uint32_t round_ = 0;
  Index last_ = 0;
};

/// A few points at random, so that what follows finds a surface of the right shape, then the others in
/// rounds of growing size, each sorted along a space-filling curve: neighbours in time are neighbours in
/// space.
std::vector<Index> insertion_order(Points points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  Random random(1);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);

  std::int64_t low = std::numeric_limits<std::int64_t>::max();
  std::int64_t high = std::numeric_limits<std::int64_t>::min();
  for (const GridPoint& p : points) {
    low = std::min({low, p.x, p.y, p.z});
    high = std::max({high, p.x, p.y, p.z});
  }
  int shift = 0;
  while (((high - low) >> shift) > 0xfffff) ++shift;
  const auto key = [&](Index i) {
    // Morton order: the bits of the three coordinates interleaved.
    const std::int64_t c[3] = {points[i].x - low, points[i].y - low, points[i].z - low};
    std::uint64_t code = 0;
    for (int bit = 19; bit >= 0; --bit) {
      for (const std::int64_t x : c) code = code << 1 | (static_cast<std::uint64_t>(x >> shift) >> bit & 1);
    }
    return code;
  };
  constexpr std::size_t kFirstRound = 64;
  std::vector<std::pair<std::uint64_t, Index>> round;
  for (std::size_t begin = kFirstRound; begin < order.size(); begin *= 4) {
    const std::size_t end = std::min(order.size(), 4 * begin);
    round.clear();
    for (std::size_t i = begin; i < end; ++i) round.emplace_back(key(order[i]), order[i]);
    std::sort(round.begin(), round.end());
    for (std::size_t i = begin; i < end; ++i) order[i] = round[i - begin].second;
  }
  return order;
}

}  // namespace

std::vector<Triangle> delaunay_triangles(Points points) {
  if (points.size() < 3) throw UsageError("a triangulation needs at least three points");
  return Builder(PlaneRule(points)).run(insertion_order(points));
}

std::vector<Triangle> hull_triangles(Points points) {
  if (points.size() < 4) throw UsageError("a hull needs at least four points");
  auto triangles = Builder(HullRule(points)).run(insertion_order(points));
  // A later point may have swallowed an earlier one.
  if (triangles.size() != 2 * points.size() - 4) throw UsageError("a point of a hull is no corner of it");
  return triangles;
}

}  // namespace isorelax
