#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "mesh/error.h"

namespace isorelax::cli {
namespace {

constexpr const char* kDefaultCommand = "view";
constexpr const char* kDescription =
    "Isorelax makes the triangles of a surface mesh better by moving vertices and nothing else.";
constexpr const char* kFooter =
    "Without a command, files are opened in the editor: isorelax FILE... is isorelax view FILE...\n"
    "isorelax COMMAND --help tells the options of a command and shows an example.\n\n"
    "Exit status: 0 done; 1 a comparison or check that did not hold; 2 wrong usage; 3 input that\n"
    "cannot be read or is not a usable mesh; 4 output that cannot be written.\n\n"
    "Example:\n  isorelax generate random -o square.off && isorelax quality square.off";

using Commands = std::vector<std::unique_ptr<Command>>;

bool has_command(const Commands& commands, const std::string& name) {
  return std::any_of(commands.begin(), commands.end(), [&](const auto& c) { return c->name() == name; });
}

/// Puts the default command in front of arguments that name none. A bare word that is neither a command nor
/// a file is taken for a mistyped command.
void add_default_command(std::vector<std::string>& arguments, const Commands& commands) {
  static const std::vector<std::string> kOwnOptions = {"-h", "--help", "--version"};
  if (!arguments.empty()) {
    const std::string& first = arguments.front();
    if (has_command(commands, first)) return;
    if (std::find(kOwnOptions.begin(), kOwnOptions.end(), first) != kOwnOptions.end()) return;
    const bool looks_like_file = first.find_first_of("./") != std::string::npos;
    std::error_code ignored;
    if (first.front() != '-' && !looks_like_file && !std::filesystem::exists(first, ignored)) {
      throw UsageError(first + ": neither a command nor a file; isorelax --help lists the commands");
    }
  }
  arguments.insert(arguments.begin(), kDefaultCommand);
}

/// Other programs take a dash for standard input or output; here it would be a file of that name.
void refuse_dashes(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    const bool alone = word == "-";
    const bool attached = word == "-o-" || (word.starts_with("--") && word.ends_with("=-"));
    if (!alone && !attached) continue;
    const bool has_option = alone && i > 0 && arguments[i - 1].starts_with("-");
    throw UsageError((has_option ? arguments[i - 1] + " " : "") + word +
                     ": names no file; standard input is not read, nor is standard output written to");
  }
}

/// Where the command that was chosen is explained.
std::string see_help(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const std::string name = chosen.empty() ? "" : " " + chosen.front()->get_name();
  return " (see isorelax" + name + " --help)";
}

/// Runs what the arguments ask for; every failure leaves as an exception.
int parse_and_run(std::vector<std::string> arguments, Console& console) {
  const Commands commands = all_commands();
  CLI::App app(kDescription, "isorelax");
  app.footer(kFooter);
  app.set_version_flag("--version", "isorelax " ISORELAX_VERSION);
  app.require_subcommand(1);
  for (const auto& [label, text] :
       {std::pair("REQUIRED", "(required)"), std::pair("TEXT", ""), std::pair("SUBCOMMAND", "COMMAND ..."),
        std::pair("Subcommands", "Commands")}) {
    app.get_formatter()->label(label, text);
  }
  int status = kDone;
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command->name(), command->summary());
    sub->footer(command->notes());
    command->declare(*sub);
    sub->callback([&status, &console, &command] { status = command->run(console); });
  }
  refuse_dashes(arguments);
  try {
    add_default_command(arguments, commands);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    console.result(chosen.empty() ? app.help() : chosen.front()->help("isorelax"));
  } catch (const CLI::CallForVersion& version) {
    console.result(std::string(version.what()) + "\n");
  } catch (const CLI::ExtrasError&) {
    // CLI11 tells them from the back.
    std::string extras;
    for (const std::string& word : app.remaining(true)) extras += (extras.empty() ? "" : " ") + word;
    throw UsageError("not expected: " + extras + see_help(app));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + see_help(app));
  }
  console.finish();
  return status;
}

}  // namespace

int run(int argc, const char* const* argv) {
  // A reader that goes away shows as a failed write, not as a signal.
  std::signal(SIGPIPE, SIG_IGN);
  // So does a file that may not grow any more: its temporary copy is taken away again.
  std::signal(SIGXFSZ, SIG_IGN);
  Console console;
  try {
    return parse_and_run(std::vector<std::string>(argv + std::min(argc, 1), argv + argc), console);
  } catch (const UsageError& error) {
    console.error(error.what());
    return kUsage;
  } catch (const OutputError& error) {
    console.error(error.what());
    return kOutput;
  } catch (const Error& error) {
    console.error(error.what());
    return kInput;
  } catch (const std::bad_alloc&) {
    console.error("out of memory");
    return kInput;
  } catch (const std::exception& error) {
    console.error(std::string("unexpected: ") + error.what());
    return kInput;
  }
}

}  // namespace isorelax::cli
