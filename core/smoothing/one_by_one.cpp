#include "smoothing/one_by_one.h"

#include <cmath>

#include "mesh/angle.h"
#include "smoothing/energy_ring.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/polish_state.h"
#include "smoothing/renumbered_smoother.h"

namespace isorelax {
namespace {

/// A vertex that could gain less than this share of the energy of its triangles is left to steps for all.
constexpr double kWorthwhileShare = 1e-3;

class OneByOneSmoother : public GuardedSmoother {
 public:
  OneByOneSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : GuardedSmoother(problem, StepKind::one_by_one, detail),
        sweep_(problem),
        state_(problem),
        axes_(problem.vertex_count()),
        bounds_(problem.triangle_count(), angles_of(problem.worst_angles)) {}

 private:
  static AngleRange angles_of(const WorstAngles& worst) {
    return {kDegrees * std::atan2(1, worst.smallest_cot), kDegrees * std::atan2(1, worst.largest_cot)};
  }

  [[nodiscard]] bool leads_to_the_surface() const override { return true; }

  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const double norm = sweep_.find_tangents(here, positions, record.gradient, axes_);
    state_.start(positions);
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      if (problem_.mobility[v] != Mobility::none) visit(v, record);
    }
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      const Vec3 move = state_.positions()[v] - positions[v];
      if (move.isZero(0) && record.limits[v] != problem_.fixed_limits[v]) {
        record.displacement[v].setZero();  // held back, which is not the same as converged
      } else {
        set_move(record, v, move);
      }
    }
    return norm;
  }

  void visit(Index v, StepRecord& record) {
    state_.look_at(v);
    const EnergyRing ring(problem_, state_.positions(), v);
    const Vec3& at = state_.positions()[v];
    const EnergyRing::Slope slope = ring.slope(at);
    const AngleRing::Soft soft{-ring.energy(at), -slope.gradient, slope.curvature};
    NewtonBlock block(problem_.mobility[v], axes_[v]);
    block.add(slope.curvature);
    if (block.solve(slope.gradient).dot(slope.gradient) < kWorthwhileShare * -soft.value) return;
    const auto value = [&](const Vec3& there) { return -ring.energy(there); };
    if (const auto there = state_.climb(v, at, soft, value, bounds_)) state_.move(v, *there);
    record.limits[v] |= state_.held_back();
  }

  TangentSweep sweep_;
  PolishState state_;
  std::vector<Vec3> axes_;
  std::vector<AngleRange> bounds_;
};

}  // namespace

std::unique_ptr<Smoother> make_one_by_one(const SmoothingProblem& problem, RecordDetail detail) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<OneByOneSmoother>(numbered, detail);
  });
}

}  // namespace isorelax
