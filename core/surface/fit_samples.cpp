#include "surface/fit_samples.h"

namespace isorelax {

/// A small open hash table of what was found; it never fills up, for found_ is limited.
bool FitSampler::insert(Index sector) {
  std::size_t at = (sector * 2654435769U) >> 24;
  while (table_[at] != kNone && table_[at] != sector) at = (at + 1) % table_.size();
  if (table_[at] == sector) return false;
  table_[at] = sector;
  found_.push_back(sector);
  return true;
}

std::span<const FitSample> FitSampler::collect(Index sector, std::size_t wanted) {
  found_.clear();
  samples_.clear();
  table_.fill(kNone);
  insert(sector);
  std::size_t begin = 0;
  for (int ring = 1; begin < found_.size() && (ring <= 2 || samples_.size() < wanted); ++ring) {
    const std::size_t end = found_.size();
    for (std::size_t i = begin; i < end; ++i) {
      for (const Corner c : sectors_.corners(found_[i])) {
        for (const unsigned side : {next(c % 3), previous(c % 3)}) {
          const Index other = sectors_.of(c - c % 3 + side);
          if (samples_.size() == HeightFit::kMaxSamples) return samples_;
          if (insert(other)) samples_.push_back({x_[sectors_.vertex(other)], normals_[other]});
        }
      }
    }
    begin = end;
  }
  return samples_;
}

}  // namespace isorelax
