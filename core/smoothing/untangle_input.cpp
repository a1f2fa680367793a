#include <algorithm>

#include "mesh/disjoint_sets.h"
#include "mesh/error.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/orientation_field.h"
#include "smoothing/problem.h"
#include "smoothing/untangle_flat.h"
#include "surface/deviation.h"
#include "surface/surface_distance.h"

namespace isorelax {
namespace {

/// On a surface where fewer than one in so many triangles lie upside down they may be its own sharp folds:
/// turning those moves corners and leaves the surface, which costs more than it brings. Where a vertex only
/// lies on the wrong side of others, the surface hardly changes: by less than this share of the longest edge
/// there, and of the diagonal, beside which an edge may be very long.
constexpr std::size_t kOnePerTriangles = 200;
constexpr double kNearShare = 0.1;
constexpr double kShareOfDiagonal = 0.02;

/// What may move however upside down its triangles are: inside of a sound two-sided surface.
std::vector<std::uint8_t> inner_vertices(const Topology& topology) {
  std::vector<std::uint8_t> movable(topology.vertex_count(), 0);
  for (Index v = 0; v < topology.vertex_count(); ++v) movable[v] = topology.flags(v) == 0 ? 1 : 0;
  return movable;
}

/// A fold looks like a crease: only what no inverted triangle touches is known to be one.
void hold_features(std::vector<std::uint8_t>& movable, std::span<const Vec3> positions,
                   std::span<const Triangle> triangles, const Topology& topology,
                   const ProblemOptions& options, const std::vector<Index>& inverted) {
  std::vector<std::uint8_t> folded(positions.size(), 0);
  for (const Index t : doubtful_triangles(inverted, positions, triangles, topology))
    for (const Index v : triangles[t]) folded[v] = 1;
  const VertexClasses classes =
      classify_vertices(positions, triangles, topology, options.features, options.threads);
  for (Index v = 0; v < positions.size(); ++v) {
    if (folded[v] == 0 && classes.classes[v] != VertexClass::smooth) movable[v] = 0;
  }
}

/// Takes back groups of moves, of vertices that hang together, that led away from the surface or turned
/// nothing over.
void take_back_far(std::span<Vec3> x, std::span<const Vec3> input, std::span<const Triangle> triangles,
                   const Topology& topology, UntangleResult& result, unsigned threads) {
  struct Group {
    double distance = 0, longest_edge = 0;
    bool turns = false;
  };
  DisjointSets sets(topology.vertex_count());
  const auto is_moved = [&](Index v) { return x[v] != input[v]; };
  for (const Triangle& t : triangles)
    for (unsigned k = 0; k < 3; ++k)
      if (is_moved(t[k]) && is_moved(t[next(k)])) sets.join(t[k], t[next(k)]);
  std::vector<Group> groups(topology.vertex_count());
  const auto [there, back] =
      measure_both_ways({x, triangles, topology}, {input, triangles, topology}, threads);
  const auto area = [](std::span<const Vec3> at, const Triangle& t) {
    return area_vector(at[t[0]], at[t[1]], at[t[2]]);
  };
  for (Index t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    const bool is_turned = area(input, corners).dot(area(x, corners)) < 0;
    for (const Index v : corners) {
      if (!is_moved(v)) continue;
      Group& group = groups[sets.find(v)];
      group.distance =
          std::max({group.distance, there.by_triangle[t].distance, back.by_triangle[t].distance});
      for (unsigned k = 0; k < 3; ++k)
        group.longest_edge =
            std::max(group.longest_edge, (input[corners[next(k)]] - input[corners[k]]).norm());
      group.turns = group.turns || is_turned;
    }
  }
  const double largest = kShareOfDiagonal * bounding_diagonal(input);
  std::erase_if(result.moved, [&](Index v) {
    const Group& group = groups[sets.find(v)];
    const bool stays = group.turns && group.distance <= std::min(kNearShare * group.longest_edge, largest);
    if (!stays) x[v] = input[v];
    return !stays;
  });
  result.after = inverted_triangles(x, triangles, topology, threads).size();
  if (result.after < result.before) return;
  std::copy(input.begin(), input.end(), x.begin());
  result = {result.before, result.before, {}};
}

/// Flat faces first, each in its own plane: their rims are known then, and hold.
UntangleResult untangle_surface(std::span<Vec3> positions, std::span<const Triangle> triangles,
                                const Topology& topology, const ProblemOptions& options,
                                std::vector<std::uint8_t>& movable, const std::vector<Index>& inverted) {
  const std::vector<Vec3> input(positions.begin(), positions.end());
  const FlatUntangling flat = untangle_flat_faces(positions, triangles, topology, movable, options.threads);
  const std::vector<Vec3> start(positions.begin(), positions.end());
  const std::vector<Index> left =
      flat.moved ? inverted_triangles(positions, triangles, topology, options.threads) : inverted;
  for (Index v = 0; v < movable.size(); ++v)
    if (flat.touched[v] != 0) movable[v] = 0;
  hold_features(movable, positions, triangles, topology, options, left);
  UntangleResult result = untangle(positions, triangles, topology, movable, options.threads);
  const bool few = kOnePerTriangles * inverted.size() < triangles.size();
  if (few && !result.moved.empty())
    take_back_far(positions, start, triangles, topology, result, options.threads);
  // What only gets less tangled is not to get worse by it.
  const auto smallest_angle = [&](std::span<const Vec3> x) {
    return measure_quality(x, triangles, topology, options.threads).min_angle_deg;
  };
  if (result.after > 0 && smallest_angle(positions) < smallest_angle(start)) {
    std::copy(start.begin(), start.end(), positions.begin());
    result = {result.before, result.before, {}};
  }
  if (!flat.moved) return result;
  result.before = inverted.size();
  result.moved.clear();
  for (Index v = 0; v < positions.size(); ++v)
    if (positions[v] != input[v]) result.moved.push_back(v);
  return result;
}

}  // namespace

UntangleResult untangle_input(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options) {
  if (options.untangle == UntangleRule::off) return {};
  const Topology topology(triangles, static_cast<Index>(positions.size()));
  const auto inverted = inverted_triangles(positions, triangles, topology, options.threads);
  if (inverted.empty()) return {};
  std::vector<std::uint8_t> movable = inner_vertices(topology);
  for (const Index v : options.pinned) {
    if (v < movable.size()) movable[v] = 0;
  }
  if (plane_normal(positions, triangles, topology, options.threads))
    return untangle(positions, triangles, topology, movable, options.threads);
  return untangle_surface(positions, triangles, topology, options, movable, inverted);
}

}  // namespace isorelax
