#include "smoothing/trial.h"

#include <utility>

#include "mesh/parallel.h"

namespace isorelax {

void Trial::start(std::span<const Vec3> from, const StepRecord& record) {
  from_ = from;
  to_.resize(from.size());
  parallel_for_blocks(from.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) to_[v] = from[v] + record.alpha[v] * record.displacement[v];
  });
  take_touched();
}

bool Trial::cut(StepRecord& record, Index vertex, double factor, Limit why) {
  if (record.alpha[vertex] == 0 || record.displacement[vertex].isZero(0)) return false;
  record.alpha[vertex] *= factor;
  record.limits[vertex] |= why;
  to_[vertex] = from_[vertex] + record.alpha[vertex] * record.displacement[vertex];
  for (const Corner c : problem_.topology.corners_of(vertex)) {
    const Index t = c / 3;
    if (stamp_[t] == round_) continue;
    stamp_[t] = round_;
    touched_.push_back(t);
  }
  return true;
}

std::vector<Index> Trial::take_touched() {
  ++round_;
  return std::exchange(touched_, {});
}

}  // namespace isorelax
