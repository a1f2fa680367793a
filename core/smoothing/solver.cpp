#include "smoothing/run.h"

namespace isorelax {
namespace {

/// Newton steps untangle the worst places fast, each vertex at its own pace; once a step gains less than this
/// share of the energy, L-BFGS converges faster.
constexpr double kWorthwhileGain = 0.01;

class AutomaticSmoother : public Smoother {
 public:
  AutomaticSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : newton_(make_smoother(problem, Solver::newton, detail)),
        lbfgs_(make_smoother(problem, Solver::lbfgs, detail)) {}

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    if (converging_) return lbfgs_->step(positions, record);
    newton_->step(positions, record);
    converging_ = record.before.energy - record.after.energy < kWorthwhileGain * record.before.energy;
  }

 private:
  std::unique_ptr<Smoother> newton_, lbfgs_;
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
  return std::make_unique<AutomaticSmoother>(problem, detail);
}

}  // namespace isorelax
