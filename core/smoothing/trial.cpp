#include "smoothing/trial.h"

#include <utility>

#include "mesh/parallel.h"
#include "smoothing/tangent.h"

namespace isorelax {

Vec3 bring_back(const SmoothingProblem& problem, Index vertex, const Vec3& target) {
  if (!problem.surface) return target;
  // The walk starts where the vertex was at the start of the run: the point does not depend on the way there.
  return problem.surface->project(target, class_on_surface(problem, vertex), problem.surface->anchor(vertex))
      .point;
}

void Trial::start(std::span<const Vec3> from, StepRecord& record) {
  from_ = from;
  to_.resize(from.size());
  const std::vector<Index>& order = problem_.order.vertices;
  if (problem_.surface) tangent_ = record.displacement;
  parallel_for_blocks(from.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) place(record, order.empty() ? static_cast<Index>(i) : order[i]);
  });
  take_touched();
}

/// Where the accepted share of the move leads, and the displacement that leads there.
void Trial::place(StepRecord& record, Index vertex) {
  const double alpha = record.alpha[vertex];
  if (problem_.surface && alpha > 0 && !tangent_[vertex].isZero(0)) {
    const Vec3 target = bring_back(problem_, vertex, from_[vertex] + alpha * tangent_[vertex]);
    record.displacement[vertex] = (target - from_[vertex]) / alpha;
  }
  to_[vertex] = from_[vertex] + alpha * record.displacement[vertex];
}

bool Trial::cut(StepRecord& record, Index vertex, double factor, Limit why) {
  if (record.alpha[vertex] == 0 || record.displacement[vertex].isZero(0)) return false;
  record.alpha[vertex] *= factor;
  record.limits[vertex] |= why;
  place(record, vertex);
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
