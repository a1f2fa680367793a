#include "smoothing/renumbered_smoother.h"
#include "smoothing/run.h"

#include <algorithm>

namespace isorelax {
namespace {

/// Newton steps open the worst places fast, each vertex at its own pace; once none is left that bad (E over
/// the sum of the weights), a step gains less than this share of the energy, L-BFGS converges faster. While
/// one is left, less will do.
constexpr double kBadEnergy = 7;
constexpr double kWorthwhileGain = 0.01;
constexpr double kLeastGain = 0.002;

class AutomaticSmoother : public Smoother {
 public:
  AutomaticSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : bad_(kBadEnergy * (problem.weights.shape + problem.weights.area)),
        newton_(make_smoother(problem, Solver::newton, detail)),
        lbfgs_(make_smoother(problem, Solver::lbfgs, detail)) {}

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    // Elsewhere than the last step led, everything starts anew.
    if (!std::ranges::equal(positions, led_to_)) converging_ = false;
    if (converging_) lbfgs_->step(positions, record);
    // A direction for all may lead nowhere where many vertices are held back; one for each alone may still
    // do.
    if (converging_ && record.moved == 0 && record.energy_passes > 0) converging_ = false;
    if (!converging_) newton_->step(positions, record);
    led_to_.assign(positions.begin(), positions.end());
    apply_step(record, led_to_);
    if (converging_) return;
    const double gain = (record.before.energy - record.after.energy) / record.before.energy;
    converging_ = gain < (record.after.worst_energy > bad_ ? kLeastGain : kWorthwhileGain);
  }

 private:
  double bad_;
  std::unique_ptr<Smoother> newton_, lbfgs_;
  std::vector<Vec3> led_to_;
  bool converging_ = false;
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
