#pragma once

#include <array>
#include <vector>

#include "surface/height_fit.h"
#include "surface/sectors.h"

namespace isorelax {

/// Collects what a fit of one sector is made from, ring by ring, without crossing a wall. Keeps its memory
/// between calls: one for each thread.
class FitSampler {
 public:
  FitSampler(std::span<const Vec3> positions, const Sectors& sectors, std::span<const Vec3> sector_normals)
      : x_(positions), sectors_(sectors), normals_(sector_normals) {}

  /// Vertices of at least two rings, and of whole rings more until there are `wanted` or none are left; at
  /// most HeightFit::kMaxSamples. Valid until the next call.
  std::span<const FitSample> collect(Index sector, std::size_t wanted);

 private:
  bool insert(Index sector);

  std::span<const Vec3> x_;
  const Sectors& sectors_;
  std::span<const Vec3> normals_;
  std::vector<Index> found_;
  std::vector<FitSample> samples_;
  std::array<Index, 256> table_{};
};

}  // namespace isorelax
