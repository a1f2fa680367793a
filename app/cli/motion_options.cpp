#include "cli/motion_options.h"

#include <CLI/App.hpp>

#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/option_words.h"

namespace isorelax::cli {

void MotionSpec::declare(CLI::App& app) {
  for (const MotionOption& option : motion_options())
    options_.push_back(app.add_option_function<std::string>(
                              "--" + std::string(option.name),
                              [this, read = option.read](const std::string& word) { read(word, choices_); },
                              std::string(option.help))
                           ->type_name(std::string(option.type)));
}

std::vector<std::string> MotionSpec::words() const {
  return words_of(options_);
}

MotionSetup MotionSpec::set_up(Console& console, const std::string& input) const {
  if (!input.empty() && choices_.sphere) throw UsageError("--sphere and a mesh: give one of them");
  std::vector<std::string> notes;
  std::optional<TriangleMesh> start;
  if (!input.empty()) start = read_input(console, input);
  MotionSetup setup = set_up_motion(choices_, std::move(start), notes);
  for (const std::string& note : notes) console.message(note);
  return setup;
}

}  // namespace isorelax::cli
