#include "editor/screenshot.h"

#include <cmath>
#include <string>

#include "mesh/error.h"
#include "render/offscreen.h"

namespace isorelax::editor {
namespace {

/// In points: the bars, and something of the mesh between the panels.
constexpr render::PictureSize kLeastRoom{160, 120};

std::string size_text(render::PictureSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void throw_on_error(const model::Session& session, const std::string& file) {
  for (const model::Message& message : session.messages) {
    if (message.kind != model::MessageKind::error) continue;
    const bool named = message.text.find(file) != std::string::npos;
    throw MeshError(named ? message.text : file + ": " + message.text);
  }
}

}  // namespace

void require_room(render::PictureSize size, float scale) {
  const auto pixels = [&](int points) {
    return static_cast<int>(std::ceil(static_cast<float>(points) * scale));
  };
  const render::PictureSize least{pixels(kLeastRoom.width), pixels(kLeastRoom.height)};
  if (size.width < least.width || size.height < least.height)
    throw UsageError("the editor does not fit into " + size_text(size) + " pixels: the smallest size is " +
                     size_text(least));
}

render::Image take_screenshot(const ScreenshotOptions& options) {
  require_room(options.size, options.scale);
  const auto context = render::OffscreenContext::create(render::ContextKind::osmesa);
  Editor editor(context->loader(), Motion::instant, options.read_plan);
  model::Session& session = editor.session();
  const std::string file = options.file ? options.file->string() : std::string();
  if (options.file) {
    model::execute(session, model::OpenFile{*options.file});
    model::finish(session);
    throw_on_error(session, file);
  }
  if (options.iterations > 0) {
    model::SmoothingSettings settings = session.smoothing;
    settings.iterations = options.iterations;
    model::execute(session, model::SetSmoothing{settings, "Iterations"});
    model::execute(session, model::Run{});
    model::finish(session);
    throw_on_error(session, file);
  }
  // The interface needs a few frames to settle its sizes.
  for (int k = 0; k < 4; ++k) editor.frame({.size = options.size, .scale = options.scale, .time = 0.02 * k});
  return editor.picture();
}

}  // namespace isorelax::editor
