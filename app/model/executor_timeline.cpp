#include <algorithm>
#include <utility>

#include "model/executor.h"
#include "model/jobs.h"

namespace isorelax::model {
namespace {

constexpr std::size_t kMostBeside = 3;
/// Triangles up to which the distance from the original is measured wherever one goes.
constexpr Index kMostMeasuredOnTheWay = 20000;
constexpr const char* kNoStages = "Steps of a moving surface have no stages.";

MeshStatePtr with_geometry(const MeshStatePtr& state, std::shared_ptr<const Geometry> geometry) {
  auto changed = std::make_shared<MeshState>(*state);
  changed->geometry = std::move(geometry);
  return changed;
}

}  // namespace

bool Session::has_unsaved_changes() const {
  return current &&
         std::ranges::none_of(on_disk, [&](const auto& file) { return file.second == current->geometry; });
}

bool Session::is_saved_in(const std::filesystem::path& path) const {
  const auto file = on_disk.find(whole_name(path));
  return current && file != on_disk.end() && file->second == current->geometry;
}

bool Session::would_lose_work() const {
  return has_unsaved_changes() || timeline.made_steps() != kept_steps_;
}

bool Session::continues_branch() const {
  const Branch* branch = timeline.current();
  if (branch == nullptr || branch->motion.has_value() != (task == Task::move)) return false;
  if (branch->motion)
    return same_motion(*branch->motion, motion) && timeline.cursor.iteration >= branch->start;
  return branch->not_redone.empty() && same_steps(*branch, smoothing) &&
         timeline.cursor.iteration >= branch->start &&
         (!branch->from_file || timeline.cursor.iteration < branch->tip());
}

unsigned Session::shared_iteration() const {
  return shown_branches.empty() ? timeline.cursor.iteration : std::max(timeline.cursor.iteration, beside_at_);
}

unsigned Session::shared_last(unsigned branch) const {
  unsigned last = timeline.branches[branch].tip();
  if (timeline.branches[branch].motion) return last;  // those share the time
  const auto include = [&](unsigned other) {
    if (!timeline.branches[other].motion) last = std::max(last, timeline.branches[other].tip());
  };
  for (const unsigned other : shown_branches) {
    include(other);
    if (other == branch) include(timeline.cursor.branch);  // they change places
  }
  return last;
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

// A run that stood beside the present one changes places with it.
void Executor::seek(unsigned branch, unsigned iteration, unsigned beside_at) {
  Timeline& timeline = s_.timeline;
  if (branch == timeline.cursor.branch)
    std::erase(s_.shown_branches, branch);
  else
    std::ranges::replace(s_.shown_branches, branch, timeline.cursor.branch);
  s_.beside_at_ = std::max(iteration, beside_at);
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
  if (!s_.current || refuses_while_teaching()) return;
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  if (s_.activity != Activity::idle || s_.timeline.empty()) return;
  const Timeline& timeline = s_.timeline;
  const unsigned branch = std::min(command.branch.value_or(timeline.cursor.branch),
                                   static_cast<unsigned>(timeline.branches.size()) - 1);
  const unsigned shared = std::min(command.iteration, s_.shared_last(branch));
  const unsigned iteration = std::min(shared, timeline.branches[branch].tip());
  if (branch == timeline.cursor.branch && iteration == timeline.cursor.iteration &&
      shared == s_.shared_iteration() && !s_.seeking_)
    return;
  // Another branch brings its settings: Run goes on with it.
  if (branch != timeline.cursor.branch) {
    const auto& motion = timeline.branches[branch].motion;
    s_.task = motion ? Task::move : Task::smooth;
    if (motion) s_.motion = *motion;
    SmoothingSettings settings = timeline.branches[branch].settings;
    settings.iterations = s_.smoothing.iterations;
    s_.smoothing = settings;
  }
  seek(branch, iteration, shared);
}

void Executor::operator()(Sought& event) {
  if (event.document != s_.document) return;
  if (event.number == s_.seek_number_) s_.seeking_ = false;
  if (s_.timeline.cursor.iteration == 0 && event.state->iteration == 0 &&
      std::ranges::equal(event.state->positions(), s_.original->positions()))
    show(s_.moving() != nullptr ? with_geometry(event.state, s_.original->geometry) : s_.original);
  else
    show(as_on_disk(event.state));
  s_.other_states = std::move(event.others);
  const StepSummary* step = s_.timeline.step(s_.timeline.cursor.branch, event.state->iteration);
  s_.last_step = step != nullptr ? std::optional(*step) : std::nullopt;
  if (s_.seeking_) return;
  measure_energy_if_changed();
  ask_about_step();
  s_.surface_is_news_ = false;
  s_.measure_surface_later_ = s_.moving() == nullptr && place_shown().not_redone.empty() &&
                              s_.document->mesh().triangle_count() <= kMostMeasuredOnTheWay &&
                              (!s_.surface || s_.surface->geometry != s_.current->geometry);
  go_on_when_idle();
}

// What a file holds is not told from it by where it came from.
MeshStatePtr Executor::as_on_disk(const MeshStatePtr& state) const {
  for (const auto& [file, geometry] : s_.on_disk)
    if (std::ranges::equal(state->positions(), geometry->positions)) return with_geometry(state, geometry);
  return state;
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
  s_.follow_number_ = ++s_.request_count_;
  s_.engine.post("follow",
                 follow_job({s_.follow_number_, branch, *s_.selected_vertex, path_of(branch, last)}));
}

void Executor::operator()(Followed& event) {
  if (event.number != s_.follow_number_ || s_.selected_vertex != event.vertex ||
      s_.timeline.cursor.branch != event.branch)
    return;
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
    if (branch < s_.timeline.branches.size() && branch != s_.timeline.cursor.branch &&
        s_.shown_branches.size() < kMostBeside &&
        std::ranges::find(s_.shown_branches, branch) == s_.shown_branches.end())
      s_.shown_branches.push_back(branch);
  s_.other_states.clear();
  if (!s_.timeline.empty() && !s_.is_running() && s_.current)
    seek(s_.timeline.cursor.branch, s_.timeline.cursor.iteration);
}

// Answers that are still to come about them are nobody's.
void Executor::forget_runs() {
  s_.seek_number_ = s_.inspect_number_ = s_.follow_number_ = ++s_.request_count_;
  s_.timeline = {};
  s_.before_teaching_.reset();
  s_.kept_steps_ = 0;
  s_.inspection = {};
  s_.hits.clear();
  s_.step_memory = {};
  s_.shown_branches.clear();
  s_.other_states.clear();
  s_.beside_at_ = 0;
  s_.comparison.reset();
  s_.selected_limit.reset();
  s_.broken_by.clear();
  s_.seeking_ = false;
  s_.smoothing.pinned.clear();
}

}  // namespace isorelax::model
