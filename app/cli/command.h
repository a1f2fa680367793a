#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace isorelax::cli {

class Console;

/// Exit statuses of the program.
enum Status : int {
  kDone = 0,
  kCheckFailed = 1,  ///< a comparison or check that did not hold
  kUsage = 2,
  kInput = 3,   ///< input that cannot be read or is not a usable mesh
  kOutput = 4,  ///< output that cannot be written
};

/// One subcommand. To add one: derive in a file of its own, give it a make function and name that in
/// commands.cpp.
class Command {
 public:
  virtual ~Command() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line for the list of commands.
  [[nodiscard]] virtual std::string summary() const = 0;
  /// Text under the options of --help: definitions, and at least one example.
  [[nodiscard]] virtual std::string notes() const = 0;
  /// Declares options whose values land in the command's own members.
  virtual void declare(CLI::App& app) = 0;
  /// Runs with the parsed options; returns a Status. Failures are thrown: InputError, MeshError, UsageError,
  /// OutputError become their status and one line on standard error.
  virtual int run(Console& console) = 0;
};

/// Every subcommand in the order of the help text.
[[nodiscard]] std::vector<std::unique_ptr<Command>> all_commands();

/// The whole command line program: parses, runs, reports. Never throws.
[[nodiscard]] int run(int argc, const char* const* argv);

}  // namespace isorelax::cli
