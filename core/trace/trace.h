#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// What the worst triangles are at one iteration; definitions as in QualityReport.
struct TraceQuality {
  double min_angle_deg = 0;
  double max_angle_deg = 0;
  double mean_min_angle_deg = 0;
  std::size_t inverted = 0;

  bool operator==(const TraceQuality&) const = default;
};

/// One iteration of a recorded run: the step's totals, the quality after it, and its moves.
struct TraceIteration {
  StepKind kind = StepKind::unknown;
  StepTotals before, after;
  double largest_move = 0;
  std::size_t fold_passes = 0;
  std::size_t energy_passes = 0;
  std::size_t moved = 0;
  /// Vertices limited by each bit of Limit, in bit order.
  std::array<std::size_t, kLimitBits> limits{};
  /// Vertices whose tangent class is another one than in the step before.
  std::size_t class_changes = 0;
  TraceQuality quality;
  std::string delta;  ///< to the positions after the step from those before (position_delta.h)
};

/// A file that a run read beside its mesh: where it was, and the hash of what stood in it.
struct TraceResource {
  std::string path;
  std::string hash;

  bool operator==(const TraceResource&) const = default;
};

/// What a run was asked to do.
struct RunWords {
  /// As words of a command line, without input and output: `isorelax smooth IN -o OUT WORDS...`.
  std::vector<std::string> arguments;
  std::vector<TraceResource> resources;

  bool operator==(const RunWords&) const = default;
};

/// What makes the steps of a part.
enum class PartKind : std::uint8_t {
  solver,  ///< what the words name
  polish,  ///< make_polish
};

/// What the iterations from one on are made with, beside the words: enough to make any of them again. Its
/// first step is made by a smoother that knows nothing of the steps before.
struct TracePart {
  std::size_t done = 0;  ///< iterations before its first
  double exponent = kDefaultExponent;
  PartKind kind = PartKind::solver;
  SurfaceHolds holds;
  /// Delta (position_delta.h) from the trace's positions to those that the problem is made from; empty: it is
  /// made from the trace's positions.
  std::string base;
  /// The first step is made from these and not from where the iterations before led: untangling, which is no
  /// iteration, was between.
  bool from_base = false;
  std::optional<RunWords> words;  ///< where they are not the trace's own

  bool operator==(const TracePart&) const = default;
};

/// A recorded run, whole: what it began with and everything it did.
struct Trace : RunWords {
  std::string program;          ///< name and version of the program that ran
  std::string input;            ///< where the mesh came from
  std::vector<Vec3> positions;  ///< at the start
  std::vector<Triangle> triangles;
  TraceQuality quality;  ///< at the start
  std::vector<TraceIteration> iterations;
  /// Ascending by `done`, the first with 0. Empty where nothing is known of them: how the steps were made is
  /// then what the words alone say.
  std::vector<TracePart> parts;
  /// Somebody ended it, or an attempt that it gave up: the words alone do not do it again.
  bool interrupted = false;
  std::string stopped;          ///< why the run ended, in one word
  std::string stopped_because;  ///< and in one sentence

  /// The arguments with spaces between them.
  [[nodiscard]] std::string arguments_text() const;
};

/// Walks through the positions of a trace in both directions; each iteration on the way costs one delta.
/// Keeps a reference to the trace.
class TraceCursor {
 public:
  explicit TraceCursor(const Trace& trace) : trace_(trace), positions_(trace.positions) {}

  /// Goes to the positions after that many iterations (0: the start). Throws Error for one that is not there
  /// and for a damaged delta.
  const std::vector<Vec3>& go_to(std::size_t iteration);

  [[nodiscard]] std::size_t iteration() const { return iteration_; }
  [[nodiscard]] const std::vector<Vec3>& positions() const { return positions_; }

 private:
  const Trace& trace_;
  std::vector<Vec3> positions_;
  std::size_t iteration_ = 0;
};

/// A hash of bytes for telling whether they are still the same: FNV-1a, 64 bits.
[[nodiscard]] std::uint64_t fnv1a(std::string_view bytes);
/// The same as 16 hexadecimal digits.
[[nodiscard]] std::string hash_of(std::string_view bytes);

}  // namespace isorelax
