#include "editor/script.h"

#include <CLI/App.hpp>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/smooth_run.h"
#include "render/picture_size.h"

namespace isorelax::cli {
namespace {

class ScriptCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "script"; }
  [[nodiscard]] std::string summary() const override {
    return "Do in the editor what a script says, without a display";
  }
  [[nodiscard]] std::string notes() const override {
    return "A script holds one command in a line; # begins a comment. The editor writes one down as it is "
           "used: "
           "Runs, Save\n"
           "what was done as a script. Exit status 1 when an expectation does not hold.\n\n" +
           editor::script_reference() +
           "\nExample:\n"
           "  open part.off\n"
           "  run 20\n"
           "  seek 3\n"
           "  vertex 812\n"
           "  stage proposed\n"
           "  screenshot why.png\n"
           "  expect vertex(812).alpha > 0.1\n\n"
           "  isorelax script why.script --size 1600x1000";
  }
  void declare(CLI::App& app) override {
    app.add_option("SCRIPT", file_, "The script; files in it are named from its folder")->required();
    app.add_option("--pictures", pictures_,
                   "Folder for its pictures, made if need be (default: the script's)")
        ->type_name("FOLDER");
    app.add_option("--size", size_, "Size of the editor in pixels (default 1280x720)")->type_name("WxH");
    app.add_option("--scale", scale_, "Pixels per point, 2 for a high-resolution display")
        ->check(number_between(0.5, 4));
  }
  int run(Console& console) override {
    editor::ScriptOptions options;
    options.read_plan = read_plan;
    options.file = file_;
    options.pictures = pictures_;
    if (!size_.empty()) options.size = render::parse_size(size_);
    options.scale = static_cast<float>(scale_);
    const editor::ScriptResult result = editor::run_script(options);
    for (const auto& picture : result.pictures) console.message("wrote " + picture.string());
    for (const std::string& failure : result.failures) console.error(failure);
    return result.failures.empty() ? kDone : kCheckFailed;
  }

 private:
  std::string file_, pictures_, size_;
  double scale_ = 1;
};

}  // namespace

std::unique_ptr<Command> make_script_command() {
  return std::make_unique<ScriptCommand>();
}

}  // namespace isorelax::cli
