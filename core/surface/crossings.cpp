#include "surface/crossings.h"

#include <algorithm>
#include <cmath>

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
    constexpr double kRounding = 1e-15;
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

/// Pairs of an index for which make_test(one)(other) holds, in ascending order.
template <typename MakeTest>
std::vector<std::array<Index, 2>> find_pairs(const ClosestPointIndex& index, std::size_t count,
                                             unsigned threads, const MakeTest& make_test) {
  std::vector<std::vector<std::array<Index, 2>>> found(block_count(count));
  parallel_for_blocks(count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto s = static_cast<Index>(i);
      const auto test = make_test(s);
      index.for_each_beside(s, [&](Index t) {
        if (test(t)) found[begin / kBlockSize].push_back({std::min(s, t), std::max(s, t)});
      });
    }
  });
  std::vector<std::array<Index, 2>> all;
  for (const auto& pairs : found) all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end());
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
  return find_pairs(index, triangles.size(), threads, [&](Index s) {
    const Corners own = corners_of(positions, triangles[s]);
    return [own, plane = Plane(own[0], own[1], own[2]), positions, triangles](Index t) {
      return do_cross(own, plane, corners_of(positions, triangles[t]));
    };
  });
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
  auto pairs = find_pairs({positions, edges}, edges.size(), threads, [&](Index s) {
    const Vec3 &a = positions[edges[s][0]], &b = positions[edges[s][1]];
    return [&, plane = Plane(a, b, a + (b - a).lpNorm<1>() * normal)](Index t) {
      const Vec3 &p = positions[edges[t][0]], &q = positions[edges[t][1]];
      const Plane other(p, q, p + (q - p).lpNorm<1>() * normal);
      return plane.side_of(p) * plane.side_of(q) < 0 && other.side_of(a) * other.side_of(b) < 0;
    };
  });
  for (auto& pair : pairs) pair = {corners[pair[0]], corners[pair[1]]};
  return pairs;
}

}  // namespace isorelax
