#include "surface/fit_samples.h"

#include <algorithm>

namespace isorelax {

SectorNeighbours::SectorNeighbours(const Sectors& sectors) {
  offsets_.reserve(sectors.count() + 1);
  offsets_.push_back(0);
  for (Index s = 0; s < sectors.count(); ++s) {
    for (const Corner c : sectors.corners(s)) {
      for (const unsigned side : {next(c % 3), previous(c % 3)}) {
        const Index other = sectors.of(c - c % 3 + side);
        if (std::find(neighbours_.begin() + offsets_.back(), neighbours_.end(), other) == neighbours_.end())
          neighbours_.push_back(other);
      }
    }
    offsets_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

std::span<const FitSample> FitSampler::collect(Index sector, std::size_t wanted) {
  ++round_;
  round_of_[sector] = round_;
  found_.assign(1, sector);
  std::size_t begin = 0;
  for (int ring = 1; begin < found_.size() && (ring <= 2 || found_.size() <= wanted); ++ring) {
    const std::size_t end = found_.size();
    for (std::size_t i = begin; i < end; ++i) add_neighbours(found_[i]);
    begin = end;
  }
  samples_.clear();
  for (std::size_t i = 1; i < std::min<std::size_t>(found_.size(), 1 + HeightFit::kMaxSamples); ++i)
    samples_.push_back(all_[found_[i]]);
  return samples_;
}

/// Without a branch on what is new, which no processor foresees.
void FitSampler::add_neighbours(Index sector) {
  const std::span<const Index> neighbours = neighbours_.of(sector);
  std::size_t size = found_.size();
  found_.resize(size + neighbours.size());
  for (const Index other : neighbours) {
    found_[size] = other;
    size += round_of_[other] == round_ ? 0 : 1;
    round_of_[other] = round_;
  }
  found_.resize(size);
}

}  // namespace isorelax
