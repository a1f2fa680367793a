#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// Walls between triangles: one flag for each corner, for the edge opposite to it. Every edge with no single
/// other triangle is a wall too, set or not.
using EdgeWalls = std::vector<std::uint8_t>;

/// The triangles about a vertex, cut into parts by walls: a vertex inside a smooth face has one sector, on a
/// crease two, a corner of a cube three. What lies in other sectors of a vertex is another face's business.
class Sectors {
 public:
  Sectors() = default;
  Sectors(std::span<const Triangle> triangles, const Topology& topology, const EdgeWalls& walls);

  [[nodiscard]] Index count() const { return static_cast<Index>(vertices_.size()); }
  [[nodiscard]] Index of(Corner corner) const { return sector_of_[corner]; }
  [[nodiscard]] Index vertex(Index sector) const { return vertices_[sector]; }
  /// The corners of a sector, all at its vertex.
  [[nodiscard]] std::span<const Corner> corners(Index sector) const {
    return {corners_.data() + offsets_[sector], offsets_[sector + 1] - offsets_[sector]};
  }
  /// Whether the sector goes all the way round: no wall ends at its vertex inside of it.
  [[nodiscard]] bool is_closed(Index sector) const { return closed_[sector] != 0; }

 private:
  std::vector<Index> sector_of_;
  std::vector<Index> vertices_;
  std::vector<std::uint32_t> offsets_;
  std::vector<Corner> corners_;
  std::vector<std::uint8_t> closed_;
};

}  // namespace isorelax
