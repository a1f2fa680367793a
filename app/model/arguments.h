#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/document.h"
#include "model/settings.h"
#include "trace/trace.h"

namespace isorelax::model {

/// The settings as words of `isorelax smooth`: option, value, option, value, ...
[[nodiscard]] std::vector<std::string> to_words(const SmoothingSettings& settings);

/// The inverse, for the words of a trace; what they leave out is as the command line has it. None where they
/// hold an option, or a value, that the editor has no setting for.
[[nodiscard]] std::optional<SmoothingSettings> from_words(std::span<const std::string> words);

/// The head of a trace of a run that the editor makes.
[[nodiscard]] Trace about(const Document& document, const SmoothingSettings& settings);

}  // namespace isorelax::model
