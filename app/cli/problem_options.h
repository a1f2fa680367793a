#pragma once

#include <string>
#include <vector>

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
  std::optional<double> exponent;
  std::string reference = "equilateral";
  std::string boundary = "fixed";
  double boundary_corner_deg = 45;
  std::string features = "auto";
  std::string surface = "project";
  std::string untangle = "auto";
  std::vector<std::string> pins;
  std::string marks = "hold";
  std::string size_field;
  unsigned threads = 0;
};

/// Declares --mu, --weights, --exponent, --reference, --size-field, --boundary, --boundary-corner,
/// --features,
/// --surface, --untangle, --pin and --threads.
void declare_problem(CLI::App& app, ProblemSpec& spec);

/// The vertices that a mesh's file marks and the options hold, as the words of a --pin; empty where there are
/// none.
[[nodiscard]] std::string marks_as_pins(const ProblemSpec& spec, const TriangleMesh& mesh);

/// Reads the typed options for a mesh; files that they name too. Throws UsageError, InputError.
[[nodiscard]] ProblemOptions parse_problem(Console& console, const ProblemSpec& spec,
                                           const TriangleMesh& mesh);

/// equilateral | equilateral:EDGE | initial | FILE, for a mesh. Throws UsageError, InputError, MeshError: the
/// file has other vertices than the mesh.
[[nodiscard]] ReferenceChoice parse_reference(Console& console, const std::string& text,
                                              const TriangleMesh& mesh);

/// auto | none | DEGREES (the ridge angle).
[[nodiscard]] FeatureOptions parse_features(const std::string& text);

}  // namespace isorelax::cli
