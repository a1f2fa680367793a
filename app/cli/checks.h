#pragma once

#include <CLI/Validators.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "io/mesh_file.h"
#include "io/text_in.h"
#include "io/text_out.h"

namespace isorelax::cli {

/// Check for counts and seeds: a whole number from `least` to `most`. CLI11 by itself reads "-1" into an
/// unsigned number without complaint.
inline CLI::Validator whole_number(std::uint64_t least,
                                   std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  const auto check = [least, most](const std::string& text) {
    std::uint64_t value = 0;
    if (read_number(text, value) && value >= least && value <= most) return std::string();
    return text +
           (most == std::numeric_limits<std::uint64_t>::max()
                ? " is not a whole number of " + std::to_string(least) + " or more"
                : " is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  };
  return CLI::Validator(check, "");
}

/// Check for a format of meshes, named by the extension of its files.
inline CLI::Validator mesh_format() {
  const auto check = [](const std::string& text) {
    return format_of_extension("mesh." + text) ? std::string() : text + " is none of " + format_names();
  };
  return CLI::Validator(check, "");
}

/// Check for numbers between `low` and `high`. CLI11's own range lets NaN pass, and names a bound of all
/// numbers with three hundred digits.
inline CLI::Validator number_between(double low, double high) {
  const auto check = [low, high](const std::string& text) {
    double value = 0;
    if (read_number(text, value) && value >= low && value <= high) return std::string();
    return text + (std::isinf(high) ? " is not a number of " + digits_of(low) + " or more"
                                    : " is not a number from " + digits_of(low) + " to " + digits_of(high));
  };
  return CLI::Validator(check, "");
}

}  // namespace isorelax::cli
