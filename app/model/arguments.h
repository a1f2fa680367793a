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

/// The inverse; what the words leave out is as in `others`, for the words of a trace the defaults. None where
/// they hold an option, or a value, that the editor has no setting for.
[[nodiscard]] std::optional<SmoothingSettings> from_words(std::span<const std::string> words,
                                                          const SmoothingSettings& others = {});

/// The head of a trace of a run that the editor makes.
[[nodiscard]] Trace about(const Document& document, const SmoothingSettings& settings);

}  // namespace isorelax::model
