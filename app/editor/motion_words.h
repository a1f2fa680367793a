#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "model/command.h"

namespace isorelax::editor {

/// A line of a script that begins with "motion": none where it is none. Files are taken from `folder`. Throws
/// UsageError.
[[nodiscard]] std::optional<model::Command> parse_motion_words(std::span<const std::string> words,
                                                               const model::Session& session,
                                                               const std::filesystem::path& folder);

/// Its inverse: all options that are not as by default.
[[nodiscard]] std::string to_line(const model::SetMotion& command);
[[nodiscard]] std::string to_line(const model::OpenSphere& command);

}  // namespace isorelax::editor
