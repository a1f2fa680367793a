#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// What to do with triangles that lie upside down.
enum class UntangleRule : std::uint8_t {
  automatic,  ///< turn them over before smoothing starts
  off,        ///< leave them as they are; their vertices stay
};

/// What untangling did.
struct UntangleResult {
  std::size_t before = 0;    ///< triangles upside down at the start
  std::size_t after = 0;     ///< at the end; never more
  std::vector<Index> moved;  ///< vertices, ascending
};

/// Moves vertices with `movable[v] != 0` until no triangle is upside down, as few of them as that takes
/// (method Sec. 10). In the plane that means against the sign of the whole; on other surfaces against a field
/// of normals that what is sound around them tells, and vertices move in its tangent planes. Thrown vertices
/// are first put among their neighbours; what is still upside down is turned by minimising the energy with a
/// regularised determinant, whose regularisation is driven down as the worst determinant rises (Garanzha et
/// al., "Foldover-free maps in 50 lines of code", 2021, Eq. 6), over a region that grows as long as any is
/// left. Positions change only if fewer triangles are upside down for it. The result does not depend on
/// `threads`.
UntangleResult untangle(std::span<Vec3> positions, std::span<const Triangle> triangles,
                        const Topology& topology, std::span<const std::uint8_t> movable,
                        unsigned threads = 0);

}  // namespace isorelax
