#include <algorithm>

#include "smoothing/even_out.h"
#include "smoothing/renumbered_smoother.h"

namespace isorelax {
namespace {

/// Evening out is cheap and soon done: what gains less than this share of the energy is the last such step.
constexpr double kEvenGain = 0.05;
/// Newton steps open the worst places fast, each vertex at its own pace; once none is left that bad (E over
/// the sum of the weights), a step gains less than this share of the energy, L-BFGS converges faster. While
/// one is left, less will do.
constexpr double kBadEnergy = 7;
constexpr double kWorthwhileGain = 0.01;
constexpr double kLeastGain = 0.002;

class AutomaticSmoother : public Smoother {
 public:
  AutomaticSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : problem_(problem), detail_(detail) {}

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    // Elsewhere than the last step led, everything starts anew.
    if (!std::ranges::equal(positions, led_to_)) begin();
    if (phase_ == Phase::even) even_out_->step(positions, record);
    if (phase_ == Phase::lbfgs) once_made(lbfgs_, Solver::lbfgs).step(positions, record);
    // A direction for all may lead nowhere where many vertices are held back; one for each alone may still
    // do.
    if (phase_ != Phase::newton && record.moved == 0) phase_ = Phase::newton;
    if (phase_ == Phase::newton) once_made(newton_, Solver::newton).step(positions, record);
    led_to_.assign(positions.begin(), positions.end());
    apply_step(record, led_to_);
    choose_next(record);
  }

 private:
  enum class Phase : std::uint8_t { even, newton, lbfgs };

  void begin() {
    phase_ = wants_even(problem_) ? Phase::even : Phase::newton;
    if (phase_ == Phase::even) even_out_ = make_even_out(problem_, detail_);
  }

  Smoother& once_made(std::unique_ptr<Smoother>& smoother, Solver solver) const {
    if (!smoother) smoother = make_smoother(problem_, solver, detail_);
    return *smoother;
  }

  void choose_next(const StepRecord& record) {
    const double gain = (record.before.energy - record.after.energy) / record.before.energy;
    if (phase_ == Phase::even) {
      if (gain < kEvenGain) phase_ = Phase::newton;
    } else if (phase_ == Phase::newton) {
      const bool bad =
          record.after.worst_energy > kBadEnergy * (problem_.weights.shape + problem_.weights.area);
      if (gain < (bad ? kLeastGain : kWorthwhileGain)) phase_ = Phase::lbfgs;
    }
    if (phase_ != Phase::even) even_out_.reset();
  }

  const SmoothingProblem& problem_;
  RecordDetail detail_;
  std::unique_ptr<Smoother> even_out_, newton_, lbfgs_;
  std::vector<Vec3> led_to_;
  Phase phase_ = Phase::even;
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
      return make_newton(problem, newton);
    case Solver::lbfgs:
      return make_lbfgs(problem, lbfgs);
    case Solver::automatic:
      break;
  }
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<AutomaticSmoother>(numbered, detail);
  });
}

}  // namespace isorelax
