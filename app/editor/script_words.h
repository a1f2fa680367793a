#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/command.h"

namespace isorelax::editor {

/// The words of a line of a script: between spaces, or in single or double quotes; # begins a comment. Throws
/// UsageError for a quote that does not end.
[[nodiscard]] std::vector<std::string> split_words(std::string_view line);
/// In quotes where it needs them.
[[nodiscard]] std::string quote_word(const std::string& word);

/// A command of the model as a line of a script; empty for one that belongs to no script.
[[nodiscard]] std::string to_line(const model::Command& command);
/// The inverse; none where the first word is no command of the model. Paths are taken from `folder`. Throws
/// UsageError: what was expected.
[[nodiscard]] std::optional<model::Command> parse_line(std::span<const std::string> words,
                                                       const model::Session& session,
                                                       const std::filesystem::path& folder);

/// What scripts call the tabs (ui::SideTab) and how a comparison is shown and with what (ui::CompareMode,
/// ui::CompareWith), in their order.
inline constexpr std::array<std::string_view, 5> kTabWords{"quality", "inspect", "debug", "runs", "settings"};
inline constexpr std::array<std::string_view, 6> kModeWords{"off",  "split", "blink",
                                                            "side", "ghost", "change"};
inline constexpr std::array<std::string_view, 4> kPartnerWords{"original", "remembered", "file", "beside"};

struct ScriptWord {
  std::string_view usage, meaning;
};
/// The commands that parse_line knows.
[[nodiscard]] std::span<const ScriptWord> model_words();

}  // namespace isorelax::editor
