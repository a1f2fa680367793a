#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/event.h"
#include "model/settings.h"

namespace isorelax::model {

class Recording;

/// What Run does.
enum class Task : std::uint8_t {
  smooth,  ///< iterations of a smoother
  move,    ///< steps of a motion
};

/// A place inside an iteration: what the smoother had found so far. Its arrows stand on the mesh before the
/// step.
enum class StageKind : std::uint8_t {
  gradient,  ///< downhill: minus the energy's gradient
  tangent,   ///< its part in the tangent space
  proposed,  ///< the move that the solver makes of it
  control,   ///< what a round of the step control leaves of it: against folds, or for the energy
  moved,     ///< the move that was made
};
struct Stage {
  StageKind kind = StageKind::moved;
  unsigned pass = 0;  ///< of control, from 0

  bool operator==(const Stage&) const = default;
};

/// Where the timeline stands: a branch, an iteration, and a stage inside the step that led to it.
struct Cursor {
  unsigned branch = 0;
  unsigned iteration = 0;
  std::optional<Stage> stage;

  bool operator==(const Cursor&) const = default;
};

/// Iterations made with one set of settings, from one start.
struct Branch {
  std::string name;
  SmoothingSettings settings;
  PartKind kind = PartKind::solver;
  std::optional<unsigned> parent;   ///< the branch that it left
  unsigned start = 0;               ///< the iteration at which it left
  std::vector<IterationRow> rows;   ///< of iterations start, start + 1, ..., tip()
  std::vector<StepSummary> steps;   ///< of the steps to iterations start + 1, ..., tip()
  std::optional<RunResult> result;  ///< of its last run; none for one that was read
  std::string ended;                ///< why that ended
  bool from_file = false;           ///< a recorded run that was read: it cannot go on
  /// Why its steps cannot be done again, for a trace made with options that the editor does not know.
  std::string not_redone;
  std::shared_ptr<Recording> recording;  ///< for the worker
  // Of a moving surface; its steps are made with `motion`, and `settings` take no part.
  std::optional<MotionChoices> motion;     ///< none: iterations of a smoother
  double until = 0;                        ///< time at which it ends
  std::vector<MotionEntry> moments;        ///< of iterations start, ..., tip()
  ValueRange areas{1, 1}, energies{2, 2};  ///< extremes over all moments
  Eigen::AlignedBox3d box;                 ///< holds all vertices at all moments

  [[nodiscard]] unsigned tip() const { return start + static_cast<unsigned>(steps.size()); }
};

/// All that was run since the mesh was opened.
struct Timeline {
  std::vector<Branch> branches;
  Cursor cursor;

  [[nodiscard]] bool empty() const { return branches.empty(); }
  [[nodiscard]] const Branch* current() const { return empty() ? nullptr : &branches[cursor.branch]; }
  /// The last iteration that the present branch leads to.
  [[nodiscard]] unsigned last() const { return empty() ? 0 : branches[cursor.branch].tip(); }
  /// Steps that were made here, not read from a trace.
  [[nodiscard]] std::size_t made_steps() const;
  /// The longest branch.
  [[nodiscard]] unsigned longest() const;
  /// The branch, this one or one that it came from, that holds an iteration. Precondition: iteration <=
  /// tip().
  [[nodiscard]] unsigned holder(unsigned branch, unsigned iteration) const;
  /// What the step to an iteration did; null for iteration 0 and for one that is not there.
  [[nodiscard]] const StepSummary* step(unsigned branch, unsigned iteration) const;
  /// "2  Laplacian": what a branch is called, with its number, which counts from 1.
  [[nodiscard]] std::string numbered_name(unsigned branch) const;
  /// The rows from iteration 0 to the branch' tip.
  [[nodiscard]] std::vector<IterationRow> rows(unsigned branch) const;
};

/// Whether both settings make the same steps: how many, when to stop, and what follows aside.
[[nodiscard]] bool same_steps(const SmoothingSettings& a, const SmoothingSettings& b);

/// Whether the steps of a branch are those that these settings make.
[[nodiscard]] bool same_steps(const Branch& branch, const SmoothingSettings& settings);

/// Whether a run ended by itself: not because somebody, or its number of iterations, said so.
[[nodiscard]] bool has_converged(const RunResult& result);

/// What a branch of this kind is called: its method, or all that it does otherwise than the one it left.
[[nodiscard]] std::string branch_name(const SmoothingSettings& settings, PartKind kind, const Branch* parent);

/// Whether both make the same steps.
[[nodiscard]] bool same_motion(const MotionChoices& a, const MotionChoices& b);

/// What a moving surface is called: its motion and its preset.
[[nodiscard]] std::string branch_name(const MotionChoices& motion);
/// "Eq. (10)", "Rigid motion", ...: a title for people.
[[nodiscard]] std::string_view title(FieldKind kind);

/// Stages of a step with so many rounds of control, in order.
[[nodiscard]] std::vector<Stage> stages_of(std::size_t passes);

/// A step as it was made.
struct StepView {
  Cursor at;  ///< the step that led there; of iteration 0 the one that leads away from it
  std::shared_ptr<const StepRecord> record;
  std::shared_ptr<const std::vector<Vec3>> before;
  MeshStatePtr before_state;  ///< the same, measured; null where nobody looks inside the step
  std::string mismatch;  ///< why it is not to be trusted: recomputing it led elsewhere. Empty: it did not.
  /// The part of the run that it belongs to, where there is more to say of it than the settings do.
  std::string made_with;
};

/// A vertex over the iterations of a branch.
struct VertexPath {
  unsigned branch = 0;
  Index vertex = 0;
  std::vector<Vec3> positions;  ///< from iteration 0 on
};

}  // namespace isorelax::model
