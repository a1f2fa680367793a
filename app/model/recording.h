#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "model/mesh_state.h"
#include "motion/motion_run.h"
#include "motion/motion_share.h"
#include "trace/recorder.h"
#include "trace/redo.h"

namespace isorelax::model {

/// How the recorded steps of a moving surface are made and measured. Belongs to the worker.
struct MotionTrack {
  MotionSetup setup;
  MovingState tip;                 ///< after the last recorded step
  std::unique_ptr<MotionRun> run;  ///< in that state; null while another one is being made
  /// What its triangles are measured by: the motion's reference. Null where the start cannot be.
  std::unique_ptr<const SmoothingProblem> measured_by;
  std::optional<MotionShare> share;  ///< made when a vertex is looked at
};

/// Positions that a problem is made from; null: those that its document starts from (Workbench::start_of).
using BasePtr = std::shared_ptr<const std::vector<Vec3>>;

/// How a run that was read from a file is understood.
struct ReadAs {
  std::vector<std::shared_ptr<const RunPlan>> plans;  ///< of each of its parts
  SmoothingSettings settings;                         ///< the nearest that the editor has
  bool exact = false;                                 ///< these settings measure the same energy
};

/// The iterations of one branch, in core/trace's form: positions as deltas, and a few whole ones in between
/// so that any iteration is near one. Belongs to the worker: no other thread touches what is in it.
class Recording {
 public:
  Recording();
  /// No other recording of this process has had it: what is kept of one that is gone is never taken for what
  /// another one, at the same address, would have. Not 0.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// Begins at these positions of the document's mesh; `about` says what the run is. Its problem is made from
  /// `base`; at the mesh as opened, the first step begins there, too.
  void begin(Trace about, const TriangleMesh& mesh, std::span<const Vec3> start, BasePtr base = {});
  /// A run that was recorded before. Precondition: it has parts, as many as `as` has plans, or `as` has none
  /// because its steps cannot be made again.
  void take(Trace trace, ReadAs as);
  /// How the run is understood that was taken; null for one that can grow.
  [[nodiscard]] const ReadAs* read_as() const { return taken_ ? &read_as_ : nullptr; }
  /// Whether it can go on: not for a run that was read from a file.
  [[nodiscard]] bool can_grow() const { return recorder_ != nullptr; }
  [[nodiscard]] bool has_begun() const { return recorder_ != nullptr || taken_ != nullptr; }

  /// Where the next step begins, of a run that can grow and stands at these positions.
  [[nodiscard]] std::span<const Vec3> next_start(std::span<const Vec3> at) const;
  /// Adds the next step.
  void add(const StepRecord& record, std::span<const Vec3> positions);
  [[nodiscard]] const Trace& trace() const { return recorder_ ? recorder_->trace() : *taken_; }
  [[nodiscard]] Trace& trace() { return recorder_ ? recorder_->trace() : *taken_; }
  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(trace().iterations.size()); }

  /// What the problem of a run that can grow is made from.
  [[nodiscard]] const BasePtr& base() const { return base_; }

  /// Positions after so many iterations of the branch. Throws Error for a damaged delta.
  [[nodiscard]] std::vector<Vec3> positions_at(unsigned iteration);

  /// A smoother that knows nothing of the steps before makes the next ones, of this kind, for this problem: a
  /// part of the trace begins.
  void note_fresh_start(PartKind kind, const SmoothingProblem& problem);
  /// Null for iterations of a smoother.
  std::shared_ptr<MotionTrack> motion;

 private:
  void keep(unsigned iteration, std::span<const Vec3> positions);

  std::uint64_t number_;
  std::unique_ptr<TraceRecorder> recorder_;
  std::unique_ptr<Trace> taken_;
  std::map<unsigned, std::vector<Vec3>> whole_;  // iteration -> positions
  unsigned stride_ = 8;                          // between whole ones
  ReadAs read_as_;
  BasePtr base_;
  bool from_base_ = false;  // the first step is
  std::string
      to_base_;  // delta from the start to what the problem is made from; empty where they are the same
};

/// Full step records of the newest steps, as many as fit into a budget; and states that somebody still holds,
/// so that the same iteration is the same state. Recordings go by their numbers. Belongs to the worker.
class StepStore {
 public:
  static constexpr std::size_t kDefaultBudget = std::size_t{1} << 30U;  // bytes

  /// Drops the oldest records that no longer fit.
  void set_budget(std::size_t bytes);
  void add(std::uint64_t recording, unsigned iteration, std::shared_ptr<const StepRecord> record);
  /// Null when it is not kept.
  [[nodiscard]] std::shared_ptr<const StepRecord> find(std::uint64_t recording, unsigned iteration) const;
  void clear();
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t count() const { return kept_.size(); }
  [[nodiscard]] bool fits(std::size_t bytes) const { return bytes <= budget_; }

 private:
  using Key = std::pair<std::uint64_t, unsigned>;
  struct Kept {
    Key key;
    std::shared_ptr<const StepRecord> record;
    std::size_t bytes;
  };
  void drop_oldest();

  std::deque<Kept> kept_;
  std::size_t bytes_ = 0;
  std::size_t budget_ = kDefaultBudget;
};

}  // namespace isorelax::model
