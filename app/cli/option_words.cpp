#include "cli/option_words.h"

#include <CLI/App.hpp>

namespace isorelax::cli {

std::vector<std::string> words_of(std::span<const CLI::Option* const> options) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options) {
    for (const std::string& value : option->results()) {
      words.push_back(option->get_name());
      words.push_back(value);
    }
  }
  return words;
}

}  // namespace isorelax::cli
