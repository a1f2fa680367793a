#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <optional>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/smooth_run.h"
#include "editor/screenshot.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "render/picture_size.h"
#include "window/window.h"

namespace isorelax::cli {
namespace {

class ViewCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "view"; }
  [[nodiscard]] std::string summary() const override { return "Open the editor"; }
  [[nodiscard]] std::string notes() const override {
    return "The editor shows the mesh, its quality and its smoothing live; press ? in it for all keys. "
           "Several files:\n"
           "the first is opened, the others stand in the list of recent files. The window needs a display; "
           "--screenshot\n"
           "draws the whole editor into a PNG file without one.\n\n"
           "Examples:\n"
           "  isorelax view bunny.off\n"
           "  isorelax view bunny.off --scale 1.5\n"
           "  isorelax view bunny.off --after-iterations 50 --screenshot editor.png --size 1600x1000";
  }

  void declare(CLI::App& app) override {
    app.add_option("files", files_, "Meshes: " + format_names() + "; or recorded runs (smooth --trace)")
        ->type_name("FILE");
    CLI::Option* const screenshot =
        app.add_option("--screenshot", screenshot_,
                       "Draw the editor into this PNG file instead of opening a window")
            ->type_name("PNG");
    app.add_option("--size", size_, "Size of the window or of the screenshot, in pixels")->type_name("WxH");
    app.add_option("--scale", scale_,
                   "Size of texts and controls, in pixels per point (default: what the window's monitor asks "
                   "for, 2 on many with 4K; 1 for a screenshot)")
        ->check(number_between(0.5, 4));
    app.add_option("--after-iterations", iterations_, "Screenshot: smooth this many iterations first")
        ->type_name("N")
        ->needs(screenshot);
    app.add_option("--frames", frames_, "Window: close after at least N frames, when nothing is left to do")
        ->type_name("N");
    app.add_option("--window-screenshot", window_screenshot_, "Window: write its picture here when it closes")
        ->type_name("PNG");
  }

  int run(Console& console) override {
    for (const std::string& file : files_) check_readable(file);
    for (const std::string& picture : {screenshot_, window_screenshot_})
      if (!picture.empty()) render::require_png_name(picture);
    if (!screenshot_.empty()) {
      take_screenshot(console);
      return kDone;
    }
    window::WindowOptions options;
    options.read_plan = read_plan;
    options.files.assign(files_.begin(), files_.end());
    if (!size_.empty()) {
      const render::PictureSize size = render::parse_size(size_);
      options.width = size.width;
      options.height = size.height;
    }
    options.scale = scale_;
    options.frames = frames_;
    if (!window_screenshot_.empty()) options.screenshot = window_screenshot_;
    window::run_window(options);
    return kDone;
  }

 private:
  void take_screenshot(Console& console) const {
    editor::ScreenshotOptions options;
    options.read_plan = read_plan;
    if (!files_.empty()) options.file = files_.front();
    if (!size_.empty()) options.size = render::parse_size(size_);
    options.scale = scale_.value_or(1);
    options.iterations = iterations_;
    render::write_png(screenshot_, editor::take_screenshot(options));
    console.message("wrote " + screenshot_);
  }

  std::vector<std::string> files_;
  std::string screenshot_, window_screenshot_, size_;
  std::optional<float> scale_;
  unsigned iterations_ = 0;
  std::optional<unsigned> frames_;
};

}  // namespace

std::unique_ptr<Command> make_view_command() {
  return std::make_unique<ViewCommand>();
}

}  // namespace isorelax::cli
