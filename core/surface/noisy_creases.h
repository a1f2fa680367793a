#pragma once

#include <span>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// Takes out creases that are what noise makes of slivers, which a little of it turns by much: those that
/// hang together over a short way only, lie along slivers for the most part, and have surroundings that, by
/// area, face one way. A loop of some length stays: somebody drew it.
void take_out_noise(std::vector<FeatureEdge>& creases, std::span<const Vec3> positions,
                    std::span<const Triangle> triangles, const Topology& topology);

}  // namespace isorelax
