#include <algorithm>
#include <utility>

#include "model/executor.h"
#include "model/jobs.h"

namespace isorelax::model {
namespace {

constexpr std::size_t kHitsKept = 1000;
constexpr std::size_t kMostBeside = 3;
constexpr const char* kPolished = "The polish has ended: nothing gets better here.";
constexpr const char* kNoStages = "Steps of a moving surface have no stages.";

bool any_active(const std::vector<Breakpoint>& points) {
  return std::ranges::any_of(points, [](const Breakpoint& p) { return p.enabled && p.predicate; });
}

MeshStatePtr with_geometry(const MeshStatePtr& state, std::shared_ptr<const Geometry> geometry) {
  auto changed = std::make_shared<MeshState>(*state);
  changed->geometry = std::move(geometry);
  return changed;
}

bool has_converged(const RunResult& result) {
  return result.stopped != StopReason::iterations && result.stopped != StopReason::cancelled;
}

unsigned polish_steps() {
  return PolishOptions().iterations;
}

}  // namespace

bool Session::continues_branch() const {
  const Branch* branch = timeline.current();
  if (branch == nullptr || branch->motion.has_value() != (task == Task::move)) return false;
  if (branch->motion)
    return same_motion(*branch->motion, motion) && timeline.cursor.iteration >= branch->start;
  return branch->not_redone.empty() && same_steps(branch->settings, smoothing) &&
         (branch->kind == PartKind::solver || branch->settings.polish == smoothing.polish) &&
         timeline.cursor.iteration >= branch->start &&
         (!branch->from_file || timeline.cursor.iteration < branch->tip());
}

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
           same_steps(b.settings, s_.smoothing) && b.settings.polish == s_.smoothing.polish;
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

void Executor::go_on_when_idle() {
  while (!s_.when_idle_.empty() && s_.activity == Activity::idle && !s_.seeking_) {
    const auto next = std::move(s_.when_idle_.front());
    s_.when_idle_.pop_front();
    next(s_);
  }
}

Place Executor::place_of(unsigned branch, unsigned iteration) const {
  if (s_.timeline.empty()) return {};
  const Branch& held = s_.timeline.branches[s_.timeline.holder(branch, iteration)];
  return {held.recording, iteration - held.start, held.not_redone};
}

Place Executor::place_shown() const {
  return place_of(s_.timeline.cursor.branch, s_.timeline.cursor.iteration);
}

Path Executor::path_of(unsigned branch, unsigned last) const {
  Path path;
  if (s_.timeline.empty()) return path;
  for (unsigned b = branch, end = last;;) {
    const Branch& held = s_.timeline.branches[b];
    if (end >= held.start) {
      path.insert(path.begin(), {held.recording, end - held.start, held.not_redone});
      end = held.start;
    }
    if (!held.parent) break;
    b = *held.parent;
  }
  return path;
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
    s_.engine.post(
        "run",
        scan_job(
            {s_.document, branch.settings, branch.recording, branch.start, {at, from, to, s_.breakpoints}}));
    s_.after_scan_ = nullptr;
    if (goes_on)
      s_.after_scan_ = go_on;
    else
      s_.after_scan_ = [result = ended ? branch.result : std::nullopt, kind = branch.kind](Session& s) {
        s.last_run = result;
        Executor(s).polish_when_idle(kind);
      };
    s_.scan_to_ = to;
    return true;
  }
  seek(at, to);
  if (ended) s_.last_run = branch.result;
  if (goes_on)
    s_.when_idle_.push_back(go_on);
  else
    polish_when_idle(branch.kind);
  return true;
}

void Executor::operator()(Scanned& event) {
  s_.activity = Activity::idle;
  s_.run_start_.reset();
  for (BreakHit& hit : event.hits) s_.hits.push_back(std::move(hit));
  while (s_.hits.size() > kHitsKept) s_.hits.pop_front();
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
  branch.name = branch_name(s_.smoothing, kind, branch.parent ? &timeline.branches[*branch.parent] : nullptr);
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

void Executor::seek(unsigned branch, unsigned iteration) {
  Timeline& timeline = s_.timeline;
  timeline.cursor.branch = branch;
  timeline.cursor.iteration = iteration;
  s_.last_run.reset();
  s_.remaining = 0;
  if (!timeline.empty()) s_.history = timeline.rows(branch);
  s_.seeking_ = true;
  s_.seek_number_ = ++s_.request_count_;
  SeekRequest request{s_.seek_number_, s_.document, s_.smoothing, place_of(branch, iteration), iteration, {}};
  for (const unsigned other : s_.shown_branches)
    request.others.push_back(place_of(other, iteration_beside(other)));
  s_.engine.post("seek", seek_job(std::move(request)));
}

void Executor::operator()(const Seek& command) {
  if (!s_.current) return;
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  if (s_.activity != Activity::idle || s_.timeline.empty()) return;
  const Timeline& timeline = s_.timeline;
  const unsigned branch = std::min(command.branch.value_or(timeline.cursor.branch),
                                   static_cast<unsigned>(timeline.branches.size()) - 1);
  const unsigned iteration = std::min(command.iteration, timeline.branches[branch].tip());
  if (branch == timeline.cursor.branch && iteration == timeline.cursor.iteration && !s_.seeking_) return;
  // Another branch brings its settings: Run goes on with it.
  if (branch != timeline.cursor.branch) {
    const auto& motion = timeline.branches[branch].motion;
    s_.task = motion ? Task::move : Task::smooth;
    if (motion) s_.motion = *motion;
    SmoothingSettings settings = timeline.branches[branch].settings;
    settings.iterations = s_.smoothing.iterations;
    s_.smoothing = settings;
  }
  seek(branch, iteration);
}

void Executor::operator()(Sought& event) {
  if (event.number == s_.seek_number_) s_.seeking_ = false;
  // With the iteration shown already or a document opened since, it comes too late.
  if (event.state->positions().size() != s_.original->positions().size()) return;
  if (s_.timeline.cursor.iteration == 0 && event.state->iteration == 0 &&
      std::ranges::equal(event.state->positions(), s_.original->positions()))
    show(s_.moving() != nullptr ? with_geometry(event.state, s_.original->geometry) : s_.original);
  else
    show(event.state);
  s_.other_states = std::move(event.others);
  const StepSummary* step = s_.timeline.step(s_.timeline.cursor.branch, event.state->iteration);
  s_.last_step = step != nullptr ? std::optional(*step) : std::nullopt;
  if (s_.seeking_) return;
  measure_energy_if_changed();
  ask_about_step();
  go_on_when_idle();
}

void Executor::operator()(const SetStage& command) {
  if (!s_.current) return;
  if (command.stage && s_.moving() != nullptr) {
    say(MessageKind::info, kNoStages);
    return;
  }
  s_.timeline.cursor.stage = command.stage;
  ask_about_step();
}

void Executor::operator()(const StepStage& command) {
  if (!s_.current || s_.is_running()) return;
  if (s_.moving() != nullptr) {
    say(MessageKind::info, kNoStages);
    return;
  }
  Cursor& cursor = s_.timeline.cursor;
  const StepSummary* step = s_.timeline.step(cursor.branch, cursor.iteration);
  std::vector<Stage> stages = stages_of(step != nullptr ? step->fold_passes + step->energy_passes : 0);
  const bool forward = command.direction > 0;
  if (!cursor.stage) {
    cursor.stage = forward || cursor.iteration == 0 ? stages.front() : stages.back();
    ask_about_step();
    return;
  }
  const auto found = std::ranges::find(stages, *cursor.stage);
  const auto index = found == stages.end() ? 0 : found - stages.begin();
  const auto next = index + (forward ? 1 : -1);
  if (next >= 0 && next < static_cast<std::ptrdiff_t>(stages.size())) {
    cursor.stage = stages[static_cast<std::size_t>(next)];
    ask_about_step();
    return;
  }
  // Over the end of the step, as far as there are others.
  if (forward ? cursor.iteration >= s_.timeline.last() : cursor.iteration <= 1) return;
  const unsigned iteration = forward ? cursor.iteration + 1 : cursor.iteration - 1;
  cursor.stage = forward ? stages.front() : Stage{StageKind::moved};
  seek(cursor.branch, iteration);
}

// Asks the worker for the record of the shown step, and for what is selected in it.
void Executor::ask_about_step() {
  if (s_.moving() != nullptr) return ask_about_motion();
  const bool wanted =
      s_.selected_vertex || s_.selected_triangle || s_.timeline.cursor.stage || s_.view.reasons;
  if (!s_.current || s_.is_running() || s_.seeking_ || !wanted) return;
  s_.inspect_number_ = ++s_.request_count_;
  const Cursor& cursor = s_.timeline.cursor;
  InspectRequest request{
      s_.inspect_number_,       s_.document,   s_.smoothing, {}, s_.selected_vertex, s_.selected_triangle,
      cursor.stage.has_value(), s_.step_budget};
  const unsigned iteration = std::max(1U, cursor.iteration);
  if (!s_.timeline.empty() && iteration <= s_.timeline.last()) {
    // The holder of an iteration at which a branch begins is the branch; its step is the parent's.
    unsigned holder = cursor.branch;
    while (s_.timeline.branches[holder].start >= iteration && s_.timeline.branches[holder].parent)
      holder = *s_.timeline.branches[holder].parent;
    const Branch& branch = s_.timeline.branches[holder];
    request.settings = branch.settings;
    if (!branch.not_redone.empty()) {  // the inspector says why
      s_.inspection = {};
      return;
    }
    request.place = {branch.recording, iteration - branch.start, {}};
  }
  s_.engine.post("inspect", inspect_job(std::move(request)));
}

void Executor::operator()(Inspected& event) {
  s_.step_memory = event.memory;
  if (event.number != s_.inspect_number_ || s_.seeking_ || s_.is_running()) return;
  Inspection& inspection = s_.inspection;
  inspection.step = StepView{s_.timeline.cursor,        std::move(event.record),
                             std::move(event.before),   std::move(event.before_state),
                             std::move(event.mismatch), std::move(event.made_with)};
  inspection.vertex = std::move(event.vertex);
  inspection.triangle = std::move(event.triangle);
  inspection.check = event.check;
  follow_selection();
}

void Executor::follow_selection() {
  if (!s_.selected_vertex || s_.timeline.empty() || s_.is_running() || s_.moving() != nullptr) return;
  const unsigned branch = s_.timeline.cursor.branch;
  const unsigned last = s_.timeline.last();
  const auto& path = s_.inspection.path;
  if (path && path->branch == branch && path->vertex == *s_.selected_vertex &&
      path->positions.size() == last + 1)
    return;
  s_.engine.post("follow", follow_job({branch, *s_.selected_vertex, path_of(branch, last)}));
}

void Executor::operator()(Followed& event) {
  if (s_.selected_vertex != event.vertex || s_.timeline.cursor.branch != event.branch) return;
  s_.inspection.path = VertexPath{event.branch, event.vertex, std::move(event.positions)};
}

void Executor::operator()(const SetBreakpoints& command) {
  s_.breakpoints = command.breakpoints;
}

void Executor::operator()(const SetStepBudget& command) {
  s_.step_budget = command.bytes;
  s_.engine.post("budget", [bytes = command.bytes](const JobContext& context) {
    context.bench().steps().set_budget(bytes);
  });
}

void Executor::operator()(const ShowBranches& command) {
  s_.shown_branches.clear();
  for (const unsigned branch : command.branches)
    if (branch < s_.timeline.branches.size() && s_.shown_branches.size() < kMostBeside)
      s_.shown_branches.push_back(branch);
  s_.other_states.clear();
  if (!s_.timeline.empty() && !s_.is_running() && s_.current)
    seek(s_.timeline.cursor.branch, s_.timeline.cursor.iteration);
}

// One method after the other from the same iteration; then all of them side by side.
void Executor::operator()(const Teach& /*command*/) {
  if (!s_.can_smooth() || refuses_to_smooth()) return;
  turn_to(Task::smooth);
  const Cursor from = s_.timeline.cursor;
  const SmoothingSettings settings = s_.smoothing;
  s_.then_polish_ = false;
  s_.taught_.clear();
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
    std::vector<unsigned> beside;
    for (const Cursor& cursor : s.taught_)
      if (cursor.branch != s.timeline.cursor.branch) beside.push_back(cursor.branch);
    execute(s, ShowBranches{beside});
  });
  go_on_when_idle();
}

void Executor::forget_runs() {
  s_.timeline = {};
  s_.inspection = {};
  s_.hits.clear();
  s_.step_memory = {};
  s_.shown_branches.clear();
  s_.other_states.clear();
  s_.comparison.reset();
  s_.selected_limit.reset();
  s_.broken_by.clear();
  s_.seeking_ = false;
  s_.smoothing.pinned.clear();
}

}  // namespace isorelax::model
