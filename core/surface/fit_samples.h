#pragma once

#include <vector>

#include "surface/height_fit.h"
#include "surface/sectors.h"

namespace isorelax {

/// The sectors at the other ends of a sector's edges, each once.
class SectorNeighbours {
 public:
  explicit SectorNeighbours(const Sectors& sectors);

  [[nodiscard]] std::span<const Index> of(Index sector) const {
    return {neighbours_.data() + offsets_[sector], offsets_[sector + 1] - offsets_[sector]};
  }

 private:
  std::vector<std::uint32_t> offsets_;
  std::vector<Index> neighbours_;
};

/// Collects what a fit of one sector is made from, ring by ring, without crossing a wall. Keeps its memory
/// between calls: one for each thread.
class FitSampler {
 public:
  /// One sample for each sector.
  FitSampler(const SectorNeighbours& neighbours, std::span<const FitSample> samples)
      : neighbours_(neighbours), all_(samples), round_of_(samples.size(), 0) {}

  /// Vertices of at least two rings, and of whole rings more until there are `wanted` or none are left; at
  /// most HeightFit::kMaxSamples. Valid until the next call.
  std::span<const FitSample> collect(Index sector, std::size_t wanted);

 private:
  void add_neighbours(Index sector);

  const SectorNeighbours& neighbours_;
  std::span<const FitSample> all_;
  std::vector<std::uint32_t> round_of_;  // the last call that found this sector
  std::uint32_t round_ = 0;
  std::vector<Index> found_;
  std::vector<FitSample> samples_;
};

}  // namespace isorelax
