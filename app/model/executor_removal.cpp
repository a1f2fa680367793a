#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "model/executor.h"

// Runs that come to the timeline together and go from it: each change is one entry for Undo, which keeps the
// runs while they are not there.

namespace isorelax::model {

namespace {

/// Whether a branch began at a step of another one: without that it has no beginning. Where that one began
/// itself, it might as well have left the same as that did.
bool needs(const Timeline& timeline, const Branch& branch, unsigned other) {
  return branch.parent == other && branch.start > timeline.branches[other].start;
}

}  // namespace

std::string why_kept(const Session& session, unsigned run) {
  const Timeline& timeline = session.timeline;
  if (session.activity != Activity::idle || session.is_seeking()) return "Something is still being done.";
  for (unsigned k = 0; k < timeline.branches.size(); ++k)
    if (needs(timeline, timeline.branches[k], run))
      return "Run " + timeline.numbered_name(k) + " began in it: remove that first.";
  return {};
}

RunsChange::View Executor::view_of_runs() const {
  return {s_.timeline.cursor, s_.shown_branches, s_.smoothing, s_.task};
}

void Executor::put_run(RunsChange::Run& run) {
  const unsigned at = run.at;
  auto& branches = s_.timeline.branches;
  const auto shift = [at](unsigned& other) { other += other >= at ? 1 : 0; };
  for (Branch& other : branches)
    if (other.parent) shift(*other.parent);
  for (BreakHit& hit : s_.hits) shift(hit.branch);
  branches.insert(branches.begin() + at, std::exchange(run.branch, {}));
  for (unsigned left : std::exchange(run.left, {})) {
    shift(left);
    branches[left].parent = at;
  }
}

void Executor::take_run(RunsChange::Run& run) {
  const unsigned at = run.at;
  auto& branches = s_.timeline.branches;
  run.branch = std::move(branches[at]);
  branches.erase(branches.begin() + at);
  const auto shift = [at](unsigned& other) { other -= other > at ? 1 : 0; };
  for (unsigned k = 0; k < branches.size(); ++k) {
    if (!branches[k].parent) continue;
    if (branches[k].parent == at) {
      branches[k].parent = run.branch.parent;
      run.left.push_back(k);
    } else {
      shift(*branches[k].parent);
    }
  }
  std::erase_if(s_.hits, [at](const BreakHit& hit) { return hit.branch == at; });
  for (BreakHit& hit : s_.hits) shift(hit.branch);
}

// Runs that were undone since, but are still on the timeline, go with those that they began in.
void Executor::add_dependent(std::vector<RunsChange::Run>& runs) const {
  const Timeline& timeline = s_.timeline;
  const auto holds = [&](unsigned k) {
    return std::ranges::find(runs, k, &RunsChange::Run::at) != runs.end();
  };
  for (unsigned k = 0; k < timeline.branches.size(); ++k) {
    const Branch& branch = timeline.branches[k];
    if (branch.parent && !holds(k) && holds(*branch.parent) && needs(timeline, branch, *branch.parent))
      runs.push_back({k});
  }
  std::ranges::sort(runs, {}, &RunsChange::Run::at);
}

// Without any run that is the mesh as opened.
void Executor::show_runs(const RunsChange::View& view) {
  s_.shown_branches = view.beside;
  s_.other_states.clear();
  s_.smoothing = view.settings;
  s_.task = view.task;
  s_.timeline.cursor = {view.cursor.branch, view.cursor.iteration, {}};
  s_.inspection = {};
  s_.comparison.reset();
  s_.last_step.reset();
  s_.last_run.reset();
  s_.remaining = 0;
  if (!s_.timeline.empty()) return seek(view.cursor.branch, view.cursor.iteration);
  s_.history.clear();
  if (s_.original->energy) {
    const QualityReport& q = s_.original->quality();
    s_.history.push_back({0, s_.original->energy->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series});
  }
  show(s_.original);
  measure_energy_if_changed();
  ask_about_step();
}

void Executor::apply(RunsChange& change, bool forward) {
  if (forward == change.came) {
    for (RunsChange::Run& run : change.runs) put_run(run);
  } else {
    add_dependent(change.runs);
    std::for_each(change.runs.rbegin(), change.runs.rend(), [&](RunsChange::Run& run) { take_run(run); });
  }
  show_runs(forward ? change.after : change.before);
}

// One entry for all runs of a comparison of methods, however far it came.
void Executor::note_teaching() {
  const auto before = std::exchange(s_.before_teaching_, std::nullopt);
  if (!before) return;
  RunsChange change{{}, true, *before, view_of_runs()};
  for (std::size_t k = s_.runs_before_teaching_; k < s_.timeline.branches.size(); ++k)
    change.runs.push_back({static_cast<unsigned>(k)});
  if (change.runs.empty() && before->cursor == change.after.cursor && before->beside == change.after.beside)
    return;
  s_.undo.push({"the three methods compared", std::move(change)});
}

void Executor::operator()(const RemoveRun& command) {
  if (command.branch >= s_.timeline.branches.size()) return;
  if (const std::string reason = why_kept(s_, command.branch); !reason.empty())
    return say(MessageKind::info, reason, Topic::refusal);
  const unsigned gone = command.branch;
  RunsChange change{{{gone}}, false, view_of_runs(), view_of_runs()};
  RunsChange::View& after = change.after;
  const Branch& branch = s_.timeline.branches[gone];
  std::string label = "run " + s_.timeline.numbered_name(gone) + " removed";
  if (after.cursor.branch == gone) {
    // Where it began, or else the first of the others.
    after.cursor.branch = branch.parent.value_or(gone == 0 ? 1 : 0);
    after.cursor.iteration = branch.parent ? branch.start : 0;
  }
  std::erase(after.beside, gone);
  std::erase(after.beside, after.cursor.branch);
  const auto shift = [gone](unsigned& run) { run -= run > gone ? 1 : 0; };
  shift(after.cursor.branch);
  for (unsigned& run : after.beside) shift(run);
  take_run(change.runs.front());
  show_runs(after);
  s_.undo.push({std::move(label), std::move(change)});
}

}  // namespace isorelax::model
