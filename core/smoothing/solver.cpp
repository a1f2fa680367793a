#include <algorithm>
#include <utility>

#include "smoothing/even_out.h"
#include "smoothing/one_by_one.h"
#include "smoothing/renumbered_smoother.h"
#include "smoothing/slide_first.h"

namespace isorelax {
namespace {

/// Evening out is cheap and soon done: what gains less than the first share of the energy is the last such
/// step. So is what gains more than the second: that it leaves nothing to the next one was found on 19 of 20
/// scans.
constexpr double kEvenGain = 0.05;
constexpr double kEvenedOut = 0.25;
/// Newton steps open the worst places fast, each vertex at its own pace; once none is left that bad (E over
/// the sum of the weights), a step gains less than this share of the energy, L-BFGS converges faster. While
/// one is left, less will do.
constexpr double kBadEnergy = 7;
constexpr double kWorthwhileGain = 0.01;
constexpr double kLeastGain = 0.002;

/// Where the limit of the distance holds vertices back and steps of L-BFGS gain less than this share, once it
/// has had so many, they move one by one. So they do at once where it finds no step, or gains no more than
/// the second share and the worst angles may be what holds them. They go on while that gains the third share;
/// where L-BFGS finds no step even so, to the end.
constexpr double kHeldUpGain = 1e-4;
constexpr unsigned kStepsForAll = 16;
constexpr double kNoGain = 1e-6;
constexpr double kOneByOneGain = 1e-3;
/// Newton steps alone gain less and less for long: by this share of the energy what is held has jammed them.
constexpr double kJammedNewton = 2e-3;

bool is_limited(const StepRecord& record, std::uint16_t by) {
  return std::ranges::any_of(record.limits, [=](auto limits) { return (limits & by) != 0; });
}

/// The share of the energy that a step gained.
double gain_of(const StepRecord& record) {
  return (record.before.movable_energy - record.after.movable_energy) / record.before.movable_energy;
}

class AutomaticSmoother : public Smoother {
 public:
  AutomaticSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : problem_(problem), detail_(detail) {}

  // What evening out leaves, others have not seen yet.
  [[nodiscard]] bool leads_on() const override { return evened_; }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    // Elsewhere than the last step led, everything starts anew.
    if (!std::ranges::equal(positions, led_to_)) begin();
    if (phase_ == Phase::even) even_out_->step(positions, record);
    if (phase_ == Phase::even && record.moved == 0) phase_ = Phase::newton;
    if (phase_ == Phase::newton) {
      if (!newton_) newton_ = make_newton(problem_, {.detail = detail_});
      newton_->step(positions, record);
    }
    if (phase_ == Phase::lbfgs) lbfgs().step(positions, record);
    // What leads all of them nowhere may still leave one after another a way.
    if (phase_ != Phase::one_by_one && record.moved == 0) {
      all_are_stuck_ = phase_ == Phase::lbfgs && steps_for_all_ == 0;
      phase_ = Phase::one_by_one;
    }
    if (phase_ == Phase::one_by_one) {
      if (!one_by_one_) one_by_one_ = make_one_by_one(problem_, detail_);
      one_by_one_->step(positions, record);
      if (record.moved == 0 && !all_are_stuck_) {
        phase_ = Phase::lbfgs;
        pays_alone_ = false;
        lbfgs().step(positions, record);
      }
    }
    led_to_.assign(positions.begin(), positions.end());
    apply_step(record, led_to_);
    evened_ = phase_ == Phase::even;
    choose_next(record);
  }

 private:
  enum class Phase : std::uint8_t { even, newton, lbfgs, one_by_one };

  Smoother& lbfgs() {
    if (!lbfgs_) lbfgs_ = make_lbfgs(problem_, {.detail = detail_});
    return *lbfgs_;
  }

  void begin() {
    phase_ = wants_even(problem_) ? Phase::even : Phase::newton;
    if (phase_ == Phase::even) even_out_ = make_even_out(problem_, detail_);
    steps_for_all_ = 0;
    all_are_stuck_ = false;
    pays_alone_ = true;
  }

  void choose_next(const StepRecord& record) {
    const double gain = gain_of(record);
    if (phase_ == Phase::even) {
      if (gain < kEvenGain || gain > kEvenedOut) phase_ = Phase::newton;
    } else if (phase_ == Phase::newton) {
      const bool bad =
          record.after.worst_movable_energy > kBadEnergy * (problem_.weights.shape + problem_.weights.area);
      if (gain < (bad ? kLeastGain : kWorthwhileGain)) phase_ = Phase::lbfgs;
    } else if (phase_ == Phase::one_by_one) {
      if (gain < kOneByOneGain && !all_are_stuck_) phase_ = Phase::lbfgs;
      pays_alone_ = gain >= kHeldUpGain;
      steps_for_all_ = 0;
    } else {
      const bool held_up = ++steps_for_all_ >= kStepsForAll && gain < kHeldUpGain;
      const bool jammed = pays_alone_ && gain < kNoGain;
      if ((held_up && is_limited(record, kLimitSurface)) ||
          (jammed && is_limited(record, kLimitSurface | kLimitFold)))
        phase_ = Phase::one_by_one;
    }
    if (phase_ != Phase::even) even_out_.reset();
  }

  const SmoothingProblem& problem_;
  RecordDetail detail_;
  std::unique_ptr<Smoother> even_out_, newton_, lbfgs_, one_by_one_;
  std::vector<Vec3> led_to_;
  Phase phase_ = Phase::even;
  bool evened_ = false;  // the last step did
  unsigned steps_for_all_ = 0;
  bool all_are_stuck_ = false;  // L-BFGS found no step from where others had led
  bool pays_alone_ = true;      // the last steps of one vertex after another, if any, gained something
};

/// Steps of one kind; where they find none, or gain nothing and something is held, vertices find theirs one
/// by one, and it starts anew from there.
class PersistentSmoother : public Smoother {
 public:
  PersistentSmoother(std::unique_ptr<Smoother> for_all, double no_gain, const SmoothingProblem& problem,
                     RecordDetail detail)
      : for_all_(std::move(for_all)), no_gain_(no_gain), problem_(problem), detail_(detail) {}

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    if (!is_jammed_) for_all_->step(positions, record);
    if (is_jammed_ || record.moved == 0) {
      if (!one_by_one_) one_by_one_ = make_one_by_one(problem_, detail_);
      one_by_one_->step(positions, record);
    }
    const bool alone = record.kind == StepKind::one_by_one;
    const double gain = gain_of(record);
    is_jammed_ = alone ? gain >= kOneByOneGain
                       : pays_alone_ && gain < no_gain_ && is_limited(record, kLimitSurface | kLimitFold);
    if (alone) pays_alone_ = gain >= kHeldUpGain;
  }

 private:
  std::unique_ptr<Smoother> for_all_, one_by_one_;
  double no_gain_;  // a smaller one is none
  const SmoothingProblem& problem_;
  RecordDetail detail_;
  bool is_jammed_ = false;  // the next step is of one vertex after another
  bool pays_alone_ = true;  // the last such step, if any, gained something
};

}  // namespace

std::unique_ptr<Smoother> make_smoother(const SmoothingProblem& problem, Solver solver, RecordDetail detail) {
  JacobiOptions jacobi;
  NewtonOptions newton;
  LbfgsOptions lbfgs;
  jacobi.detail = newton.detail = lbfgs.detail = detail;
  switch (solver) {
    case Solver::jacobi:
      return make_jacobi(problem, jacobi);
    case Solver::newton:
      return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
        return std::make_unique<PersistentSmoother>(make_newton(numbered, newton), kJammedNewton, numbered,
                                                    detail);
      });
    case Solver::lbfgs:
      return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
        return std::make_unique<PersistentSmoother>(make_lbfgs(numbered, lbfgs), kNoGain, numbered, detail);
      });
    case Solver::automatic:
      break;
  }
  const auto automatic = [=](const SmoothingProblem& numbered) {
    return std::make_unique<AutomaticSmoother>(numbered, detail);
  };
  return make_slide_first(
      problem, [=](const SmoothingProblem& either) { return make_near_in_memory(either, automatic); });
}

}  // namespace isorelax
