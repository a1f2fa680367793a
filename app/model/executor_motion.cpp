#include <algorithm>
#include <utility>

#include "model/executor.h"
#include "model/jobs.h"
#include "model/motion_jobs.h"

namespace isorelax::model {
namespace {

/// The step of a moving surface that led to its k-th moment, from 1.
StepPlace place_of_step(const Branch& branch, unsigned k) {
  const MotionEntry& before = branch.moments[k - 1];
  return {before.step, before.time, branch.moments[k].report.dt};
}

bool has_arrived(const Branch& branch) {
  return !branch.moments.empty() && branch.moments.back().time >= branch.until;
}

}  // namespace

const Branch* Session::moving() const {
  const Branch* branch = timeline.current();
  return branch != nullptr && branch->motion && timeline.cursor.iteration >= branch->start ? branch : nullptr;
}

const MotionEntry& Session::moment() const {
  static const MotionEntry kNothingYet;
  const Branch& branch = *moving();
  const unsigned k = timeline.cursor.iteration - branch.start;
  return k < branch.moments.size() ? branch.moments[k] : kNothingYet;
}

void Executor::turn_to(Task task) {
  if (s_.task == task || s_.is_running()) return;
  s_.task = task;
  s_.remaining = 0;
  if (task == Task::move && s_.view.coloring == Coloring::min_angle) {
    s_.view.coloring = Coloring::relative_area;
    s_.view.range_mode = RangeMode::run;
  }
}

void Executor::operator()(const SetTask& command) {
  turn_to(command.task);
}

void Executor::operator()(const SetMotion& command) {
  if (s_.is_running()) return;
  turn_to(Task::move);
  if (same_motion(command.motion, s_.motion)) {
    s_.motion = command.motion;  // what is kept of other motions may differ
    return;
  }
  s_.undo.push({command.label, MotionChange{s_.motion, command.motion}});
  s_.motion = command.motion;
}

void Executor::operator()(const OpenSphere& command) {
  drop_what_waits();
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  s_.engine.cancel();
  s_.activity = Activity::loading;
  s_.engine.post("load", sphere_job(command.sphere, s_.smoothing));
}

void Executor::operator()(const Move& command) {
  if (s_.is_running()) return;
  turn_to(Task::move);
  start_motion(command.steps);
}

void Executor::start_motion(unsigned steps) {
  const auto again = [steps](Session& s) { Executor(s).start_motion(steps); };
  if (!s_.current && s_.activity == Activity::idle) {  // as isorelax advect without a mesh
    (*this)(OpenSphere{});
    s_.when_idle_.emplace_back(again);
    return;
  }
  if (s_.seeking_ && s_.activity == Activity::idle) {
    s_.when_idle_.emplace_back(again);
    return;
  }
  if (!s_.current || s_.activity != Activity::idle || move_over_recorded(steps)) return;
  const bool goes_on = s_.continues_branch();
  const Branch* shown = s_.moving();
  if (goes_on && has_arrived(*shown)) {
    say(MessageKind::info, "It has arrived at its end, t = " + time_text(shown->until) +
                               ": set a later end, or go back to see it again.");
    return;
  }
  if (!goes_on && shown != nullptr && s_.timeline.cursor.iteration > shown->start) {
    // Another motion begins where this one began.
    seek(s_.timeline.cursor.branch, shown->start);
    s_.when_idle_.emplace_back(again);
    return;
  }
  prepare_run(steps);
  if (!goes_on) begin_motion();
  const Branch& branch = *s_.timeline.current();
  const bool as_made = s_.document->sphere && s_.current->geometry == s_.original->geometry;
  s_.engine.post("run",
                 motion_job({s_.document, *branch.motion, s_.smoothing, s_.current,
                             as_made ? s_.document->sphere : std::nullopt, steps, s_.series, branch.recording,
                             s_.timeline.cursor.branch, branch.start, s_.breakpoints}));
}

// What is recorded already need not be done again: to its end, or to the first breakpoint in it.
bool Executor::move_over_recorded(unsigned steps) {
  if (!s_.continues_branch()) return false;
  const unsigned at = s_.timeline.cursor.branch;
  const Branch& branch = s_.timeline.branches[at];
  const unsigned from = s_.timeline.cursor.iteration;
  if (from >= branch.tip()) return false;
  const unsigned to = steps == 0 ? branch.tip() : std::min(from + steps, branch.tip());
  std::function<void(Session&)> then;
  if (!has_arrived(branch) && (steps == 0 || from + steps > to))
    then = [rest = steps == 0 ? 0 : from + steps - to](Session& s) { Executor(s).start_motion(rest); };
  if (std::ranges::any_of(s_.breakpoints, [](const Breakpoint& p) { return p.enabled && p.predicate; })) {
    s_.activity = Activity::running;
    s_.broken_by.clear();
    std::vector<double> times;
    for (const MotionEntry& moment : branch.moments) times.push_back(moment.time);
    s_.engine.post(
        "run",
        motion_scan_job(
            {branch.recording, branch.start, std::move(times), {at, from, to, s_.breakpoints, !then}}));
    s_.after_scan_ = std::move(then);
    s_.scan_to_ = to;
    return true;
  }
  seek(at, to);
  if (then) s_.when_idle_.push_back(std::move(then));
  return true;
}

void Executor::begin_motion() {
  Timeline& timeline = s_.timeline;
  Branch branch;
  branch.motion = s_.motion;
  branch.settings = s_.smoothing;
  branch.until = end_time(s_.motion);
  branch.start = timeline.cursor.iteration;
  branch.parent = branch_shown_at_start();
  branch.name = branch_name(s_.motion);
  branch.recording = std::make_shared<Recording>();
  ++s_.series;  // its energy is measured against the motion's reference
  std::erase_if(s_.history, [&](const IterationRow& row) { return row.iteration > branch.start; });
  timeline.cursor.branch = static_cast<unsigned>(timeline.branches.size());
  timeline.branches.push_back(std::move(branch));
}

void Executor::operator()(Moved& event) {
  if (s_.timeline.empty()) return;
  Branch& branch = s_.timeline.branches[s_.timeline.cursor.branch];
  const bool first = branch.moments.empty();
  const auto unite = [first](ValueRange& range, const ValueRange& other) {
    if (!(other.low <= other.high)) return;
    range = first ? other : ValueRange{std::min(range.low, other.low), std::max(range.high, other.high)};
  };
  unite(branch.areas, event.areas);
  unite(branch.energies, event.energies);
  branch.box.extend(event.box);
  s_.history.insert(s_.history.end(), event.rows.begin(), event.rows.end());
  branch.rows.insert(branch.rows.end(), event.rows.begin(), event.rows.end());
  branch.steps.insert(branch.steps.end(), event.steps.begin(), event.steps.end());
  branch.moments.insert(branch.moments.end(), std::make_move_iterator(event.moments.begin()),
                        std::make_move_iterator(event.moments.end()));
  keep_hits(event.hits);
  s_.last_step.reset();
  if (!event.state) return;
  show(event.state);
  s_.timeline.cursor.iteration = event.state->iteration;
}

void Executor::operator()(MotionEnded& event) {
  s_.broken_by = event.broken_by;
  if (!s_.timeline.empty()) {
    Branch& branch = s_.timeline.branches[s_.timeline.cursor.branch];
    const std::string at = "t = " + time_text(branch.moments.empty() ? 0 : branch.moments.back().time);
    if (!event.broken_by.empty())
      branch.ended = "Stopped at " + at + ", where " + event.broken_by;
    else if (event.cancelled)
      branch.ended = "Paused at " + at;
    else if (has_arrived(branch))
      branch.ended = "Arrived at " + at + " after " + std::to_string(branch.moments.back().step) +
                     (branch.moments.back().step == 1 ? " step" : " steps");
    else
      branch.ended = at;
    if (branch.ended != at) say(MessageKind::info, branch.ended);
  }
  end_run();
}

void Executor::ask_about_motion() {
  const bool wanted = s_.selected_vertex || s_.selected_triangle;
  if (!s_.current || s_.is_running() || s_.seeking_ || !wanted) return;
  const Branch& branch = *s_.moving();
  MotionInspectRequest request{++s_.request_count_,
                               s_.document,
                               branch.recording,
                               s_.timeline.cursor.iteration - branch.start,
                               {},
                               s_.selected_vertex,
                               s_.selected_triangle};
  if (request.step >= branch.moments.size()) return;
  if (request.step > 0) request.place = place_of_step(branch, request.step);
  s_.inspect_number_ = request.number;
  s_.engine.post("inspect", motion_inspect_job(std::move(request)));
}

void Executor::operator()(MotionInspected& event) {
  const Branch* branch = s_.moving();
  if (event.number != s_.inspect_number_ || s_.seeking_ || branch == nullptr) return;
  Inspection& inspection = s_.inspection;
  inspection.step.reset();
  inspection.vertex.reset();
  inspection.triangle.reset();
  inspection.check.reset();
  inspection.moving_vertex = event.vertex;
  inspection.moving_triangle = std::move(event.triangle);
  inspection.unknown = std::move(event.unknown);
  if (!s_.selected_vertex) return;
  const auto& path = inspection.moving_path;
  if (path && path->branch == s_.timeline.cursor.branch && path->vertex == *s_.selected_vertex &&
      path->distance.size() == branch->moments.size())
    return;
  s_.follow_number_ = ++s_.request_count_;
  MotionFollowRequest request{
      s_.follow_number_, s_.timeline.cursor.branch, *s_.selected_vertex, branch->recording, {}};
  for (unsigned k = 1; k < branch->moments.size(); ++k) request.places.push_back(place_of_step(*branch, k));
  s_.engine.post("follow", motion_follow_job(std::move(request)));
}

void Executor::operator()(MovingPath& event) {
  if (event.number != s_.follow_number_ || s_.selected_vertex != event.vertex ||
      s_.timeline.cursor.branch != event.branch)
    return;
  s_.inspection.moving_path = std::move(event);
}

// Moving surfaces stand side by side at the same time, other runs at the same iteration or where they ended.
unsigned Executor::iteration_beside(unsigned branch) const {
  const Branch& other = s_.timeline.branches[branch];
  const Branch* shown = s_.moving();
  if (shown == nullptr || !other.motion || other.moments.empty())
    return std::min(s_.shared_iteration(), other.tip());
  const double time = s_.moment().time;
  const auto nearest = std::ranges::min_element(
      other.moments, {}, [&](const MotionEntry& moment) { return std::abs(moment.time - time); });
  return other.start + static_cast<unsigned>(nearest - other.moments.begin());
}

}  // namespace isorelax::model
