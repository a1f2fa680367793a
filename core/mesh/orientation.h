#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// The parts of a mesh that hang together by edges, and how their triangles would have to be turned to agree.
///
/// An edge with two triangles asks them to agree; an edge with more joins components but asks for no
/// direction. A patch is what hangs together by edges with two triangles.
struct Orientation {
  /// Component of every triangle, numbered from 0 in the order of their first triangles.
  std::vector<Index> component;
  Index component_count = 0;
  /// Per triangle: whether it must be turned over for its patch to be consistent. Of the two ways the one
  /// that turns fewer of the patch's triangles; at a tie the first triangle stays.
  std::vector<bool> turn;
  /// Per component: whether such turning can succeed in all its patches (no Moebius strip).
  std::vector<bool> orientable;
};

[[nodiscard]] Orientation find_orientation(std::span<const Triangle> triangles, const Topology& topology);

/// Whether the two triangles at the edge opposite to `corner` run along it in opposite directions.
/// Precondition: topology.opposite(corner) != kNone.
[[nodiscard]] bool consistent_across(std::span<const Triangle> triangles, const Topology& topology,
                                     Corner corner);

/// The corners whose opposite edge has three or more triangles, edge by edge.
[[nodiscard]] std::vector<std::vector<Corner>> crowded_edges(std::span<const Triangle> triangles,
                                                             const Topology& topology);

}  // namespace isorelax
