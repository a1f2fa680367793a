#pragma once

#include <string>

#include "smoothing/problem.h"

namespace CLI {
class App;
}

namespace isorelax::cli {

class Console;

/// The options that say what is minimised and what may move, as typed.
struct ProblemSpec {
  double mu = 0;
  std::string weights;
  double exponent = 1;
  std::string reference = "equilateral";
  std::string boundary = "fixed";
  std::string features = "auto";
  std::string surface = "project";
  std::string pin_file;
  unsigned threads = 0;
};

/// Declares --mu, --weights, --exponent, --reference, --boundary, --features, --pin and --threads.
void declare_problem(CLI::App& app, ProblemSpec& spec);

/// Reads the typed options; reference and pin files too, for a mesh of so many vertices. Throws UsageError,
/// InputError.
[[nodiscard]] ProblemOptions parse_problem(Console& console, const ProblemSpec& spec,
                                           std::size_t vertex_count);

/// equilateral | equilateral:EDGE | initial | FILE.
[[nodiscard]] ReferenceChoice parse_reference(Console& console, const std::string& text);

/// auto | none | DEGREES (the ridge angle).
[[nodiscard]] FeatureOptions parse_features(const std::string& text);

}  // namespace isorelax::cli
