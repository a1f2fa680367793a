#include <cmath>

#include "smoothing/guarded_smoother.h"
#include "smoothing/lbfgs_memory.h"

namespace isorelax {
namespace {

/// Share of a proposed step below which what was accepted of it counts as nothing.
constexpr double kUseless = 0.02;

class LbfgsSmoother : public GuardedSmoother {
 public:
  LbfgsSmoother(const SmoothingProblem& problem, const LbfgsOptions& options)
      : GuardedSmoother(problem, options.detail),
        sweep_(problem),
        memory_(problem.vertex_count(), options.memory, problem.threads),
        tangent_(problem.vertex_count()),
        blocks_(problem.vertex_count()),
        squares_(block_count(problem.vertex_count())) {}

 private:
  /// The first step is a Newton step, in which every vertex may be cut back alone.
  [[nodiscard]] bool cuts_all_alike() const override { return !memory_.empty(); }

  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const double norm = sweep_.run(here, positions, [&](const TangentBatch& batch) {
      const auto blocks = newton_blocks(problem_, here, batch);
      for (unsigned i = 0; i < batch.count; ++i) {
        record.gradient[batch.first + i] = batch.sums[i].gradient;
        tangent_[batch.first + i] = batch.gradients[i];
        blocks_[batch.first + i] = blocks[i];
      }
    });
    if (!continues()) memory_.start_anew();
    memory_.arrive(positions, tangent_, kUseless * proposed_);
    if (!(memory_.direction(tangent_, blocks_, record.displacement) < 0)) {
      // The remembered curvature pointed uphill: the preconditioned gradient never does.
      memory_.clear();
      memory_.direction(tangent_, blocks_, record.displacement);
    }
    finish_proposal(record);
    return norm;
  }

  void finish_proposal(StepRecord& record) {
    // The preconditioner alone overshoots where neighbours move at once.
    const double factor = memory_.empty() ? NewtonOptions{}.relaxation : 1;
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double squares = 0;
      for (std::size_t v = begin; v < end; ++v) {
        set_move(record, static_cast<Index>(v), factor * record.displacement[v]);
        squares += record.displacement[v].squaredNorm();
      }
      squares_[begin / kBlockSize] = squares;
    });
    double squares = 0;
    for (const double s : squares_) squares += s;
    proposed_ = std::sqrt(squares);
  }

  TangentSweep sweep_;
  LbfgsMemory memory_;
  Field tangent_;
  std::vector<NewtonBlock> blocks_;
  std::vector<double> squares_;
  double proposed_ = 0;  // length of the last step as proposed
};

}  // namespace

std::unique_ptr<Smoother> make_lbfgs(const SmoothingProblem& problem, const LbfgsOptions& options) {
  return std::make_unique<LbfgsSmoother>(problem, options);
}

}  // namespace isorelax
