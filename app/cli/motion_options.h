#pragma once

#include <string>
#include <vector>

#include "motion/motion_choices.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace isorelax::cli {

class Console;

/// The options that decide how a surface moves, as typed. The same words do the same again.
class MotionSpec {
 public:
  MotionSpec() = default;
  MotionSpec(const MotionSpec&) = delete;
  MotionSpec& operator=(const MotionSpec&) = delete;

  /// Declares them. `app` and this live until the set-up.
  void declare(CLI::App& app);
  /// The typed ones as words, for a later run.
  [[nodiscard]] std::vector<std::string> words() const;
  /// Takes words over. Throws UsageError.
  void read(const std::vector<std::string>& words) { read_words(words, choices_); }
  /// Reads files that are named. `input`: the mesh; empty for a sphere. Throws UsageError, InputError.
  [[nodiscard]] MotionSetup set_up(Console& console, const std::string& input) const;

 private:
  std::vector<const CLI::Option*> options_;
  MotionChoices choices_;
};

}  // namespace isorelax::cli
