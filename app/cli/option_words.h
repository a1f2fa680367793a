#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace isorelax::cli {

/// What was typed for these options, name before each value: the same words say the same again.
[[nodiscard]] std::vector<std::string> words_of(std::span<const CLI::Option* const> options);

}  // namespace isorelax::cli
