#include "surface/flat_patches.h"

#include "mesh/disjoint_sets.h"

namespace isorelax {
namespace {

constexpr double kFlatDeg = 0.02;
/// Fewer may be a facet of a curved face, or the halves of a polygon in one.
constexpr Index kLeastTriangles = 12;

}  // namespace

std::vector<Index> flat_patches(const Topology& topology, std::span<const double> turns_deg,
                                std::span<const FeatureEdge> creases) {
  std::vector<std::uint8_t> is_wall(turns_deg.size(), 0);
  for (const FeatureEdge& e : creases) is_wall[e.corner] = is_wall[topology.opposite(e.corner)] = 1;
  DisjointSets sets(topology.triangle_count());
  for (Corner c = 0; c < turns_deg.size(); ++c) {
    const Corner other = topology.opposite(c);
    if (other == kNone || other < c || is_wall[c] != 0 || turns_deg[c] > kFlatDeg) continue;
    sets.join(c / 3, other / 3);
  }
  std::vector<Index> sizes(topology.triangle_count(), 0);
  for (Index t = 0; t < sizes.size(); ++t) ++sizes[sets.find(t)];
  std::vector<Index> patches(sizes.size(), kNone);
  for (Index t = 0; t < sizes.size(); ++t)
    if (const Index set = sets.find(t); sizes[set] >= kLeastTriangles) patches[t] = set;
  return patches;
}

std::vector<double> inner_shares(const Topology& topology, std::span<const Index> patches) {
  std::vector<Index> inside(patches.size(), 0), on_rim(patches.size(), 0);
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    const auto corners = topology.corners_of(v);
    const auto patch = [&](std::size_t i) { return patches[corners[i] / 3]; };
    bool one = !topology.is_boundary(v);
    for (std::size_t i = 0; i < corners.size(); ++i) one = one && patch(i) == patch(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      bool first = patch(i) != kNone;
      for (std::size_t k = 0; k < i; ++k) first = first && patch(k) != patch(i);
      if (first) ++(one ? inside : on_rim)[patch(i)];
    }
  }
  std::vector<double> shares(patches.size(), 0);
  for (Index t = 0; t < patches.size(); ++t)
    if (patches[t] != kNone) shares[t] = inside[patches[t]] / static_cast<double>(on_rim[patches[t]]);
  return shares;
}

}  // namespace isorelax
