#include "smoothing/trial.h"

#include <utility>

#include "mesh/parallel.h"
#include "smoothing/tangent.h"

namespace isorelax {

namespace {

Vec3 bring_to_surface(const SmoothingProblem& problem, Index vertex, const Vec3& target) {
  if (!problem.surface) return target;
  // The walk starts where the vertex was at the start of the run: the point does not depend on the way there.
  return problem.surface->project(target, class_on_surface(problem, vertex), problem.surface->anchor(vertex))
      .point;
}

/// The point of the ball nearest to `p`; of the ball of a share of its radius.
Vec3 into(const Ball& ball, double share, const Vec3& p) {
  const Vec3 out = p - ball.centre;
  const double radius = share * ball.radius;
  return out.squaredNorm() <= radius * radius ? p : Vec3(ball.centre + out * (radius / out.norm()));
}

bool is_outside(const Ball& ball, const Vec3& p) {
  return (p - ball.centre).squaredNorm() > ball.radius * ball.radius;
}

}  // namespace

Vec3 bring_back(const SmoothingProblem& problem, Index vertex, const Vec3& target) {
  const auto found = problem.balls.find(vertex);
  if (found == problem.balls.end()) return bring_to_surface(problem, vertex, target);
  // The centre is on the surface: what is brought back from half a radius comes no farther than a radius.
  for (const double share : {1.0, 0.75, 0.5}) {
    Vec3 there = bring_to_surface(problem, vertex, into(found->second, share, target));
    if (!is_outside(found->second, there)) return there;
  }
  return found->second.centre;
}

void Trial::start(std::span<const Vec3> from, StepRecord& record) {
  from_ = from;
  to_.resize(from.size());
  const std::vector<Index>& order = problem_.order.vertices;
  if (bends_) tangent_ = record.displacement;
  parallel_for_blocks(from.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) place(record, order.empty() ? static_cast<Index>(i) : order[i]);
  });
  take_touched();
}

/// Where the accepted share of the move leads, and the displacement that leads there.
void Trial::place(StepRecord& record, Index vertex) {
  const double alpha = record.alpha[vertex];
  if (bends_ && alpha > 0 && !tangent_[vertex].isZero(0)) {
    const Vec3 asked = from_[vertex] + alpha * tangent_[vertex];
    record.displacement[vertex] = (bring_back(problem_, vertex, asked) - from_[vertex]) / alpha;
    const auto ball = problem_.balls.find(vertex);
    if (ball != problem_.balls.end() && is_outside(ball->second, asked))
      record.limits[vertex] |= kLimitSurface;
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
