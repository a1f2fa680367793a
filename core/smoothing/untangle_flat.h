#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// What untangling the flat faces of a surface did.
struct FlatUntangling {
  std::vector<std::uint8_t> touched;  ///< per vertex: in a flat face that was tangled, on its rim as well
  bool moved = false;
};

/// Untangles the flat faces of a surface that is not flat itself, each in its own plane: triangles that hang
/// together and lie in one plane, whichever side they show, 12 of them or more. Only vertices inside of a
/// face with `movable[v] != 0` move; its outline and what is beyond stay.
FlatUntangling untangle_flat_faces(std::span<Vec3> positions, std::span<const Triangle> triangles,
                                   const Topology& topology, std::span<const std::uint8_t> movable,
                                   unsigned threads = 0);

}  // namespace isorelax
