#include "smoothing/polish.h"

#include <algorithm>

#include "smoothing/objective.h"
#include "smoothing/polish_state.h"
#include "smoothing/renumbered_smoother.h"

namespace isorelax {
namespace {

class PolishSmoother : public Smoother {
 public:
  PolishSmoother(const SmoothingProblem& problem, const PolishOptions& options)
      : problem_(problem), state_(problem), objective_(problem) {
    if (options.goal != PolishGoal::mean) goals_.push_back({StepKind::raise_worst, raise_worst(options)});
    if (options.goal != PolishGoal::worst) goals_.push_back({StepKind::raise_mean, raise_mean(options)});
  }

  [[nodiscard]] bool descends() const override { return false; }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    prepare(positions, record);
    if (!objective_.is_at(positions)) objective_.evaluate(positions);
    record.before = objective_.totals();
    while (at_ < goals_.size() && !goals_[at_].sweeps->sweep(state_)) ++at_;
    record.kind = goals_[std::min(at_, goals_.size() - 1)].kind;
    const std::vector<Index> changed = state_.settle(positions, record);
    record.after = objective_.update(state_.positions(), changed);
    objective_.mark(state_.positions());
  }

 private:
  struct Goal {
    StepKind kind;
    std::unique_ptr<PolishGoalSweeps> sweeps;
  };

  void prepare(std::span<const Vec3> positions, StepRecord& record) {
    const std::size_t n = problem_.vertex_count();
    record.gradient.assign(n, Vec3::Zero());
    record.displacement.assign(n, Vec3::Zero());
    record.alpha.assign(n, 1);
    record.limits = problem_.fixed_limits;
    record.tangent_class = problem_.classes.classes;
    record.fold_passes = record.energy_passes = 0;
    // A run asks for the positions that the step before led to: all is known of them.
    if (!std::ranges::equal(positions, state_.positions())) state_.start(positions);
  }

  const SmoothingProblem& problem_;
  PolishState state_;
  Objective objective_;
  std::vector<Goal> goals_;
  std::size_t at_ = 0;  // the goal that is being followed
};

}  // namespace

std::unique_ptr<Smoother> make_polish(const SmoothingProblem& problem, const PolishOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<PolishSmoother>(numbered, options);
  });
}

}  // namespace isorelax
