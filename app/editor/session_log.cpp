#include "editor/session_log.h"

#include <utility>

#include "editor/script_words.h"
#include "editor/view_words.h"

namespace isorelax::editor {
namespace {

std::string_view first_word(std::string_view line) {
  return line.substr(0, line.find(' '));
}

/// What has no effect on what is there, such as a number that the user typed and that is nothing's: a script
/// would be refused for it.
bool is_refused(const model::Command& command, const model::Session& session) {
  if (std::holds_alternative<model::Teach>(command))
    return session.moving() != nullptr &&
           session.timeline.cursor.iteration > session.timeline.current()->start;
  if (const auto* removal = std::get_if<model::RemoveRun>(&command))
    return !why_kept(session, removal->branch).empty();
  const TriangleMesh* mesh = session.document ? &session.document->mesh() : nullptr;
  const std::size_t vertices = mesh != nullptr ? mesh->positions.size() : 0;
  if (const auto* vertex = std::get_if<model::SelectVertex>(&command)) return vertex->vertex >= vertices;
  if (const auto* pin = std::get_if<model::TogglePin>(&command)) return pin->vertex >= vertices;
  const auto* triangle = std::get_if<model::SelectTriangle>(&command);
  return triangle != nullptr && (mesh == nullptr || triangle->triangle >= mesh->triangles.size());
}

/// Of several in a row only the last one counts.
bool replaces(std::string_view line, std::string_view before) {
  const std::string_view word = first_word(line);
  if (line.starts_with("motion defaults")) return before.starts_with("motion defaults");
  return word == first_word(before) && (word == "seek" || word == "set" || word == "view" ||
                                        word == "camera" || word == "tab" || word == "show");
}

}  // namespace

SessionLog::Looks SessionLog::looks_of(const render::Camera& camera, const ui::UiState& state) {
  const auto word = [](const auto& words, auto which) {
    return std::string(words.at(static_cast<std::size_t>(which)));
  };
  Looks looks{to_line(camera), "tab " + word(kTabWords, state.tab),
              "show " + word(kModeWords, state.comparison.mode)};
  if (state.comparison.mode != ui::CompareMode::off)
    looks.comparison += " " + word(kPartnerWords, state.comparison.with);
  return looks;
}

void SessionLog::add(std::string line) {
  // What was done before a run that goes on counts for it.
  const bool may_replace = !run_from_ || lines_.size() > run_at_;
  if (may_replace && !lines_.empty() && replaces(line, lines_.back()))
    lines_.back() = std::move(line);
  else
    lines_.push_back(std::move(line));
}

void SessionLog::note_looks(const Looks& now) {
  if (now.camera != looks_.camera && !lines_.empty()) add(now.camera);
  if (now.tab != looks_.tab) add(now.tab);
  if (now.comparison != looks_.comparison && !(looks_.comparison.empty() && now.comparison == "show off"))
    add(now.comparison);
  looks_ = now;
}

void SessionLog::note(const model::Command& command, const model::Session& session,
                      const render::Camera& camera, const ui::UiState& state) {
  std::string line = to_line(command);
  if (line.empty() || is_refused(command, session)) return;
  note_looks(looks_of(camera, state));
  const bool runs = std::holds_alternative<model::Run>(command) ||
                    std::holds_alternative<model::Step>(command) ||
                    std::holds_alternative<model::Move>(command);
  if (runs && session.can_smooth()) {
    // Another motion begins where the one that is shown began.
    const model::Branch* shown = session.moving();
    const bool anew = shown != nullptr && !session.continues_branch();
    run_from_ = anew ? shown->start : session.timeline.cursor.iteration;
    run_at_ = lines_.size();
    return;
  }
  if (!runs) add(std::move(line));
}

void SessionLog::follow(const model::Session& session) {
  if (!run_from_ || session.is_running() || session.is_seeking()) return;
  const unsigned from = *std::exchange(run_from_, std::nullopt);
  const unsigned at = session.timeline.cursor.iteration;
  const std::string word = session.moving() != nullptr ? "motion run " : "run ";
  // What was asked for meanwhile came behind the run.
  if (at > from)
    lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(run_at_), word + std::to_string(at - from));
}

std::string SessionLog::text(const std::string& size, const render::Camera& camera,
                             const ui::UiState& state) const {
  SessionLog ended = *this;
  ended.note_looks(looks_of(camera, state));
  std::string text = "# What was done in the editor of Isorelax. isorelax script FILE does it again.\n";
  text += size + "\n";
  for (const std::string& line : ended.lines_) text += line + "\n";
  return text + "screenshot end.png\n";
}

}  // namespace isorelax::editor
