#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "trace/redo.h"

namespace isorelax::window {

struct WindowOptions {
  std::vector<std::filesystem::path> files;  ///< the first is opened, the others are offered as recent files
  int width = 1440;                          ///< points; less where the screen is smaller
  int height = 900;
  std::optional<float> scale;  ///< pixels per point; none: what the monitor asks for
  PlanReader read_plan;        ///< for recorded runs; as the editor's
  /// Closes after so many frames: for tests. None: stays until the user closes it.
  std::optional<unsigned> frames;
  /// Written from the window's own framebuffer when it closes.
  std::optional<std::filesystem::path> screenshot;
};

/// Opens the editor's window and returns when it is closed. Throws UsageError when there is no display (the
/// text names the commands that need none), OutputError when the screenshot cannot be written.
void run_window(const WindowOptions& options);

}  // namespace isorelax::window
