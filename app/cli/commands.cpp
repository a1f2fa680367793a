#include "cli/command.h"

namespace isorelax::cli {

std::unique_ptr<Command> make_info_command();
std::unique_ptr<Command> make_quality_command();
std::unique_ptr<Command> make_smooth_command();
std::unique_ptr<Command> make_render_command();
std::unique_ptr<Command> make_compare_command();
std::unique_ptr<Command> make_generate_command();
std::unique_ptr<Command> make_benchmark_command();
std::unique_ptr<Command> make_trace_command();
std::unique_ptr<Command> make_advect_command();
std::unique_ptr<Command> make_view_command();
std::unique_ptr<Command> make_script_command();

std::vector<std::unique_ptr<Command>> all_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_info_command());
  commands.push_back(make_quality_command());
  commands.push_back(make_smooth_command());
  commands.push_back(make_render_command());
  commands.push_back(make_compare_command());
  commands.push_back(make_generate_command());
  commands.push_back(make_benchmark_command());
  commands.push_back(make_trace_command());
  commands.push_back(make_advect_command());
  commands.push_back(make_view_command());
  commands.push_back(make_script_command());
  return commands;
}

}  // namespace isorelax::cli
