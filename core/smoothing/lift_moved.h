#pragma once

#include <span>

#include "mesh/topology.h"

namespace isorelax {

/// Brings vertices that were moved among their neighbours back to the surface that those others, which
/// stayed, lie on: a local polynomial fit through the nearest of them (HeightFit), over the plane of the
/// vertex' own normal. A vertex goes at most half a mean edge. `moved[v] != 0` marks what was moved.
void lift_moved(std::span<Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
                std::span<const Vec3> vertex_normals, std::span<const std::uint8_t> moved);

}  // namespace isorelax
