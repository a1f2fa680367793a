#include "surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/degenerate.h"

namespace isorelax {
namespace {

constexpr std::size_t kLeafSize = 2;
constexpr double kInfinitelyFar = std::numeric_limits<double>::infinity();

/// The best point so far, as weights of the corners.
struct Candidate {
  Vec3 weights = Vec3::Zero();
  Vec3 point = Vec3::Zero();
  double squared = kInfinitelyFar;

  /// Takes the closest point of the edge from corner i (at x) to corner j (at y) where that is nearer.
  void try_edge(const Vec3& p, const Vec3& x, const Vec3& y, unsigned i, unsigned j) {
    const Vec3 along = y - x;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp(along.dot(p - x) / length2, 0.0, 1.0) : 0.0;
    const Vec3 q = t == 1 ? y : Vec3(x + t * along);  // the end itself, to the last bit
    const double d2 = (p - q).squaredNorm();
    if (!(d2 < squared)) return;
    squared = d2;
    point = q;
    weights.setZero();
    weights[i] = 1 - t;
    weights[j] = t;
  }
};

/// A coordinate from which on a point may be the corner itself.
constexpr double kAtCorner = 1 - 1e-6;

/// Barycentric coordinates of the foot of p decide: a point outside of one edge only has its closest point on
/// that edge, outside of two on one of the two.
inline Candidate closest(const Vec3& p, const PreparedTriangle& t) {
  Candidate best;
  const Vec3 foot = t.barycentric(p);
  const double u = foot[0], v = foot[1], w = foot[2];
  if (t.has_area && u >= 0 && v >= 0 && w >= 0) {
    best.weights = foot;
    best.point = t.a + v * (t.b - t.a) + w * (t.c - t.a);
    best.squared = (p - best.point).squaredNorm();
    // A vertex is at distance zero, not at rounding error.
    if (v > kAtCorner && p == t.b) return {{0, 1, 0}, p, 0};
    if (w > kAtCorner && p == t.c) return {{0, 0, 1}, p, 0};
    return best;
  }
  if (!t.has_area || u < 0) best.try_edge(p, t.b, t.c, 1, 2);
  if (!t.has_area || v < 0) best.try_edge(p, t.c, t.a, 2, 0);
  if (!t.has_area || w < 0) best.try_edge(p, t.a, t.b, 0, 1);
  return best;
}

}  // namespace

PreparedTriangle::PreparedTriangle(const Vec3& at_a, const Vec3& at_b, const Vec3& at_c)
    : a(at_a), b(at_b), c(at_c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  // The rule of has_no_area, squared; where that underflows, the edges are all there is, too.
  has_area = n2 > 4 * kDegenerateArea * kDegenerateArea * longest2 * longest2;
  gradient_b = ac.cross(n) / n2;
  gradient_c = n.cross(ab) / n2;
}

SurfacePoint closest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Candidate best = closest(p, PreparedTriangle(a, b, c));
  return {kNone, best.weights, best.point, std::sqrt(best.squared)};
}

SurfacePoint closest_point_of_triangle(const Vec3& p, std::span<const Vec3> positions,
                                       std::span<const Triangle> triangles, Index triangle) {
  const auto& [a, b, c] = triangles[triangle];
  const Candidate best = closest(p, PreparedTriangle(positions[a], positions[b], positions[c]));
  return {triangle, best.weights, best.point, std::sqrt(best.squared)};
}

// Build ---------------------------------------------------------------------------------------------------

class ClosestPointIndex::Builder {
 public:
  Builder(ClosestPointIndex& index, std::span<const Vec3> positions, std::span<const Triangle> triangles)
      : index_(index), x_(positions), triangles_(triangles) {
    Eigen::AlignedBox3d all;
    for (const Triangle& t : triangles)
      for (const Index v : t) all.extend(x_[v]);
    // A closest point is rounded like the coordinates it comes from: boxes leave that much room.
    slack_ = 1e-15 * std::max(all.min().cwiseAbs().maxCoeff(), all.max().cwiseAbs().maxCoeff());
    const double size = all.sizes().maxCoeff();
    const double scale = size > 0 ? 1 / size : 0;
    centres_.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const Vec3 centre = ((x_[a] - all.min()) + (x_[b] - all.min()) + (x_[c] - all.min())) * scale;
      for (int k = 0; k < 3; ++k) centres_[t].at[k] = static_cast<float>(centre[k]);
      centres_[t].triangle = static_cast<Index>(t);
    }
  }

  void run() {
    index_.records_.reserve(triangles_.size());
    index_.record_of_.resize(triangles_.size());
    index_.nodes_.reserve(triangles_.size() / 2);
    if (triangles_.size() > kLeafSize) {
      split(0, centres_.size(), 0);
    } else {
      leaf(0, centres_.size(), 0);
    }
  }

 private:
  Eigen::AlignedBox3d leaf(std::size_t begin, std::size_t end, std::uint32_t parent) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = begin; i < end; ++i) {
      const Index t = centres_[i].triangle;
      const auto& [a, b, c] = triangles_[t];
      index_.record_of_[t] = static_cast<std::uint32_t>(index_.records_.size());
      index_.records_.push_back({PreparedTriangle(x_[a], x_[b], x_[c]), t, parent});
      box.extend(x_[a]).extend(x_[b]).extend(x_[c]);
    }
    box.min().array() -= slack_;
    box.max().array() += slack_;
    return box;
  }

  /// Makes the node of centres [begin, end), all below it, and returns its box.
  Eigen::AlignedBox3d split(std::size_t begin, std::size_t end, std::uint32_t parent) {
    const auto node = static_cast<std::uint32_t>(index_.nodes_.size());
    index_.nodes_.emplace_back();
    index_.nodes_[node].parent = parent;
    const std::size_t middle = (begin + end) / 2;
    const unsigned axis = widest_axis(begin, end);
    const auto first = centres_.begin();
    std::nth_element(first + begin, first + middle, first + end, [axis](const Centre& p, const Centre& q) {
      return p.at[axis] != q.at[axis] ? p.at[axis] < q.at[axis] : p.triangle < q.triangle;
    });
    Eigen::AlignedBox3d whole;
    const std::array<std::size_t, 3> cuts = {begin, middle, end};
    for (unsigned side = 0; side < 2; ++side) {
      const std::size_t count = cuts[side + 1] - cuts[side];
      const bool is_leaf = count <= kLeafSize;
      const std::size_t child = is_leaf ? index_.records_.size() : index_.nodes_.size();
      const Eigen::AlignedBox3d box =
          is_leaf ? leaf(cuts[side], cuts[side + 1], node) : split(cuts[side], cuts[side + 1], node);
      Node& n = index_.nodes_[node];
      n.child[side] = static_cast<std::uint32_t>(child);
      n.count[side] = is_leaf ? static_cast<std::uint32_t>(count) : 0;
      n.low.col(side) = box.min();
      n.high.col(side) = box.max();
      whole.extend(box);
    }
    return whole;
  }

  [[nodiscard]] unsigned widest_axis(std::size_t begin, std::size_t end) const {
    std::array<float, 3> low = centres_[begin].at, high = low;
    for (std::size_t i = begin; i < end; ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], centres_[i].at[k]);
        high[k] = std::max(high[k], centres_[i].at[k]);
      }
    }
    unsigned widest = 0;
    for (unsigned k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[widest] - low[widest]) widest = k;
    return widest;
  }

  ClosestPointIndex& index_;
  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  std::vector<Centre> centres_;
  double slack_ = 0;
};

ClosestPointIndex::ClosestPointIndex(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  if (!triangles.empty()) Builder(*this, positions, triangles).run();
}

// Search --------------------------------------------------------------------------------------------------

/// The smallest (distance, triangle) of what was looked at so far.
struct ClosestPointIndex::Search {
  /// A child whose box is so far away.
  struct Waiting {
    double squared;
    std::uint32_t child, count;
  };

  const ClosestPointIndex& index;
  Vec3 p;
  Candidate best;
  Index triangle = kNone;
  double bound =
      kInfinitelyFar;  ///< boxes farther than this hold nothing as near; a little over best.squared

  void look_at(const Record& r) {
    const Candidate found = isorelax::closest(p, r.corners);
    if (found.squared < best.squared || (found.squared == best.squared && r.triangle < triangle)) {
      best = found;
      triangle = r.triangle;
      // Rounding of a squared distance must not let the order of the visits decide.
      bound = found.squared * (1 + 1e-14);
    }
  }

  [[nodiscard]] Eigen::Array2d squared_distances(const Node& n) const {
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Array2d low = n.low.row(k).transpose(), high = n.high.row(k).transpose();
      const Eigen::Array2d outside = (low - p[k]).max(p[k] - high).max(0.0);
      sum += outside * outside;
    }
    return sum;
  }

  /// Looks at all that may be nearer in one child.
  void descend(const Waiting& from) {
    std::array<Waiting, kMaxDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = from;
    while (depth > 0) {
      const Waiting at = stack[--depth];
      if (at.squared > bound) continue;
      if (at.count > 0) {
        for (std::uint32_t i = at.child; i < at.child + at.count; ++i) look_at(index.records_[i]);
        continue;
      }
      const Node& node = index.nodes_[at.child];
      const Eigen::Array2d d = squared_distances(node);
      const unsigned nearer = d[1] < d[0] ? 1 : 0;
      for (const unsigned side : {1 - nearer, nearer})
        if (d[side] <= bound) stack[depth++] = {d[side], node.child[side], node.count[side]};
    }
  }

  /// The same for everything, from a triangle known to be near outwards.
  void climb_from(const Record& near) {
    look_at(near);
    descend({0, near.node, 0});
    for (std::uint32_t at = near.node; at != 0; at = index.nodes_[at].parent) {
      const Node& parent = index.nodes_[index.nodes_[at].parent];
      const unsigned other = parent.count[0] == 0 && parent.child[0] == at ? 1 : 0;
      const double squared = squared_distances(parent)[other];
      if (squared <= bound) descend({squared, parent.child[other], parent.count[other]});
    }
  }
};

SurfacePoint ClosestPointIndex::closest_of(Index triangle, const Vec3& point) const {
  const Candidate best = isorelax::closest(point, records_[record_of_[triangle]].corners);
  return {triangle, best.weights, best.point, std::sqrt(best.squared)};
}

SurfacePoint ClosestPointIndex::closest(const Vec3& point, Index hint) const {
  Search search{*this, point, {}, kNone, kInfinitelyFar};
  if (nodes_.empty()) {
    for (const Record& r : records_) search.look_at(r);
  } else if (hint < record_of_.size()) {
    search.climb_from(records_[record_of_[hint]]);
  } else {
    search.descend({0, 0, 0});
  }
  if (!(search.best.squared < kInfinitelyFar)) return {kNone, Vec3::Zero(), Vec3::Zero(), kInfinitelyFar};
  return {search.triangle, search.best.weights, search.best.point, std::sqrt(search.best.squared)};
}

}  // namespace isorelax
