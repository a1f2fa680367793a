#pragma once

#include <optional>

#include "smoothing/limit_choice.h"
#include "surface/deviation.h"

namespace isorelax {

/// Which of automatic_limits holds where none is stated.
enum class AutomaticLimit : std::uint8_t {
  either,  ///< the nearest, or the widest where that pays; the last stage has the widest
  nearest,
  widest,
};

/// How far a result may be from the surface it came from.
struct DeviationLimit {
  /// Largest distance, both ways, over the input's bounding-box diagonal; infinite: no limit.
  std::optional<double> max;
  AutomaticLimit automatic = AutomaticLimit::either;  ///< without `max`
};

/// What the last stage raises: the worst angles, the mean of the triangles' smallest angles, or the mean
/// after the worst.
enum class PolishGoal : std::uint8_t { worst, mean, both };

/// Options of the last stage, `make_polish`.
struct PolishOptions {
  PolishGoal goal = PolishGoal::worst;
  /// For the sake of the worst, the mean of the triangles' smallest angles falls by no more than this, in
  /// degrees, and by no more than 0.1 beyond what the very worst have gained.
  double largest_mean_loss = 1;
  /// For the sake of the mean, this share of the triangles, 0..1, those with the worst angles of either kind,
  /// get no worse, and no other one gets as bad. 0: the very worst is the bound of all.
  double worst_share = 0.1;
  /// What a degree that the largest angle falls counts, beside a degree that the smallest rises.
  double obtuse_weight = 2;
  /// Steps of both goals together; each also ends by itself, the worst after 400 and the mean after 100.
  unsigned iterations = 500;
};

/// What the steps of a run are made with from some iteration on: enough to make them again.
struct RunPart {
  /// Steps before the first of these. 0: the run begins here, maybe anew after an attempt that is given up.
  unsigned done = 0;
  double exponent = kDefaultExponent;
  bool polish = false;  ///< made by `make_polish`, not by the SmootherFactory
  SurfaceHolds holds;

  /// Whether a run begins here, the first or another attempt.
  [[nodiscard]] bool begins_run() const { return done == 0 && !polish; }
};

/// Told of each part before its first step, with the positions there. One that begins where an earlier one
/// did is made instead of that and all after it. Those of a part with done == 0 are what the problems of all
/// parts until the next such part are made from.
using PartObserver = std::function<void(const RunPart& part, std::span<const Vec3> positions)>;

/// What a bounded run did.
struct BoundedResult {
  UntangleResult untangled;
  RunResult run;
  Deviation deviation;  ///< of the result from the input; without a limit, in a plane, from what untangling
                        ///< made of it
  double deviation_limit = 0;  ///< the one that held, over the diagonal
  /// Limits of the last step, counted by bit.
  std::array<std::size_t, kLimitBits> limits{};
  /// The last stage, if there was one.
  std::optional<RunResult> polish;
  /// The problem's notes, and what the limit held.
  std::vector<std::string> notes;
};

/// Runs with the problem's exponent. One above 2 is reached in steps, 2, 4, 8, ..., each started where the
/// one before ended: high powers alone are ruled by the worst triangle (method Sec. 6). All stages share
/// options.iterations: none has more than its part of those that are left, so that the last one is reached,
/// and one whose part is none is left out. The totals are those of the final exponent. `on_stage` is told the
/// exponent of each stage and the steps before it.
RunResult run_with_continuation(const SmoothingProblem& problem, const SmootherFactory& make_smoother,
                                std::span<Vec3> positions, const RunOptions& options,
                                const StepObserver& observer = {},
                                const std::function<void(unsigned done, double exponent)>& on_stage = {});

/// What a run does first about triangles that lie upside down.
struct UntangledStart {
  UntangleResult result;
  std::vector<std::string> notes;  ///< for the user
};

/// Turns them over in place (untangle_input), unless that would leave the surface by more than a stated
/// limit.
UntangledStart untangle_start(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options, const DeviationLimit& limit);

/// Smooths a mesh in place, polishes it if asked to, and measures how far it is from where it was. Every step
/// keeps the limit (SurfaceLimit). A run under an automatic limit that turns out to be too near
/// (wider_limit_pays) is done again from the start under the wider one. Should the result be farther than the
/// limit all the same, the run is done again with steps that keep the surface nearer, and at last with
/// vertices held still: in the end the limit holds, if with everything held. So it goes where a triangle lies
/// upside down (inverted_triangles) or faces away (faces_away) that did not before. Where only the polish did
/// that, only it is done again. Where no exponent is asked for, it is 2, or 1 where 2 would make the mean of
/// the triangles' smallest angles smaller than it came in and 1 makes it larger than 2 does, unless areas
/// count more than angles. Throws as make_problem.
///
/// A mesh with inverted triangles is untangled first (untangle_start) and smoothed from there. A stated limit
/// holds for both together; what untangling alone takes is not held against the automatic one. A mesh of
/// extreme size (beyond 2^100 or 2^-100) is smoothed at a size near one, in which the lengths of its records
/// are.
BoundedResult run_bounded(std::span<Vec3> positions, std::span<const Triangle> triangles,
                          const ProblemOptions& problem_options, const SmootherFactory& make_smoother,
                          const RunOptions& run_options, const DeviationLimit& limit,
                          const StepObserver& observer = {}, const std::optional<PolishOptions>& polish = {},
                          const PartObserver& part_observer = {});

}  // namespace isorelax
