#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "smoothing/fold_control.h"
#include "smoothing/objective.h"
#include "smoothing/run.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

/// Rounds in which only vertices whose own surroundings got worse are cut back, then rounds that cut all.
constexpr unsigned kLocalGuardRounds = 6;
constexpr unsigned kGlobalGuardRounds = 40;

/// A move below this share of the mean edge length is not worth making.
constexpr double kConvergedMove = 1e-12;

class JacobiSmoother : public Smoother {
 public:
  JacobiSmoother(const SmoothingProblem& problem, const JacobiOptions& options)
      : problem_(problem),
        options_(options),
        here_(problem),
        there_(problem),
        fold_(problem),
        norm_partials_(block_count(problem.vertex_count())) {}

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    prepare(record);
    // A run asks for the positions that the guard of the step before evaluated: those sums are still at hand.
    if (there_.is_at(positions)) std::swap(here_, there_);
    if (!here_.is_at(positions)) here_.evaluate(positions);
    record.before = here_.totals();
    if (options_.detail == RecordDetail::vertices_and_triangles) here_.record_triangles(positions, record);
    propose(positions, record);
    fold_.limit(positions, record);
    guard_energy(positions, record);
    finish(record);
  }

 private:
  void prepare(StepRecord& record) const {
    const std::size_t n = problem_.vertex_count();
    record.gradient.resize(n);
    record.displacement.resize(n);
    record.alpha.assign(n, 1);
    record.limits = problem_.fixed_limits;
    record.tangent_class = problem_.classes.classes;
    record.fold_passes = record.energy_passes = 0;
  }

  /// Gradient and the displacement of Eq. 9 for every vertex.
  void propose(std::span<const Vec3> positions, StepRecord& record) {
    const double small = kConvergedMove * problem_.mean_edge_length;
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double squares = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const Index v = static_cast<Index>(i);
        const VertexSums sums = here_.gather(positions, v);
        record.gradient[v] = sums.gradient;
        const Vec3 tangent = tangent_part(problem_, positions, v, sums);
        squares += tangent.squaredNorm();
        Vec3& d = record.displacement[v];
        d = sums.stiffness > 0 ? Vec3(-options_.relaxation / sums.stiffness * tangent) : Vec3::Zero();
        if (problem_.mobility[v] != Mobility::none && d.squaredNorm() <= small * small) {
          d.setZero();
          record.limits[v] |= kLimitConverged;
        }
      }
      norm_partials_[begin / kBlockSize] = squares;
    });
    double squares = 0;
    for (const double partial : norm_partials_) squares += partial;
    record.before.gradient_norm = std::sqrt(squares);
  }

  /// Accepts the step only if the energy does not rise: first cuts back the vertices around which it rose,
  /// then all.
  void guard_energy(std::span<const Vec3> positions, StepRecord& record) {
    for (unsigned round = 0;; ++round) {
      move_trial(positions, record);
      record.after = there_.evaluate(trial_);
      if (record.after.energy <= record.before.energy) return;
      ++record.energy_passes;
      if (round < kLocalGuardRounds) {
        cut_where_energy_rose(positions, record);
        fold_.limit(positions, record);
      } else {
        const bool give_up = round >= kLocalGuardRounds + kGlobalGuardRounds;
        for (Index v = 0; v < problem_.vertex_count(); ++v) cut(record, v, give_up ? 0.0 : 0.5);
      }
    }
  }

  void move_trial(std::span<const Vec3> positions, const StepRecord& record) {
    trial_.assign(positions.begin(), positions.end());
    apply_step(record, trial_);
  }

  void cut_where_energy_rose(std::span<const Vec3> positions, StepRecord& record) {
    here_.triangle_energies(positions, energy_here_);
    there_.triangle_energies(trial_, energy_there_);
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Index v = static_cast<Index>(i);
        double change = 0;
        for (const Corner c : problem_.topology.corners_of(v))
          change += energy_there_[c / 3] - energy_here_[c / 3];
        if (!(change <= 0)) cut(record, v, 0.5);
      }
    });
  }

  static void cut(StepRecord& record, Index v, double factor) {
    if (record.alpha[v] == 0 || record.displacement[v].isZero(0)) return;
    record.alpha[v] *= factor;
    record.limits[v] |= kLimitEnergy;
  }

  void finish(StepRecord& record) const {
    double largest = 0;
    record.moved = 0;
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      const double squared = record.alpha[v] * record.alpha[v] * record.displacement[v].squaredNorm();
      largest = std::max(largest, squared);
      record.moved += squared > 0 ? 1 : 0;
    }
    record.largest_move = std::sqrt(largest);
  }

  const SmoothingProblem& problem_;
  JacobiOptions options_;
  Objective here_, there_;  // at the step's positions, and at the last trial
  FoldControl fold_;
  std::vector<Vec3> trial_;
  std::vector<double> norm_partials_, energy_here_, energy_there_;
};

}  // namespace

std::unique_ptr<Smoother> make_jacobi(const SmoothingProblem& problem, const JacobiOptions& options) {
  return std::make_unique<JacobiSmoother>(problem, options);
}

}  // namespace isorelax
