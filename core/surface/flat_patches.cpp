#include "surface/flat_patches.h"

#include <numeric>

namespace isorelax {
namespace {

constexpr double kFlatDeg = 0.02;
/// Fewer may be a facet of a curved face, or the halves of a polygon in one.
constexpr Index kLeastTriangles = 12;

/// The root of a tree of triangles, whose paths it halves.
Index root_of(std::vector<Index>& parents, Index t) {
  while (parents[t] != t) t = parents[t] = parents[parents[t]];
  return t;
}

}  // namespace

std::vector<Index> flat_patches(const Topology& topology, std::span<const double> turns_deg,
                                std::span<const FeatureEdge> creases) {
  std::vector<std::uint8_t> is_wall(turns_deg.size(), 0);
  for (const FeatureEdge& e : creases) is_wall[e.corner] = is_wall[topology.opposite(e.corner)] = 1;
  std::vector<Index> parents(topology.triangle_count());
  std::iota(parents.begin(), parents.end(), Index{0});
  for (Corner c = 0; c < turns_deg.size(); ++c) {
    const Corner other = topology.opposite(c);
    if (other == kNone || other < c || is_wall[c] != 0 || turns_deg[c] > kFlatDeg) continue;
    parents[root_of(parents, c / 3)] = root_of(parents, other / 3);
  }
  std::vector<Index> sizes(parents.size(), 0);
  for (Index t = 0; t < parents.size(); ++t) ++sizes[root_of(parents, t)];
  std::vector<Index> patches(parents.size(), kNone);
  for (Index t = 0; t < parents.size(); ++t)
    if (const Index root = root_of(parents, t); sizes[root] >= kLeastTriangles) patches[t] = root;
  return patches;
}

}  // namespace isorelax
