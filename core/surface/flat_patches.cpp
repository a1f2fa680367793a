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

}  // namespace isorelax
