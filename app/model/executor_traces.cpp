#include <utility>

#include "model/executor.h"

namespace isorelax::model {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

void Executor::operator()(const CompareBranches& command) {
  const auto count = s_.timeline.branches.size();
  if (command.first >= count || command.second >= count || s_.is_running() ||
      s_.activity == Activity::loading)
    return;
  const auto whole = [&](unsigned branch) { return path_of(branch, s_.timeline.branches[branch].tip()); };
  s_.engine.post("compare",
                 compare_job(whole(command.first), whole(command.second), command.first, command.second));
}

void Executor::operator()(Compared& event) {
  s_.comparison = std::move(event);
}

void Executor::operator()(const SaveTrace& command) {
  if (s_.timeline.empty()) {
    say(MessageKind::error, "There is no run to save yet.");
    return;
  }
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  const unsigned branch = s_.timeline.cursor.branch;
  if (s_.timeline.branches[branch].motion) {
    say(MessageKind::error,
        "A motion has no trace: a trace is of a smoother. isorelax advect writes the states of a moving "
        "surface.");
    return;
  }
  s_.engine.post("", save_trace_job(path_of(branch, s_.timeline.branches[branch].tip()), command.path));
}

void Executor::operator()(Wrote& event) {
  s_.kept_steps_ = s_.timeline.made_steps();
  say(MessageKind::info, "Saved " + event.path.string(), Topic::saving);
}

void Executor::operator()(const OpenTrace& command) {
  drop_what_waits();
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  s_.engine.cancel();
  s_.activity = Activity::loading;
  s_.engine.post("load", open_trace_job(command.path, {}));
}

void Executor::operator()(const AddTrace& command) {
  if (!s_.document) {
    (*this)(OpenTrace{command.path});
    return;
  }
  if (wait_for_run([command](Session& s) { execute(s, command); })) return;
  s_.engine.post("", open_trace_job(command.path, s_.document));
}

void Executor::operator()(TraceOpened& event) {
  const bool alone = event.document != nullptr;
  if (!alone && event.joins != s_.document) {
    say(MessageKind::error, event.path.string() + ": another mesh was opened before the run was read",
        Topic::reading);
    return;
  }
  if (alone) {
    Loaded loaded{std::move(event.document), std::move(event.state), {}, {}};
    s_.smoothing = event.settings;
    (*this)(loaded);
    s_.smoothing.pinned = event.settings.pinned;  // of this document, not of the one before
    s_.recent.erase(s_.recent.begin());           // the mesh in it may be in no file
    remember_recent(event.path);
    if (!event.rows.empty()) s_.series = event.rows.back().series;
  }
  Branch branch;
  branch.name = event.path.filename().string();
  branch.settings = event.settings;
  branch.rows = std::move(event.rows);
  branch.steps = std::move(event.steps);
  branch.ended = event.head.stopped_because;
  branch.recording = std::move(event.recording);
  branch.from_file = true;
  branch.not_redone = std::move(event.not_redone);
  s_.timeline.branches.push_back(std::move(branch));
  const auto added = static_cast<unsigned>(s_.timeline.branches.size()) - 1;
  if (alone) {
    s_.timeline.cursor = {added, 0, {}};
    s_.history = s_.timeline.rows(added);
    say(MessageKind::info,
        "Opened a run of " + std::to_string(s_.timeline.last()) + " iterations by " + event.head.program);
  } else {
    say(MessageKind::info, "Added " + event.path.filename().string() + " to the timeline", Topic::reading);
  }
  if (!event.unknown_words.empty())
    say(MessageKind::warning, "The editor has no setting for " + listed(event.unknown_words) +
                                  ": branches that leave the run are made without.");
}

}  // namespace isorelax::model
