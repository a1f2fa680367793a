#include "smoothing/energy_ring.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/newton_block.h"
#include "smoothing/renumbered_smoother.h"

namespace isorelax {
namespace {

/// E over the sum of its weights from which a vertex goes to its own minimum instead of one Newton step: one
/// step opens a sliver by a fraction only. Where all vertices did that, neighbours would swing about the
/// minimum.
constexpr double kNeedleEnergy = 7;

class NewtonSmoother : public GuardedSmoother {
 public:
  NewtonSmoother(const SmoothingProblem& problem, const NewtonOptions& options)
      : GuardedSmoother(problem, StepKind::newton, options.detail),
        options_(options),
        needle_(kNeedleEnergy * (problem.weights.shape + problem.weights.area)),
        sweep_(problem) {}

 private:
  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    if (!continues()) last_.clear();
    const double norm = sweep_.run(here, positions, [&](const TangentBatch& batch) {
      const auto blocks = newton_blocks(problem_, here, batch);
      for (unsigned i = 0; i < batch.count; ++i) {
        const Index v = batch.vertices[i];
        record.gradient[v] = batch.sums[i].gradient;
        if (has_needle(here, v)) {
          set_move(record, v,
                   options_.relaxation * move_to_local_minimum(problem_, positions, v, batch.axes[i]));
          continue;
        }
        Vec3 d = -options_.relaxation * blocks[i].solve(batch.gradients[i]);
        if (!last_.empty()) {
          const Vec3 before = blocks[i].tangent(positions[v] - last_[v]);
          if (before.dot(batch.gradients[i]) < 0) d += options_.momentum * before;
        }
        set_move(record, v, d);
      }
    });
    last_.assign(positions.begin(), positions.end());
    return norm;
  }

  [[nodiscard]] bool has_needle(const Objective& here, Index vertex) const {
    if (problem_.mobility[vertex] == Mobility::none) return false;
    for (const Corner c : problem_.topology.corners_of(vertex)) {
      if (here.energy(c / 3) > needle_) return true;
    }
    return false;
  }

  NewtonOptions options_;
  double needle_;
  TangentSweep sweep_;
  std::vector<Vec3> last_;  // positions of the step before
};

}  // namespace

std::unique_ptr<Smoother> make_newton(const SmoothingProblem& problem, const NewtonOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<NewtonSmoother>(numbered, options);
  });
}

}  // namespace isorelax
