#pragma once

#include <string>
#include <vector>

#include "cli/method_options.h"
#include "cli/problem_options.h"
#include "quality/report.h"
#include "smoothing/unguarded_run.h"
#include "trace/redo.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace isorelax::cli {

class Console;

/// What smoothing did, for the report and the summary.
struct SmoothOutcome : UnguardedResult {
  QualityReport before, after;
  unsigned attempts = 0;  ///< 1, and one for each time that the run was done again from the start
  double exponent = kDefaultExponent;  ///< of the energy, in the end
  double seconds = 0;                  ///< of all attempts, set-up and polish, without reading and writing
};

/// The options of `smooth` that decide what happens to a mesh: all but its files and what is printed. The
/// same words do the same again: a trace keeps them.
class SmoothRun {
 public:
  SmoothRun() = default;
  SmoothRun(const SmoothRun&) = delete;
  SmoothRun& operator=(const SmoothRun&) = delete;

  /// Declares the options. `app` and this live until the run.
  void declare(CLI::App& app);
  /// Throws UsageError for typed options that make no sense together.
  void check() const;
  /// The typed options as words, for a trace of this mesh: what its file marks stands there as pins.
  [[nodiscard]] std::vector<std::string> words(const TriangleMesh& mesh) const;
  /// Files that the typed options name.
  [[nodiscard]] std::vector<std::string> files() const;
  /// The same with their hashes now. Throws InputError.
  [[nodiscard]] std::vector<TraceResource> resources() const;
  void set_threads(unsigned threads) { problem_.threads = threads; }
  [[nodiscard]] unsigned threads() const { return problem_.threads; }

  /// Smooths in place, with progress on the console. `input` names the mesh in errors. Throws InputError,
  /// MeshError, UsageError.
  SmoothOutcome smooth(Console& console, const std::string& input, TriangleMesh& mesh,
                       const StepObserver& observer = {}, const PartObserver& part_observer = {}) const;

  /// What `smooth` makes the steps of this mesh with; their records keep all detail. Throws InputError,
  /// UsageError.
  [[nodiscard]] RunPlan plan(Console& console, const TriangleMesh& mesh) const;

  [[nodiscard]] DeviationLimit limit() const;

 private:
  [[nodiscard]] std::optional<PolishOptions> parse_polish() const;

  CLI::App* app_ = nullptr;
  std::vector<const CLI::Option*> options_;
  MethodSpec method_;
  ProblemSpec problem_;
  RunOptions run_;
  std::string deviation_;  ///< empty: not stated
  std::string polish_ = "none";
  PolishOptions polish_options_;
};

/// Reads the words of SmoothRun::words() into `run`. `app` is a fresh one that lives as long. Throws
/// UsageError.
void read_words(SmoothRun& run, CLI::App& app, std::vector<std::string> words);

/// A PlanReader for the words of SmoothRun::words(). Throws UsageError, InputError.
[[nodiscard]] RunPlan read_plan(const RunWords& words, const TriangleMesh& mesh);

}  // namespace isorelax::cli
