#pragma once

#include <deque>
#include <memory>

#include "model/document.h"
#include "model/recording.h"
#include "model/settings.h"
#include "smoothing/bounded_run.h"

namespace isorelax::model {

/// What the worker keeps between jobs: the frozen problems of the open document, the smoother of the last
/// run, the full records of steps. Belongs to the worker.
///
/// The problem is made from the mesh as it was opened, with what lay upside down turned, or as a run that was
/// read began from it, and never from where a run stands, so that one that was paused and continued goes
/// where one long run goes.
class Workbench {
 public:
  using ProblemPtr = std::shared_ptr<const SmoothingProblem>;

  /// What the runs of a document start from.
  struct Start {
    BasePtr
        base;  ///< the mesh as opened, with what can be turned of what lies upside down; null: nothing does
    UntangledStart untangled;
  };
  /// Found anew only for another document, or other settings that play a part in it. Throws Error.
  const Start& start_of(const DocumentPtr& document, const SmoothingSettings& settings);

  /// What a problem is made from: `known`, or else what the document starts from. Throws Error.
  BasePtr base_or_start(const DocumentPtr& document, const SmoothingSettings& settings, const BasePtr& known);

  /// The problem for these settings; made anew only when it is none of the last few. Throws Error.
  ProblemPtr problem(const DocumentPtr& document, const SmoothingSettings& settings,
                     const BasePtr& base = {});

  /// How words are understood that runs were made with; at first as the editor's settings are.
  void set_plan_reader(PlanReader reader) { read_words_ = std::move(reader); }
  /// The plans of the parts of a trace, in order. Throws Error where one is not understood, or a file that it
  /// names is not what it was.
  [[nodiscard]] std::vector<std::shared_ptr<const RunPlan>> read_plans(const Trace& trace) const;
  /// The problem of a part of a recording that was read; made anew only when it is none of the last few.
  /// Throws Error. Precondition: it has plans.
  ProblemPtr part_problem(const Recording& recording, std::size_t part);

  /// A smoother for the next step of a recording, all steps of which are of one kind: the one that made its
  /// last step, or a new one, of which the recording takes note. Throws Error.
  Smoother& smoother(const DocumentPtr& document, const SmoothingSettings& settings, PartKind kind,
                     Recording& recording);
  /// The smoother has made the recording's last step.
  void went_on(const Recording& recording) { at_ = recording.size(); }

  /// The run of a moving surface in the state of its last recorded step: the one that made it, or a new one.
  /// Throws Error.
  MotionRun& motion_run(const std::shared_ptr<MotionTrack>& track);

  /// Another document, or the same one read again, is open: nothing kept is good any more.
  void forget();

  [[nodiscard]] StepStore& steps() { return steps_; }
  /// A measured geometry of a recording, by its number, that is still in use somewhere; null otherwise. 0:
  /// of the mesh as opened.
  [[nodiscard]] std::shared_ptr<const Geometry> geometry(std::uint64_t recording, unsigned iteration);
  void note_geometry(std::uint64_t recording, unsigned iteration,
                     const std::shared_ptr<const Geometry>& geometry);

 private:
  struct Made {
    DocumentPtr document;
    SmoothingSettings settings;
    BasePtr base;
    ProblemPtr problem;
  };
  struct MadePart {
    std::uint64_t recording;
    std::size_t part;
    ProblemPtr problem;
  };
  struct MadeStart {
    DocumentPtr document;
    SmoothingSettings settings;
    Start start;
  };
  std::deque<Made> problems_;       // newest first
  std::optional<MadeStart> start_;  // of the last document and settings
  std::deque<MadePart> parts_;      // newest first
  PlanReader read_words_;           // none: the editor's settings
  ProblemPtr smoothed_;             // what the smoother works on
  std::unique_ptr<Smoother> smoother_;
  std::uint64_t recording_ = 0;         // whose last step the smoother made
  unsigned at_ = 0;                     // how many steps that had
  std::shared_ptr<MotionTrack> moved_;  // whose run is kept
  StepStore steps_;
  std::map<std::pair<std::uint64_t, unsigned>, std::weak_ptr<const Geometry>> geometries_;
};

/// A smoother on a problem that keeps all detail of its steps: what the settings name, or their polish. Keeps
/// a reference to the problem.
[[nodiscard]] std::unique_ptr<Smoother> make_smoother(const SmoothingProblem& problem,
                                                      const SmoothingSettings& settings,
                                                      PartKind kind = PartKind::solver);

/// What the distance of these settings is one from: the mesh as opened, or `start` where it is automatic, as
/// in run_bounded.
[[nodiscard]] std::span<const Vec3> limited_from(const SmoothingSettings& settings, const TriangleMesh& mesh,
                                                 std::span<const Vec3> start);

/// How these settings keep the surface near `original`.
struct KeptNear {
  double deviation;  ///< the largest, over its bounding-box diagonal; infinite: any
  bool on_fits;      ///< SurfaceHolds
};
[[nodiscard]] KeptNear kept_near(const SmoothingSettings& settings, std::span<const Vec3> original,
                                 const SmoothingProblem& problem);

/// What a run with these settings is made with. Reads the reference file; throws Error.
[[nodiscard]] RunPlan plan_of(const SmoothingSettings& settings);

/// Which creases these settings keep.
[[nodiscard]] FeatureOptions feature_options(const SmoothingSettings& settings);

/// The library's options for these settings. Reads the reference file; throws Error.
[[nodiscard]] ProblemOptions problem_options(const SmoothingSettings& settings);

}  // namespace isorelax::model
