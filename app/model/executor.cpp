#include "model/executor.h"
#include "smoothing/pins.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "model/jobs.h"

namespace isorelax::model {
namespace {

constexpr std::size_t kMessagesKept = 100;
constexpr std::size_t kHitsKept = 1000;
constexpr std::size_t kRecentKept = 12;
/// Triangles up to which the distance from the original is measured after every run.
constexpr Index kMostMeasured = 200000;

std::string count_label(unsigned count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

ValueRange united(const ValueRange& a, const ValueRange& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

constexpr std::array kMeasured{Coloring::min_angle, Coloring::max_angle, Coloring::relative_area,
                               Coloring::energy};

}  // namespace

void Executor::say(MessageKind kind, std::string text, Topic topic) {
  s_.messages.push_back({kind, std::move(text), topic, ++s_.message_count_});
  if (s_.messages.size() > kMessagesKept) s_.messages.pop_front();
}

// The newest of all.
void Executor::keep_hits(std::vector<BreakHit>& hits) {
  for (BreakHit& hit : hits) s_.hits.push_back(std::move(hit));
  while (s_.hits.size() > kHitsKept) s_.hits.pop_front();
}

bool Executor::wait_for_run(std::function<void(Session&)> then) {
  if (!s_.is_running()) return false;
  if (refuses_while_teaching()) return true;
  s_.then_polish_ = false;
  s_.when_idle_.push_back(std::move(then));
  s_.engine.cancel();
  return true;
}

// What was to be done once a run or a search has ended.
void Executor::drop_what_waits() {
  s_.when_idle_.clear();
  s_.teaching_ = false;
  if (!s_.is_running()) note_teaching();
}

// What would cut a method short, or put the next one elsewhere, waits for the user to say so.
bool Executor::refuses_while_teaching() {
  if (!s_.teaching_) return false;
  const std::string text = "The three methods are still being compared: Pause ends that.";
  if (s_.messages.empty() || s_.messages.back().text != text) say(MessageKind::info, text);
  return true;
}

void Executor::operator()(const OpenFile& command) {
  drop_what_waits();
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  s_.engine.cancel();
  s_.activity = Activity::loading;
  s_.engine.post("load", load_job(command.path, s_.smoothing));
}

void Executor::operator()(const SaveFile& command) {
  if (!s_.current) {
    say(MessageKind::error, "There is no mesh to save.");
    return;
  }
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  s_.activity = Activity::saving;
  s_.engine.post("save", save_job(s_.document, s_.current, command.path));
}

void Executor::operator()(const SetSmoothing& command) {
  if (s_.is_running() || command.settings == s_.smoothing) return;
  s_.undo.push({command.label, SettingsChange{s_.smoothing, command.settings}});
  s_.smoothing = command.settings;
  s_.remaining = 0;
  measure_energy_if_changed();
}

void Executor::operator()(const EndEdit& /*command*/) {
  s_.undo.stop_merging();
}

void Executor::operator()(const SetView& command) {
  const bool reasons = command.view.reasons && !s_.view.reasons;
  s_.view = command.view;
  if (reasons && s_.moving() != nullptr)
    say(MessageKind::info, "What limits vertices is known of a smoother's steps only.");
  else if (reasons)
    ask_about_step();
}

void Executor::operator()(const Pause& /*command*/) {
  s_.then_polish_ = false;
  drop_what_waits();
  if (s_.is_running()) s_.engine.cancel();
}

void Executor::operator()(const Cancel& /*command*/) {
  s_.then_polish_ = false;
  drop_what_waits();
  s_.engine.cancel();
}

void Executor::end_run() {
  const bool was_running = s_.is_running();
  s_.activity = Activity::idle;
  // Those of a comparison of methods are taken back together.
  if (was_running && !s_.before_teaching_ && s_.run_start_ &&
      s_.run_start_->geometry != s_.current->geometry) {
    const unsigned done = s_.current->iteration - s_.run_start_->iteration;
    s_.undo.push({count_label(done, s_.moving() != nullptr ? "step" : "iteration"),
                  PositionsChange{s_.run_start_, s_.current, std::move(s_.rows_at_start_), s_.history,
                                  s_.cursor_at_start_, s_.timeline.cursor}});
  }
  if (was_running) drop_empty_branch();
  if (was_running && !s_.teaching_) note_teaching();
  s_.run_start_.reset();
  s_.rows_at_start_.clear();
  measure_energy_if_changed();
  go_on_when_idle();
  ask_about_step();
}

// Asks the worker for the energies under the present settings where a state has those of other ones.
void Executor::measure_energy_if_changed() {
  if (!s_.current || s_.moving() != nullptr) return;
  const auto stale = [&](const MeshStatePtr& state) {
    return !state->energy || !same_energy(state->energy->settings, s_.smoothing);
  };
  if (stale(s_.current) || stale(s_.original))
    s_.engine.post("energy", energy_job(s_.document, s_.smoothing, s_.original, s_.current, place_shown()));
}

void Executor::operator()(const CopyCommandLine& /*command*/) {
  if (!s_.document) return;
  s_.command_line = command_line(s_);
  say(MessageKind::info, "Copied: " + s_.command_line);
  const Branch* branch = s_.task == Task::smooth ? s_.timeline.current() : nullptr;
  if (branch == nullptr || !branch->parent || branch->start == 0) return;
  const Branch& before = s_.timeline.branches[*branch->parent];
  if (!before.from_file && before.settings == branch->settings) return;
  say(MessageKind::warning, "What was copied does not say that this run left another one at iteration " +
                                std::to_string(branch->start) +
                                ", where that had other settings: a saved run does.");
}

void Executor::operator()(const Say& command) {
  say(command.message.kind, command.message.text, command.message.topic);
}

void Executor::operator()(const SetRecent& command) {
  s_.recent = command.paths;
  if (s_.recent.size() > kRecentKept) s_.recent.resize(kRecentKept);
}

void Executor::operator()(const Collect& /*command*/) {
  for (Event& event : s_.engine.collect()) std::visit(*this, event);
  if (s_.engine.busy()) return;
  // A job that was dropped before it began leaves no event.
  s_.seeking_ = false;
  if (s_.activity != Activity::idle) end_run();
  go_on_when_idle();
  if (!s_.engine.busy() && std::exchange(s_.measure_surface_later_, false)) measure_surface();
}

void Executor::remember_recent(const std::filesystem::path& path) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(path, error);
  const auto& kept = error ? path : absolute;
  std::erase(s_.recent, kept);
  s_.recent.insert(s_.recent.begin(), kept);
  if (s_.recent.size() > kRecentKept) s_.recent.resize(kRecentKept);
}

void Executor::show(const MeshStatePtr& state) {
  s_.current = state;
  for (const Coloring c : kMeasured) {
    // The energy of a moving surface is another one, and has a range of its own.
    if (state->values(c).empty() || (c == Coloring::energy && s_.moving() != nullptr)) continue;
    ValueRange& range = s_.run_range[static_cast<std::size_t>(c)];
    range = united(range, state->range(c));
  }
}

void Executor::operator()(Loaded& event) {
  s_.document = std::move(event.document);
  s_.messages.clear();  // they were about another mesh
  s_.original = event.state;
  s_.on_disk = {{whole_name(s_.document->path), event.state->geometry}};
  s_.save_path.reset();
  for (const Coloring c : kMeasured) s_.run_range[static_cast<std::size_t>(c)] = event.state->range(c);
  s_.undo.clear();
  s_.history.clear();
  s_.last_step.reset();
  s_.last_run.reset();
  s_.remaining = 0;
  clear_selection();
  forget_runs();
  s_.smoothing.pinned = marked_vertices(s_.document->mesh(), s_.document->topology);
  s_.notes = std::move(event.notes);
  if (const std::size_t marked = s_.smoothing.pinned.size(); marked > 0) {
    s_.notes.push_back(std::to_string(marked) + (marked == 1 ? " vertex is" : " vertices are") +
                       " pinned because the file marks them: X unpins the selected one");
  }
  s_.series = 0;
  show(event.state);
  if (s_.current->energy) {
    const QualityReport& q = s_.current->quality();
    s_.history.push_back({0, s_.current->energy->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series});
  }
  s_.activity = Activity::idle;
  if (!s_.document->sphere) remember_recent(s_.document->path);
  for (const std::string& note : s_.notes) say(MessageKind::warning, note);
  if (!event.turning.empty()) {
    s_.notes.push_back(event.turning);
    say(MessageKind::warning, event.turning, Topic::turning);
  }
  // Settings may have changed while the file was read.
  if (s_.current->energy) measure_energy_if_changed();
}

void Executor::operator()(EnergyMeasured& event) {
  if (event.document != s_.document || !same_energy(event.current->settings, s_.smoothing)) return;
  const auto with = [](const MeshStatePtr& state, std::shared_ptr<const EnergyState> energy) {
    auto changed = std::make_shared<MeshState>(*state);
    changed->energy = std::move(energy);
    return changed;
  };
  if (event.original_geometry == s_.original->geometry) s_.original = with(s_.original, event.original);
  if (event.current_geometry != s_.current->geometry) {
    measure_energy_if_changed();
    return;
  }
  s_.current = with(s_.current, event.current);
  s_.run_range[static_cast<std::size_t>(Coloring::energy)] =
      united(event.original->range, event.current->range);
  ++s_.series;
  if (s_.history.size() <= 1 && s_.current->geometry == s_.original->geometry) {
    const QualityReport& q = s_.current->quality();
    s_.history = {
        {s_.current->iteration, event.current->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series}};
  }
}

void Executor::operator()(Iterated& event) {
  if (s_.timeline.empty()) return;
  Branch& branch = s_.timeline.branches[s_.timeline.cursor.branch];
  s_.history.insert(s_.history.end(), event.rows.begin(), event.rows.end());
  branch.rows.insert(branch.rows.end(), event.rows.begin(), event.rows.end());
  branch.steps.insert(branch.steps.end(), event.steps.begin(), event.steps.end());
  keep_hits(event.hits);
  s_.step_memory = event.memory;
  if (!branch.steps.empty()) s_.last_step = branch.steps.back();
  if (!event.state) return;
  show(event.state);
  s_.timeline.cursor.iteration = event.state->iteration;
}

void Executor::measure_surface() {
  if (!s_.current || s_.activity != Activity::idle || s_.seeking_ || s_.timeline.empty() ||
      s_.current->geometry == s_.original->geometry || s_.document->mesh().triangle_count() > kMostMeasured)
    return;
  const Cursor& cursor = s_.timeline.cursor;
  const Branch& branch = s_.timeline.branches[s_.timeline.holder(cursor.branch, cursor.iteration)];
  s_.engine.post("surface", surface_job(s_.document, branch.settings, s_.current, place_shown()));
}

void Executor::operator()(SurfaceMeasured& event) {
  if (!s_.current || event.geometry != s_.current->geometry) return;
  std::string text;
  const auto tell = [&](const std::string& what) { text += (text.empty() ? "" : " and ") + what; };
  const auto triangles = [](std::size_t count) {
    return count_label(static_cast<unsigned>(count), "triangle");
  };
  if (event.turned > 0) tell(triangles(event.turned) + " turned over");
  if (event.crossing > 0) tell(triangles(event.crossing) + " came to cross others");
  if (event.is_over) {
    char away[96];
    std::snprintf(away, sizeof away, "the surface went %.2g %% of its diagonal away from the original",
                  100 * event.deviation.max);
    tell(away);
  }
  if (!text.empty() && s_.surface_is_news_)
    say(MessageKind::warning,
        text + ". isorelax smooth would have prevented that; here, pin vertices or take a smaller limit.");
  s_.surface = std::move(event);
}

void Executor::operator()(RunFailed& event) {
  say(MessageKind::error, event.text);
  s_.remaining = 0;
  if (s_.moving() != nullptr) s_.timeline.branches[s_.timeline.cursor.branch].ended = event.text;
  end_run();
}

void Executor::operator()(Saved& event) {
  s_.on_disk[whole_name(event.path)] = event.state->geometry;
  s_.kept_steps_ = s_.timeline.made_steps();
  s_.save_path = event.path;
  s_.activity = Activity::idle;
  say(MessageKind::info, "Saved " + event.path.string(), Topic::saving);
  for (const std::string& note : event.notes) say(MessageKind::warning, note);
  remember_recent(event.path);
}

void Executor::operator()(Failed& event) {
  say(MessageKind::error, event.text, event.topic);
  drop_what_waits();
  if (s_.activity != Activity::running) s_.activity = Activity::idle;
}

void execute(Session& session, const Command& command) {
  std::visit(Executor(session), command);
}

void finish(Session& session) {
  while (true) {
    execute(session, Collect{});
    if (!session.engine.busy()) break;
    session.engine.wait();
  }
  execute(session, Collect{});
}

ValueRange Session::color_range() const {
  const auto index = static_cast<std::size_t>(view.coloring);
  switch (view.range_mode) {
    case RangeMode::run:
      if (const Branch* branch = moving()) {
        if (view.coloring == Coloring::relative_area) return branch->areas;
        if (view.coloring == Coloring::energy) return branch->energies;
      }
      return run_range[index];
    case RangeMode::current:
      return current ? current->range(view.coloring) : ValueRange{};
    case RangeMode::typed:
      break;
  }
  return view.typed[index];
}

}  // namespace isorelax::model
