#pragma once

#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// The flat faces of a mesh, as a number for each triangle: triangles that hang together over edges that turn
/// by no more than 0.02 degrees and are no creases, 12 of them or more; kNone for all others. `turns_deg`
/// are those of dihedral_turns_deg.
[[nodiscard]] std::vector<Index> flat_patches(const Topology& topology, std::span<const double> turns_deg,
                                              std::span<const FeatureEdge> creases);

/// For each triangle how many vertices its patch has inside, over those on its rim; 0 where it is in none.
/// What was only spanned between its corners has none inside.
[[nodiscard]] std::vector<double> inner_shares(const Topology& topology, std::span<const Index> patches);

}  // namespace isorelax
