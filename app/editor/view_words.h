#pragma once

#include <span>
#include <string>

#include "model/command.h"
#include "render/camera.h"

namespace isorelax::editor {

/// "view color=... range=... ...".
[[nodiscard]] std::string to_line(const model::SetView& command);
/// The inverse; what the words leave out is as in `view`. Throws UsageError.
[[nodiscard]] model::SetView parse_view_words(std::span<const std::string> words, model::ViewSettings view);

/// "camera X Y Z AZIMUTH ELEVATION EXTENT y|z perspective|orthographic".
[[nodiscard]] std::string to_line(const render::Camera& camera);
/// Throws UsageError.
[[nodiscard]] render::Camera parse_camera_words(std::span<const std::string> words);

}  // namespace isorelax::editor
