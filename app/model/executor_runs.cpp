#include <algorithm>
#include <utility>

#include "model/executor.h"
#include "model/jobs.h"

// Runs of the smoother, the polish after them, and the branches that they begin.

namespace isorelax::model {
namespace {

constexpr const char* kPolished = "The polish has ended: nothing gets better here.";

bool any_active(const std::vector<Breakpoint>& points) {
  return std::ranges::any_of(points, [](const Breakpoint& p) { return p.enabled && p.predicate; });
}

unsigned polish_steps() {
  return PolishOptions().iterations;
}

}  // namespace

// A branch of a polish goes on with it; everywhere else the solver makes the steps.
PartKind Executor::kind_here() const {
  return s_.continues_branch() ? s_.timeline.current()->kind : PartKind::solver;
}

// A polish goes on with what is before it: ahead of the cursor it is not in the way of that.
void Executor::leave_polish_ahead() {
  Cursor& cursor = s_.timeline.cursor;
  while (const Branch* branch = s_.timeline.current()) {
    if (branch->kind != PartKind::polish || cursor.iteration >= branch->start || !branch->parent) return;
    cursor.branch = *branch->parent;
  }
}

// Whether nothing is left to polish here.
bool Executor::is_polished() const {
  const Branch* branch = s_.timeline.current();
  return kind_here() == PartKind::polish && branch->result && has_converged(*branch->result) &&
         s_.timeline.cursor.iteration == branch->tip();
}

void Executor::operator()(const Run& command) {
  s_.then_polish_ = false;
  if (s_.task == Task::move) return start_motion(command.steps);
  leave_polish_ahead();
  if (is_polished()) return say(MessageKind::info, kPolished);
  s_.then_polish_ = s_.smoothing.polish != Polish::none;
  const Branch* branch = s_.timeline.current();
  const bool is_done = s_.continues_branch() && branch->result && has_converged(*branch->result) &&
                       s_.timeline.cursor.iteration == branch->tip();
  if (is_done && s_.then_polish_) return start_polish();
  const unsigned all = kind_here() == PartKind::polish ? polish_steps() : s_.smoothing.iterations;
  start_run(s_.remaining > 0 ? s_.remaining : all, kind_here());
}

void Executor::operator()(const Step& /*command*/) {
  s_.then_polish_ = false;
  if (s_.task == Task::move) return start_motion(1);
  // Where the present run has ended, those beside it go on.
  const unsigned shared = s_.shared_iteration();
  if (shared > s_.timeline.cursor.iteration && shared < s_.shared_last())
    return (*this)(Seek{shared + 1, {}});
  leave_polish_ahead();
  if (is_polished()) return say(MessageKind::info, kPolished);
  start_run(1, kind_here());
}

// Over the one that is recorded, if there is one, and from its end on.
void Executor::start_polish() {
  s_.then_polish_ = false;
  const Timeline& timeline = s_.timeline;
  const Cursor at = timeline.cursor;
  const auto known = std::ranges::find_if(timeline.branches, [&](const Branch& b) {
    return b.kind == PartKind::polish && b.parent == at.branch && b.start == at.iteration &&
           same_steps(b, s_.smoothing);
  });
  if (known != timeline.branches.end())
    s_.timeline.cursor.branch = static_cast<unsigned>(known - timeline.branches.begin());
  start_run(polish_steps(), PartKind::polish);
}

// After the steps of a solver, if that was asked for.
void Executor::polish_when_idle(PartKind after) {
  if (!std::exchange(s_.then_polish_, false) || after == PartKind::polish) return;
  s_.when_idle_.push_front([](Session& s) { Executor(s).start_polish(); });
}

void Executor::start_run(unsigned iterations, PartKind kind) {
  if (!s_.current) {
    say(MessageKind::info, s_.engine.busy() ? "The mesh is not there yet." : "Open a mesh first.");
    return;
  }
  if (s_.seeking_ && s_.activity == Activity::idle) {
    s_.when_idle_.push_back([iterations, kind](Session& s) { Executor(s).start_run(iterations, kind); });
    return;
  }
  if (s_.activity != Activity::idle || iterations == 0) return;
  if (refuses_to_smooth() || (kind == kind_here() && run_over_recorded(iterations))) return;
  forget_motion_energy();
  prepare_run(iterations);
  const Place left = begin_branch(kind);
  // A new series starts where this one will: the plots need its first point.
  if (s_.current->energy && !s_.current->energy->of_record &&
      (s_.history.empty() || s_.history.back().series != s_.series)) {
    const QualityReport& q = s_.current->quality();
    s_.history.push_back(
        {s_.current->iteration, s_.current->energy->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series});
  }
  s_.engine.post("run", run_job({s_.document, s_.smoothing, s_.current, iterations, s_.series,
                                 s_.timeline.current()->recording, left, s_.timeline.cursor.branch, kind,
                                 s_.breakpoints, s_.step_budget}));
}

// A smoother keeps to the mesh as opened; a surface that has moved is another one.
bool Executor::refuses_to_smooth() {
  const Branch* branch = s_.moving();
  if (branch == nullptr || s_.timeline.cursor.iteration == branch->start) return false;
  say(MessageKind::info,
      "Smoothing keeps to the mesh as opened, which this surface has left: go to its start, or save this "
      "state and open it.",
      Topic::refusal);
  return true;
}

// At its start a moving surface is a mesh like any other, but for how it was measured.
void Executor::forget_motion_energy() {
  if (s_.moving() == nullptr) return;
  auto plain = std::make_shared<MeshState>(*s_.current);
  plain->energy.reset();
  s_.current = s_.current->geometry == s_.original->geometry ? s_.original : plain;
}

void Executor::prepare_run(unsigned iterations) {
  s_.run_start_ = s_.current;
  s_.rows_at_start_ = s_.history;
  s_.cursor_at_start_ = s_.timeline.cursor;
  s_.run_iterations_ = iterations;
  s_.last_run.reset();
  s_.broken_by.clear();
  s_.inspection = {};
  s_.beside_at_ = 0;
  s_.timeline.cursor.stage.reset();
  s_.activity = Activity::running;
}

// What is recorded already need not be done again: to its end, or to the first breakpoint in it.
bool Executor::run_over_recorded(unsigned iterations) {
  if (!s_.continues_branch()) return false;
  const unsigned at = s_.timeline.cursor.branch;
  const Branch& branch = s_.timeline.branches[at];
  const unsigned from = s_.timeline.cursor.iteration;
  if (from >= branch.tip()) return false;
  const unsigned to = std::min(from + iterations, branch.tip());
  const unsigned rest = from + iterations - to;
  const bool ended = branch.result && to == branch.tip() && has_converged(*branch.result);
  const bool goes_on = rest > 0 && !ended && !branch.from_file;
  const auto go_on = [rest, kind = branch.kind](Session& s) { Executor(s).start_run(rest, kind); };
  if (any_active(s_.breakpoints)) {
    s_.activity = Activity::running;
    s_.broken_by.clear();
    s_.engine.post("run", scan_job({s_.document,
                                    branch.settings,
                                    branch.recording,
                                    branch.start,
                                    {at, from, to, s_.breakpoints, !goes_on}}));
    s_.after_scan_ = nullptr;
    if (goes_on)
      s_.after_scan_ = go_on;
    else
      s_.after_scan_ = [result = ended ? branch.result : std::nullopt, kind = branch.kind](Session& s) {
        Executor(s).keep_result(result);
        Executor(s).polish_when_idle(kind);
      };
    s_.scan_to_ = to;
    return true;
  }
  seek(at, to);
  if (ended) keep_result(branch.result);
  if (goes_on)
    s_.when_idle_.push_back(go_on);
  else
    polish_when_idle(branch.kind);
  return true;
}

void Executor::operator()(Scanned& event) {
  s_.activity = Activity::idle;
  s_.run_start_.reset();
  keep_hits(event.hits);
  s_.broken_by = event.broken_by;
  seek(s_.timeline.cursor.branch, event.stop.value_or(s_.scan_to_));
  if (!event.broken_by.empty())
    say(MessageKind::info, "Stopped at iteration " + std::to_string(*event.stop) + ": " + event.broken_by);
  auto then = std::exchange(s_.after_scan_, nullptr);
  if (event.stop) s_.then_polish_ = false;
  if (!event.stop && then) s_.when_idle_.push_back(std::move(then));
}

// Runs go on with the present branch at its end; everywhere else, or with other settings, they begin one.
// Tells where that leaves another.
Place Executor::begin_branch(PartKind kind) {
  Timeline& timeline = s_.timeline;
  if (s_.continues_branch() && timeline.current()->kind == kind) return {};
  Branch branch;
  branch.kind = kind;
  branch.settings = s_.smoothing;
  branch.start = timeline.cursor.iteration;
  branch.parent = branch_shown_at_start();
  // It leaves the run that made the steps up to here, of which the one that is shown may know only the start.
  branch.name = branch_name(
      s_.smoothing, kind,
      branch.parent ? &timeline.branches[timeline.holder(*branch.parent, branch.start)] : nullptr);
  branch.recording = std::make_shared<Recording>();
  if (s_.current->energy && s_.current->energy->of_record) ++s_.series;  // these settings measure another one
  if (s_.current->energy && !s_.current->energy->of_record &&
      same_energy(s_.current->energy->settings, s_.smoothing)) {
    const QualityReport& q = s_.current->quality();
    branch.rows.push_back(
        {s_.current->iteration, s_.current->energy->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series});
  }
  std::erase_if(s_.history, [&](const IterationRow& row) { return row.iteration > branch.start; });
  timeline.cursor.branch = static_cast<unsigned>(timeline.branches.size());
  Place left = branch.parent ? place_of(*branch.parent, branch.start) : Place();
  timeline.branches.push_back(std::move(branch));
  return left;
}

/// The branch that holds the shown iteration, where a moving surface begins the one that led to it.
std::optional<unsigned> Executor::branch_shown_at_start() const {
  const Timeline& timeline = s_.timeline;
  if (timeline.empty()) return std::nullopt;
  std::optional<unsigned> at = timeline.cursor.branch;
  while (at && timeline.branches[*at].motion && timeline.cursor.iteration <= timeline.branches[*at].start)
    at = timeline.branches[*at].parent;
  return at;
}

void Executor::drop_empty_branch() {
  Timeline& timeline = s_.timeline;
  if (timeline.empty() || !timeline.branches.back().steps.empty()) return;
  const unsigned dropped = static_cast<unsigned>(timeline.branches.size()) - 1;
  if (timeline.cursor.branch == dropped) timeline.cursor.branch = timeline.branches.back().parent.value_or(0);
  std::erase(s_.shown_branches, dropped);
  if (timeline.branches.back().motion) {  // its first step failed: as if it had not begun
    s_.history = s_.rows_at_start_;
    if (s_.run_start_) s_.current = s_.run_start_;
  }
  timeline.branches.pop_back();
}

void Executor::keep_result(const std::optional<RunResult>& result) {
  s_.last_run = result;
  s_.last_run_number = s_.message_count_;
}

void Executor::operator()(RunEnded& event) {
  const bool cancelled = event.result.stopped == StopReason::cancelled;
  s_.remaining = cancelled && event.result.iterations < s_.run_iterations_
                     ? s_.run_iterations_ - event.result.iterations
                     : 0;
  keep_result(event.result);
  s_.broken_by = event.broken_by;
  if (event.held) s_.last_step = event.held;
  if (!s_.timeline.empty()) {
    Branch& branch = s_.timeline.branches[s_.timeline.cursor.branch];
    branch.result = event.result;
    branch.ended = event.broken_by.empty() ? std::string(to_string(event.result.stopped)) : event.broken_by;
    if (!cancelled && event.broken_by.empty() && event.result.stopped != StopReason::fixed)
      polish_when_idle(branch.kind);
  }
  s_.then_polish_ = false;
  end_run();
  s_.surface_is_news_ = true;
  measure_surface();
}

// One method after the other from the same iteration; then all of them side by side.
void Executor::operator()(const Teach& /*command*/) {
  if (!s_.can_smooth() || refuses_to_smooth()) return;
  const RunsChange::View before = view_of_runs();
  turn_to(Task::smooth);
  const Cursor from = s_.timeline.cursor;
  const SmoothingSettings settings = s_.smoothing;
  s_.then_polish_ = false;
  s_.taught_.clear();
  s_.teaching_ = true;
  s_.before_teaching_ = before;
  s_.runs_before_teaching_ = s_.timeline.branches.size();
  for (const Method method : {Method::laplacian, Method::angle_based, Method::near_isometry}) {
    s_.when_idle_.push_back([from](Session& s) {
      if (!s.timeline.empty()) Executor(s).seek(from.branch, from.iteration);
    });
    s_.when_idle_.push_back([settings, method](Session& s) {
      s.smoothing = settings;
      s.smoothing.method = method;
      Executor(s).start_run(settings.iterations, PartKind::solver);
    });
    s_.when_idle_.push_back([](Session& s) { s.taught_.push_back(s.timeline.cursor); });
  }
  s_.when_idle_.push_back([](Session& s) {
    s.teaching_ = false;
    std::vector<unsigned> beside;
    for (const Cursor& cursor : s.taught_)
      if (cursor.branch != s.timeline.cursor.branch) beside.push_back(cursor.branch);
    execute(s, ShowBranches{beside});
    Executor(s).note_teaching();
  });
  go_on_when_idle();
}

}  // namespace isorelax::model
