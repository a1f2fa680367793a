#pragma once

#include <string>

#include "smoothing/bounded_run.h"

namespace CLI {
class App;
}

namespace isorelax::cli {

/// The options that say how vertices find their way, as typed; empty: not typed.
struct MethodSpec {
  std::string method = "near-isometry";
  std::string solver, weighting, guard;
  std::optional<double> relaxation;
};

/// A way of smoothing, ready to run.
struct Method {
  SmootherFactory make_smoother;
  /// Steps are cut back where a triangle would turn over.
  bool guarded = true;
  /// Minimises the energy. The baselines do not: what only steers the energy has no meaning for them.
  bool minimises = true;
};

/// Declares --method, --solver, --weighting, --guard and --relaxation.
void declare_method(CLI::App& app, MethodSpec& spec);

/// Throws UsageError for an unknown word, and for an option that the method does not have, those of
/// declare_problem among them: `app` tells what was typed. `detail` is that of the smoothers' records.
[[nodiscard]] Method parse_method(const CLI::App& app, const MethodSpec& spec,
                                  RecordDetail detail = RecordDetail::vertices);

}  // namespace isorelax::cli
