#pragma once

#include <array>
#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Dihedral turn in degrees, 0..180, across the edge opposite to `corner`; 0 where there are not exactly two
/// triangles or one of them has no area.
[[nodiscard]] double dihedral_turn_deg(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                       const Topology& topology, Corner corner);

/// Whether an edge that turns by `turn_deg` between vertices of these spreads (VertexClasses::spread_deg) is
/// a crease. A sliver's normal points anywhere, but its area carries no weight in the covariance: an edge is
/// a crease only where the covariance of both ends agrees at least half-way.
[[nodiscard]] bool is_crease(const FeatureOptions& options, double turn_deg,
                             std::array<double, 2> spread_deg);

}  // namespace isorelax
