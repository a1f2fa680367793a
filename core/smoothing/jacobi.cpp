#include "smoothing/guarded_smoother.h"
#include "smoothing/renumbered_smoother.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

class JacobiSmoother : public GuardedSmoother {
 public:
  JacobiSmoother(const SmoothingProblem& problem, const JacobiOptions& options)
      : GuardedSmoother(problem, StepKind::jacobi, options.detail),
        relaxation_(options.relaxation),
        sweep_(problem) {}

 private:
  /// Gradient and the displacement of Eq. 9 for every vertex.
  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    return sweep_.run(here, positions, [&](const TangentBatch& batch) {
      for (unsigned i = 0; i < batch.count; ++i) {
        const double stiffness = batch.sums[i].stiffness;
        record.gradient[batch.vertices[i]] = batch.sums[i].gradient;
        set_move(record, batch.vertices[i],
                 stiffness > 0 ? Vec3(-relaxation_ / stiffness * batch.gradients[i]) : Vec3::Zero());
      }
    });
  }

  double relaxation_;
  TangentSweep sweep_;
};

}  // namespace

std::unique_ptr<Smoother> make_jacobi(const SmoothingProblem& problem, const JacobiOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<JacobiSmoother>(numbered, options);
  });
}

}  // namespace isorelax
