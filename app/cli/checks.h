#pragma once

#include <CLI/Validators.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace isorelax::cli {

/// Check for counts and seeds: a whole number, not under `least`. CLI11 by itself reads "-1" into an unsigned
/// number without complaint.
inline CLI::Validator whole_number(std::uint64_t least) {
  const auto check = [least](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool sound = error == std::errc{} && end == text.data() + text.size() && value >= least;
    return sound ? std::string() : text + " is not a whole number of " + std::to_string(least) + " or more";
  };
  return CLI::Validator(check, "");
}

}  // namespace isorelax::cli
