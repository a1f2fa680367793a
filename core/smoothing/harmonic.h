#pragma once

#include <span>

#include "mesh/topology.h"

namespace isorelax {

/// Puts every vertex of `free` into the mean of its neighbours, all at once (Tutte's embedding; neighbours
/// that an inner edge leads to count twice), while the others stay. Inside a convex outline in the plane
/// nothing is left upside down. Returns false, with nothing moved, where some free vertices have no way to a
/// fixed one.
bool place_harmonically(std::span<Vec3> positions, std::span<const Triangle> triangles,
                        const Topology& topology, std::span<const Index> free);

}  // namespace isorelax
