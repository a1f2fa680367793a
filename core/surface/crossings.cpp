#include "surface/crossings.h"

#include <algorithm>
#include <numeric>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// On which side of a line or plane something is; 0 where rounding may have decided.
int sign(double value, double rounding) {
  return value > rounding ? 1 : (value < -rounding ? -1 : 0);
}

/// The plane of a triangle, seen from one of its corners.
struct Plane {
  Plane(const Vec3& a, const Vec3& b, const Vec3& c)
      : at(a), normal((b - a).cross(c - a)), size((b - a).lpNorm<1>() * (c - a).lpNorm<1>()) {}

  [[nodiscard]] int side_of(const Vec3& p) const {
    // Of a determinant of differences, in doubles; corners of the triangle itself are at 0.
    constexpr double kRounding = 2e-15;
    const Vec3 to = p - at;
    return sign(normal.dot(to), kRounding * size * to.lpNorm<1>());
  }

  Vec3 at, normal;
  double size;
};

using Corners = std::array<Vec3, 3>;

Corners corners_of(std::span<const Vec3> x, const Triangle& t) {
  return {x[t[0]], x[t[1]], x[t[2]]};
}

/// Whether the line from p to q, which passes through the triangle's plane, passes through its inside.
bool passes_inside(const Vec3& p, const Vec3& q, const Corners& t) {
  const auto round = [&](unsigned k) { return Plane(p, q, t[k]).side_of(t[(k + 1) % 3]); };
  const int first = round(0);
  return first != 0 && round(1) == first && round(2) == first;
}

/// Whether an edge of s passes through the inside of t, whose plane that is.
bool pierces(const Corners& s, const std::array<int, 3>& sides, const Corners& t) {
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned to = (k + 1) % 3;
    if (sides[k] * sides[to] < 0 && passes_inside(s[k], s[to], t)) return true;
  }
  return false;
}

std::array<int, 3> sides_of(const Corners& s, const Plane& plane) {
  return {plane.side_of(s[0]), plane.side_of(s[1]), plane.side_of(s[2])};
}

bool are_on_both(const std::array<int, 3>& sides) {
  const auto [low, high] = std::ranges::minmax(sides);
  return low * high < 0;
}

/// `plane` is that of s. Each of two triangles that cross is on both sides of the other; most that are beside
/// each other are not.
bool do_cross(const Corners& s, const Plane& plane, const Corners& t) {
  const std::array<int, 3> of_t = sides_of(t, plane);
  if (!are_on_both(of_t)) return false;
  const std::array<int, 3> of_s = sides_of(s, Plane(t[0], t[1], t[2]));
  return are_on_both(of_s) && (pierces(t, of_t, s) || pierces(s, of_s, t));
}

/// A triangle that may cross others.
class Crosser {
 public:
  Crosser(std::span<const Vec3> positions, std::span<const Triangle> triangles, Index triangle)
      : x_(positions),
        triangles_(triangles),
        corners_(corners_of(positions, triangles[triangle])),
        plane_(corners_[0], corners_[1], corners_[2]) {}

  [[nodiscard]] Eigen::AlignedBox3d box() const {
    return Eigen::AlignedBox3d(corners_[0]).extend(corners_[1]).extend(corners_[2]);
  }
  [[nodiscard]] bool meets(Index other) const {
    return do_cross(corners_, plane_, corners_of(x_, triangles_[other]));
  }

 private:
  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  Corners corners_;
  Plane plane_;
};

/// A line in the plane with a normal that may cross others.
class BorderCrosser {
 public:
  BorderCrosser(std::span<const Vec3> positions, std::span<const Triangle> edges, const Vec3& normal,
                Index edge)
      : x_(positions), edges_(edges), normal_(normal), own_(edges[edge]), plane_(through(own_)) {}

  [[nodiscard]] Eigen::AlignedBox3d box() const {
    return Eigen::AlignedBox3d(x_[own_[0]]).extend(x_[own_[1]]);
  }
  [[nodiscard]] bool meets(Index other) const {
    const auto are_apart = [&](const Plane& plane, const Triangle& ends) {
      return plane.side_of(x_[ends[0]]) * plane.side_of(x_[ends[1]]) < 0;
    };
    return are_apart(plane_, edges_[other]) && are_apart(through(edges_[other]), own_);
  }

 private:
  [[nodiscard]] Plane through(const Triangle& ends) const {
    const Vec3 &a = x_[ends[0]], &b = x_[ends[1]];
    return {a, b, a + (b - a).lpNorm<1>() * normal_};
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> edges_;
  Vec3 normal_;
  Triangle own_;
  Plane plane_;
};

/// Pairs of one of `some` and any of `count` in the index that meet, as make(one) tells, in ascending order.
template <typename Make>
std::vector<std::array<Index, 2>> find_pairs(const ClosestPointIndex& index, std::span<const Index> some,
                                             std::size_t count, unsigned threads, const Make& make) {
  std::vector<std::uint8_t> is_some(count, 0);
  for (const Index s : some) is_some[s] = 1;
  std::vector<std::vector<std::array<Index, 2>>> found(block_count(some.size()));
  parallel_for_blocks(some.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (const Index s : some.subspan(begin, end - begin)) {
      const auto crosser = make(s);
      index.for_each_in(crosser.box(), [&](Index t) {
        const bool is_turn = is_some[t] == 0 || t > s;  // of two of them the first looks
        if (is_turn && crosser.meets(t))
          found[begin / kBlockSize].push_back({std::min(s, t), std::max(s, t)});
      });
    }
  });
  std::vector<std::array<Index, 2>> all;
  for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<Index> up_to(std::size_t count) {
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace

bool do_cross(std::span<const Vec3> positions, const Triangle& s, const Triangle& t) {
  const Corners corners = corners_of(positions, s);
  return do_cross(corners, Plane(corners[0], corners[1], corners[2]), corners_of(positions, t));
}

std::vector<std::array<Index, 2>> crossing_pairs(const ClosestPointIndex& index,
                                                 std::span<const Vec3> positions,
                                                 std::span<const Triangle> triangles, unsigned threads) {
  return crossing_pairs_of(up_to(triangles.size()), index, positions, triangles, threads);
}

std::vector<std::array<Index, 2>> crossing_pairs_of(std::span<const Index> some,
                                                    const ClosestPointIndex& index,
                                                    std::span<const Vec3> positions,
                                                    std::span<const Triangle> triangles, unsigned threads) {
  return find_pairs(index, some, triangles.size(), threads,
                    [&](Index t) { return Crosser(positions, triangles, t); });
}

std::vector<std::array<Corner, 2>> crossing_borders(std::span<const Vec3> positions,
                                                    std::span<const Triangle> triangles,
                                                    const Topology& topology, const Vec3& normal,
                                                    unsigned threads) {
  std::vector<Corner> corners;
  std::vector<Triangle> edges;  // triangles without area
  for (Corner c = 0; c < 3 * triangles.size(); ++c) {
    if (!topology.is_boundary_edge(c)) continue;
    const Triangle& t = triangles[c / 3];
    corners.push_back(c);
    edges.push_back({t[next(c % 3)], t[previous(c % 3)], t[previous(c % 3)]});
  }
  auto pairs = find_pairs({positions, edges}, up_to(edges.size()), edges.size(), threads,
                          [&](Index e) { return BorderCrosser(positions, edges, normal, e); });
  for (auto& pair : pairs) pair = {corners[pair[0]], corners[pair[1]]};
  return pairs;
}

}  // namespace isorelax
