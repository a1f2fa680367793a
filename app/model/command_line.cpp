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

std::string motion_line(const Session& session) {
  const Document& document = *session.document;
  MotionChoices motion = session.motion;
  std::string line = "isorelax advect";
  if (document.sphere)
    motion.sphere = document.sphere;
  else
    line += " " + quoted(document.path.string());
  line += " -o " + quoted(document.path.stem().string() + "-moved");
  for (const std::string& word : to_words(motion)) line += " " + quoted(word);
  return line;
}

}  // namespace

std::string command_line(const Session& session) {
  if (!session.document) return {};
  if (session.task == Task::move) return motion_line(session);
  auto output = session.document->path;
  output.replace_filename(output.stem().string() + "-smooth" + output.extension().string());
  std::string line =
      "isorelax smooth " + quoted(session.document->path.string()) + " -o " + quoted(output.string());
  for (const std::string& word : to_words(session.smoothing)) line += " " + quoted(word);
  // The pins say which of those are held.
  if (!marked_vertices(session.document->mesh(), session.document->topology).empty()) line += " --marks free";
  return line;
}

}  // namespace isorelax::model
