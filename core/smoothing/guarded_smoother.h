#pragma once

#include "smoothing/fold_control.h"
#include "smoothing/objective.h"
#include "smoothing/run.h"

namespace isorelax {

/// What keeps a step from doing harm.
enum class StepGuard : std::uint8_t {
  folds_and_energy,  ///< no triangle folds and the energy does not rise
  all_or_nothing,    ///< no triangle folds, and where the energy would rise nothing moves
  folds,             ///< no triangle folds
  none,
};

/// What all steps share: a proposed tangent move for every vertex goes through the asynchronous fold control
/// and the energy guard into a record. Those who derive say which moves to propose.
class GuardedSmoother : public Smoother {
 public:
  void step(std::span<const Vec3> positions, StepRecord& record) final;

 protected:
  GuardedSmoother(const SmoothingProblem& problem, StepKind kind, RecordDetail detail,
                  StepGuard guard = StepGuard::folds_and_energy);

  /// Fills gradient and displacement (zero where nothing may or should move) of every vertex, and adds to
  /// record.limits. Returns the 2-norm of the tangent gradient. `here` is evaluated at `positions`.
  virtual double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) = 0;
  /// Whether a rising energy cuts back all vertices alike from the start, which keeps the direction.
  [[nodiscard]] virtual bool cuts_all_alike() const { return false; }

  /// Whether the moves proposed only make sense together: what is too long for many is for all.
  [[nodiscard]] virtual bool go_together() const { return false; }

  /// Whether what is proposed ends on the surface already.
  [[nodiscard]] virtual bool leads_to_the_surface() const { return false; }

  /// Whether the positions of this step are those to which the step before led.
  [[nodiscard]] bool continues() const { return continues_; }
  /// Rounds that the step before took against a rising energy.
  [[nodiscard]] unsigned last_energy_rounds() const { return last_energy_rounds_; }
  /// Vertices that it kept from folding something.
  [[nodiscard]] std::size_t last_folded() const { return last_folded_; }

  /// Sets the proposed move of a vertex: none, and a note in the record, where it is not worth making or not
  /// finite.
  void set_move(StepRecord& record, Index vertex, const Vec3& move) const;

  const SmoothingProblem& problem_;

 private:
  void prepare(StepRecord& record) const;
  void guard_energy(StepRecord& record);
  [[nodiscard]] double way_downhill(const StepRecord& record) const;
  [[nodiscard]] std::vector<Index> vertices_where_energy_rose() const;
  [[nodiscard]] std::vector<Index> vertices_of_worse_triangles() const;
  void finish(StepRecord& record) const;

  StepKind kind_;
  RecordDetail detail_;
  StepGuard guard_;
  bool continues_ = false;
  unsigned last_energy_rounds_ = 0;
  std::size_t last_folded_ = 0;
  Objective here_, there_;  // at the step's positions, and at the last trial
  Trial trial_;
  FoldControl fold_;
};

}  // namespace isorelax
