#include <utility>

#include "model/executor.h"

namespace isorelax::model {

void Executor::operator()(const Reset& command) {
  if (!s_.current) return;
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  if (s_.seeking_) {
    s_.when_idle_.push_back([command](Session& s) { execute(s, command); });
    return;
  }
  if (s_.activity != Activity::idle || s_.current->geometry == s_.original->geometry) return;
  Cursor start = s_.timeline.cursor;
  start.iteration = 0;
  start.stage.reset();
  PositionsChange change{s_.current, s_.original, std::move(s_.history), {}, s_.timeline.cursor, start};
  if (s_.original->energy) {
    const QualityReport& q = s_.original->quality();
    change.rows_after.push_back(
        {0, s_.original->energy->total, q.min_angle_deg, q.max_angle_deg, 0, s_.series});
  }
  s_.history = change.rows_after;
  s_.undo.push({"Reset", std::move(change)});
  s_.current = s_.original;
  s_.timeline.cursor = start;
  s_.last_step.reset();
  s_.last_run.reset();
  s_.remaining = 0;
  // Its triangles are measured otherwise than those of the mesh as opened.
  if (show_beside_again()) return;
  if (s_.moving() != nullptr)
    seek(start.branch, 0);
  else
    ask_about_step();
}

void Executor::operator()(const StepBack& /*command*/) {
  if (!s_.current) return;
  if (s_.shared_iteration() > 0)
    (*this)(Seek{s_.shared_iteration() - 1, {}});
  else
    say(MessageKind::info, "There is no earlier iteration to go back to.");
}

void Executor::operator()(const Undo& command) {
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  if (s_.activity != Activity::idle || s_.seeking_ || s_.undo.next_undo() == nullptr) return;
  apply(*s_.undo.next_undo(), false);
  s_.undo.undone();
}

void Executor::operator()(const Redo& /*command*/) {
  if (s_.activity != Activity::idle || s_.seeking_ || s_.undo.next_redo() == nullptr) return;
  apply(*s_.undo.next_redo(), true);
  s_.undo.redone();
}

void Executor::apply(UndoEntry& entry, bool forward) {
  if (const auto* settings = std::get_if<SettingsChange>(&entry.change)) {
    s_.smoothing = forward ? settings->after : settings->before;
  } else if (const auto* motion = std::get_if<MotionChange>(&entry.change)) {
    s_.motion = forward ? motion->after : motion->before;
  } else if (auto* runs = std::get_if<RunsChange>(&entry.change)) {
    say(MessageKind::info, (forward ? "Redone: " : "Undone: ") + entry.label);
    apply(*runs, forward);
    return;
  } else {
    const auto& positions = std::get<PositionsChange>(entry.change);
    s_.current = forward ? positions.after : positions.before;
    s_.history = forward ? positions.rows_after : positions.rows_before;
    s_.timeline.cursor = forward ? positions.cursor_after : positions.cursor_before;
    s_.inspection.step.reset();
    s_.last_step.reset();
    s_.last_run.reset();
  }
  s_.remaining = 0;
  measure_energy_if_changed();
  if (!show_beside_again()) ask_about_step();
  say(MessageKind::info, (forward ? "Redone: " : "Undone: ") + entry.label);
}

// Runs beside follow to the iteration that is shown now, and the shown one does not stand beside itself.
bool Executor::show_beside_again() {
  std::erase(s_.shown_branches, s_.timeline.cursor.branch);
  s_.other_states.clear();
  if (s_.shown_branches.empty()) return false;
  seek(s_.timeline.cursor.branch, s_.timeline.cursor.iteration);
  return true;
}

}  // namespace isorelax::model
