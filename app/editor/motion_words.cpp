#include "editor/motion_words.h"

#include <vector>

#include "editor/script_words.h"
#include "io/text_in.h"
#include "mesh/error.h"

namespace isorelax::editor {
namespace {

constexpr std::string_view kFile = "file:";

model::Move parse_move(std::span<const std::string> words) {
  if (words.size() > 3) throw UsageError("motion run: \"" + words[3] + "\" is too much");
  model::Move move;
  if (words.size() < 3) return move;
  const std::string& word = words[2];
  if (!read_number(word, move.steps) || move.steps == 0)
    throw UsageError("motion run: expected a number of steps, found \"" + word + "\"");
  return move;
}

/// A file that an option names, seen from the script's folder.
std::string from_folder(const std::string& option, const std::string& word,
                        const std::filesystem::path& folder) {
  if (option == "field" && word.starts_with(kFile))
    return std::string(kFile) + (folder / word.substr(kFile.size())).string();
  if (option == "reference" && word != "initial" && !word.starts_with("equilateral"))
    return (folder / word).string();
  return word;
}

}  // namespace

std::optional<model::Command> parse_motion_words(std::span<const std::string> words,
                                                 const model::Session& session,
                                                 const std::filesystem::path& folder) {
  if (words.empty() || words[0] != "motion") return std::nullopt;
  if (words.size() == 1) return model::SetTask{model::Task::move};
  if (words[1] == "off" && words.size() == 2) return model::SetTask{model::Task::smooth};
  if (words[1] == "run") return parse_move(words);
  if (words[1] == "sphere") {
    if (words.size() > 3) throw UsageError("motion sphere: \"" + words[3] + "\" is too much");
    return model::OpenSphere{words.size() == 2 ? SphereStart{} : parse_sphere(words[2])};
  }
  const bool anew = words[1] == "defaults";
  MotionChoices motion = anew ? MotionChoices{} : session.motion;
  std::vector<std::string> options(words.begin() + (anew ? 2 : 1), words.end());
  for (std::size_t k = 0; k + 1 < options.size(); k += 2)
    options[k + 1] = from_folder(options[k], options[k + 1], folder);
  read_words(options, motion);
  return model::SetMotion{std::move(motion), "Motion"};
}

std::string to_line(const model::SetMotion& command) {
  std::string line = "motion defaults";
  const std::vector<std::string> words = to_words(command.motion);
  for (std::size_t k = 0; k + 1 < words.size(); k += 2)
    line += " " + words[k].substr(2) + " " + quote_word(words[k + 1]);
  return line;
}

std::string to_line(const model::OpenSphere& command) {
  return "motion sphere " + to_text(command.sphere);
}

}  // namespace isorelax::editor
