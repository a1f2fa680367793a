#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "model/arguments.h"
#include "model/command.h"
#include "smoothing/pins.h"

namespace isorelax::model {
namespace {

// In single quotes unless every character is harmless to a shell.
std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=:,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// A name that no file has yet: name.off, name-2.off, name-3.off, ...
std::string free_name(const std::filesystem::path& folder, const std::string& name,
                      const std::string& extension) {
  std::filesystem::path path = folder / (name + extension);
  std::error_code unknown;
  for (unsigned k = 2; std::filesystem::exists(path, unknown); ++k)
    path = folder / (name + "-" + std::to_string(k) + extension);
  return path.string();
}

/// The settings that lead to what is shown where a run with the present ones does: with the number of its
/// steps, unless it ended there by itself. Elsewhere those that are set.
SmoothingSettings settings_done(const Session& session) {
  SmoothingSettings settings = session.smoothing;
  const Timeline& timeline = session.timeline;
  const Branch* run = timeline.current();
  unsigned steps = timeline.cursor.iteration;
  if (run == nullptr || run->motion || run->from_file || steps == 0 || !same_steps(*run, settings))
    return settings;
  const bool polished = run->kind == PartKind::polish && run->parent && steps > run->start;
  if (polished) {
    steps = run->start;
    run = &timeline.branches[*run->parent];
  }
  const bool at_end = run->result && steps == run->tip();
  if (at_end && has_converged(*run->result)) {
    settings.iterations = std::max(settings.iterations, steps);
    return settings;
  }
  if (at_end && run->result->stopped == StopReason::iterations && steps == settings.iterations)
    return settings;
  settings.iterations = steps;
  settings.tolerance = 0;
  if (!polished) settings.polish = Polish::none;
  return settings;
}

std::string motion_line(const Session& session) {
  const Document& document = *session.document;
  MotionChoices motion = session.motion;
  std::string line = "isorelax advect";
  if (document.sphere)
    motion.sphere = document.sphere;
  else
    line += " " + quoted(document.path.string());
  line += " -o " + quoted(free_name({}, document.path.stem().string() + "-moved", {}));
  for (const std::string& word : to_words(motion)) line += " " + quoted(word);
  return line;
}

}  // namespace

std::string command_line(const Session& session) {
  if (!session.document) return {};
  if (session.task == Task::move) return motion_line(session);
  const std::filesystem::path& input = session.document->path;
  const std::string output =
      free_name(input.parent_path(), input.stem().string() + "-smooth", input.extension().string());
  std::string line = "isorelax smooth " + quoted(input.string()) + " -o " + quoted(output);
  for (const std::string& word : to_words(settings_done(session))) line += " " + quoted(word);
  // The pins say which of those are held.
  if (!marked_vertices(session.document->mesh(), session.document->topology).empty()) line += " --marks free";
  return line;
}

}  // namespace isorelax::model
