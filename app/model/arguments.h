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

/// The same for what is known of the words; `unknown` gets the others, "--option value" each.
[[nodiscard]] SmoothingSettings nearest_settings(std::span<const std::string> words,
                                                 const SmoothingSettings& others,
                                                 std::vector<std::string>& unknown);

/// The settings that a run was made with. Throws UsageError where the editor has not all of them.
[[nodiscard]] SmoothingSettings settings_of(const RunWords& words);

/// The head of a trace of a run that the editor makes. Reads the reference file; throws InputError.
[[nodiscard]] Trace about(const Document& document, const SmoothingSettings& settings);

}  // namespace isorelax::model
