#pragma once

#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Turns of all edges in degrees, by corner: those of both corners opposite to an edge are the same (see
/// dihedral_turn_deg).
[[nodiscard]] std::vector<double> dihedral_turns_deg(std::span<const Vec3> positions,
                                                     std::span<const Triangle> triangles,
                                                     const Topology& topology, unsigned threads = 0);

/// The creases among the edges of a mesh, in the order of their corners: what is_crease says, without what is
/// roughness rather than a line that somebody would draw. Left out are edges that turn by less than
/// `over_roughness` times the mean of the edges at their ends that are no creases; those up to
/// `sharp_edge_deg` where creases go every which way; lines of fewer edges than `least_crease_edges` that end
/// in the middle of a face, unless they turn by more than `sharp_edge_deg` on the average; lines of fewer
/// than twice as many that do so at both ends; and loops of fewer edges that others meet in one vertex at
/// most; and what is noise (take_out_noise). Added are edges that turn by at least half of `ridge_angle_deg`
/// where they lead on from the end of one line to another: a crease that somebody drew may be gentle on its
/// way.
///
/// `turns_deg` are those of dihedral_turns_deg, `spread_deg` and `angle_defect_deg` those of VertexClasses.
[[nodiscard]] std::vector<FeatureEdge> find_creases(std::span<const Vec3> positions,
                                                    std::span<const Triangle> triangles,
                                                    const Topology& topology, const FeatureOptions& options,
                                                    std::span<const double> turns_deg,
                                                    std::span<const double> spread_deg,
                                                    std::span<const double> angle_defect_deg);

}  // namespace isorelax
