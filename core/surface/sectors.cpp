#include "surface/sectors.h"

namespace isorelax {
namespace {

/// The corner of triangle `t` at `vertex`.
Corner corner_at(std::span<const Triangle> triangles, Index t, Index vertex) {
  for (unsigned k = 0; k < 3; ++k)
    if (triangles[t][k] == vertex) return 3 * t + k;
  return kNone;
}

}  // namespace

Sectors::Sectors(std::span<const Triangle> triangles, const Topology& topology, const EdgeWalls& walls) {
  sector_of_.assign(3 * triangles.size(), kNone);
  corners_.reserve(3 * triangles.size());
  offsets_.push_back(0);
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    for (const Corner seed : topology.corners_of(v)) {
      if (sector_of_[seed] != kNone) continue;
      const Index sector = count();
      bool closed = true;
      sector_of_[seed] = sector;
      corners_.push_back(seed);
      for (std::size_t i = offsets_.back(); i < corners_.size(); ++i) {
        const Corner c = corners_[i];
        for (const unsigned side : {next(c % 3), previous(c % 3)}) {
          const Corner edge = c - c % 3 + side;
          const Corner other = walls[edge] != 0 ? kNone : topology.opposite(edge);
          if (other == kNone) closed = false;
          const Corner neighbour = other == kNone ? kNone : corner_at(triangles, other / 3, v);
          if (neighbour == kNone || sector_of_[neighbour] != kNone) continue;
          sector_of_[neighbour] = sector;
          corners_.push_back(neighbour);
        }
      }
      vertices_.push_back(v);
      closed_.push_back(closed ? 1 : 0);
      offsets_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }
  }
}

}  // namespace isorelax
