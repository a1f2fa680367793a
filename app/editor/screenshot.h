#pragma once

#include <filesystem>
#include <optional>

#include "editor/editor.h"
#include "render/image.h"

namespace isorelax::editor {

struct ScreenshotOptions {
  std::optional<std::filesystem::path> file;
  render::PictureSize size{1280, 720};
  float scale = 1;
  unsigned iterations = 0;  ///< done before the picture is taken
  PlanReader read_plan{};   ///< for recorded runs; as the Editor's
};

/// Throws UsageError, naming the smallest size, where the editor cannot be drawn in this one.
void require_room(render::PictureSize size, float scale);

/// A picture of the whole editor, drawn without a display. Throws UsageError for a size that is too small,
/// Error when the file cannot be read, a run fails or there is no OpenGL.
[[nodiscard]] render::Image take_screenshot(const ScreenshotOptions& options);

}  // namespace isorelax::editor
