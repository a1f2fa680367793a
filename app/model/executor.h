#pragma once

#include "model/command.h"
#include "model/timeline_jobs.h"
#include "model/trace_jobs.h"

namespace isorelax::model {

/// Carries commands and events out on a session. Private to this room.
class Executor {
 public:
  explicit Executor(Session& session) : s_(session) {}

  void operator()(const OpenFile& command);
  void operator()(const SaveFile& command);
  void operator()(const SetSmoothing& command);
  void operator()(const EndEdit& command);
  void operator()(const SetView& command);
  void operator()(const Run& command);
  void operator()(const Pause& command);
  void operator()(const Step& command);
  void operator()(const Reset& command);
  void operator()(const StepBack& command);
  void operator()(const Undo& command);
  void operator()(const Redo& command);
  void operator()(const Cancel& command);
  void operator()(const SelectNextWorst& command);
  void operator()(const ClearSelection& command);
  void operator()(const CopyCommandLine& command);
  void operator()(const Say& command);
  void operator()(const SetRecent& command);
  void operator()(const Collect& command);
  void operator()(const Seek& command);
  void operator()(const SetStage& command);
  void operator()(const StepStage& command);
  void operator()(const SelectVertex& command);
  void operator()(const SelectTriangle& command);
  void operator()(const SelectLimited& command);
  void operator()(const SetWorstBy& command);
  void operator()(const TogglePin& command);
  void operator()(const SetBreakpoints& command);
  void operator()(const SetStepBudget& command);
  void operator()(const ShowBranches& command);
  void operator()(const CompareBranches& command);
  void operator()(const RemoveRun& command);
  void operator()(const Teach& command);
  void operator()(const SaveTrace& command);
  void operator()(const OpenTrace& command);
  void operator()(const AddTrace& command);
  void operator()(const SetTask& command);
  void operator()(const SetMotion& command);
  void operator()(const OpenSphere& command);
  void operator()(const Move& command);

  void operator()(Loaded& event);
  void operator()(EnergyMeasured& event);
  void operator()(Iterated& event);
  void operator()(RunEnded& event);
  void operator()(SurfaceMeasured& event);
  void operator()(SurfaceGaveWay& /*event*/) { s_.measure_surface_later_ = true; }
  void operator()(Saved& event);
  void operator()(Failed& event);
  void operator()(RunFailed& event);
  void operator()(Sought& event);
  void operator()(Inspected& event);
  void operator()(Followed& event);
  void operator()(TraceOpened& event);
  void operator()(Compared& event);
  void operator()(Wrote& event);
  void operator()(Scanned& event);
  void operator()(Moved& event);
  void operator()(MotionEnded& event);
  void operator()(MotionInspected& event);
  void operator()(MovingPath& event);

 private:
  void say(MessageKind kind, std::string text, Topic topic = Topic::other);
  void keep_hits(std::vector<BreakHit>& hits);
  void keep_result(const std::optional<RunResult>& result);
  void start_run(unsigned iterations, PartKind kind);
  [[nodiscard]] PartKind kind_here() const;
  void start_polish();
  void polish_when_idle(PartKind after);
  void leave_polish_ahead();
  [[nodiscard]] bool is_polished() const;
  void prepare_run(unsigned iterations);
  void forget_motion_energy();
  void start_motion(unsigned steps);
  bool move_over_recorded(unsigned steps);
  void begin_motion();
  void turn_to(Task task);
  [[nodiscard]] bool refuses_to_smooth();
  [[nodiscard]] unsigned iteration_beside(unsigned branch) const;
  [[nodiscard]] std::optional<unsigned> branch_shown_at_start() const;
  void ask_about_motion();
  void end_run();
  bool wait_for_run(std::function<void(Session&)> then);
  void go_on_when_idle();
  void drop_what_waits();
  [[nodiscard]] bool refuses_while_teaching();
  bool run_over_recorded(unsigned iterations);
  Place begin_branch(PartKind kind);
  void drop_empty_branch();
  void seek(unsigned branch, unsigned iteration, unsigned beside_at = 0);
  void ask_about_step();
  void follow_selection();
  void forget_runs();
  void clear_selection();
  [[nodiscard]] Place place_of(unsigned branch, unsigned iteration) const;
  [[nodiscard]] Place place_shown() const;
  [[nodiscard]] Path path_of(unsigned branch, unsigned last) const;
  [[nodiscard]] std::span<const double> worst_values();
  void measure_energy_if_changed();
  void measure_surface();
  void show(const MeshStatePtr& state);
  void apply(UndoEntry& entry, bool forward);
  void apply(RunsChange& change, bool forward);
  [[nodiscard]] RunsChange::View view_of_runs() const;
  void put_run(RunsChange::Run& run);
  void take_run(RunsChange::Run& run);
  void add_dependent(std::vector<RunsChange::Run>& runs) const;
  void show_runs(const RunsChange::View& view);
  void note_teaching();
  [[nodiscard]] MeshStatePtr as_on_disk(const MeshStatePtr& state) const;
  bool show_beside_again();
  void remember_recent(const std::filesystem::path& path);

  Session& s_;
};

}  // namespace isorelax::model
