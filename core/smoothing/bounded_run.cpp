#include "smoothing/bounded_run.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/objective.h"
#include "smoothing/polish.h"
#include "smoothing/sentences.h"
#include "smoothing/surface_watch.h"
#include "smoothing/worst_note.h"

namespace isorelax {
namespace {

/// A stage that only leads to the next one need not be exact.
constexpr double kStageTolerance = 1e-4;
/// Nor need a run that only finds out what is to be held.
constexpr double kTryTolerance = 1e-3;
/// Degrees by which a mean may fall and still counts as the same.
constexpr double kSameMean = 0.01;
constexpr auto kSurfaceBit = static_cast<std::size_t>(std::countr_zero(unsigned{kLimitSurface}));

/// What the user is told about triangles that lay upside down; nothing where there were none.
std::vector<std::string> note_of(const UntangleResult& untangled) {
  if (untangled.before == 0) return {};
  if (untangled.moved.empty()) {
    return {counted(untangled.before, "triangle upside down is", "triangles upside down are") +
            " left: sharp folds of the surface, or held by vertices that may not move"};
  }
  return {counted(untangled.before, "triangle was", "triangles were") + " upside down: untangled by moving " +
          counted(untangled.moved.size(), "vertex", "vertices") + ", " +
          (untangled.after == 0 ? "none is" : counted(untangled.after, "is", "are")) + " left"};
}

}  // namespace

RunResult run_with_continuation(const SmoothingProblem& problem, const SmootherFactory& make_smoother,
                                std::span<Vec3> positions, const RunOptions& options,
                                const StepObserver& observer,
                                const std::function<void(unsigned done, double exponent)>& on_stage) {
  if (problem.exponent <= 2) {
    if (on_stage) on_stage(0, problem.exponent);
    return run(*make_smoother(problem), problem, positions, options, observer);
  }
  Objective objective(problem);
  const StepTotals before = objective.evaluate(positions);
  unsigned done = 0;
  double seconds = 0;
  const auto observe = [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
    return !observer || observer(done + iteration, record, moved);
  };
  RunResult result;
  auto stages_left = static_cast<unsigned>(std::ceil(std::log2(problem.exponent)));
  for (double exponent = 2;; exponent *= 2, --stages_left) {
    const bool last = exponent >= problem.exponent;
    RunOptions stage_options = options;
    stage_options.iterations = last ? options.iterations - done : (options.iterations - done) / stages_left;
    if (!last && stage_options.iterations == 0) continue;
    SmoothingProblem stage = problem;
    stage.exponent = std::min(exponent, problem.exponent);
    if (!last) stage_options.tolerance = std::max(options.tolerance, kStageTolerance);
    if (on_stage) on_stage(done, stage.exponent);
    result = run(*make_smoother(stage), stage, positions, stage_options, observe);
    done += result.iterations;
    seconds += result.seconds;
    if (last || result.stopped == StopReason::cancelled || result.stopped == StopReason::fixed) break;
  }
  result.iterations = done;
  result.seconds = seconds;
  result.before = before;
  result.after = objective.evaluate(positions);
  return result;
}

namespace {

double mean_of_smallest_angles(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                               const Topology& topology, unsigned threads) {
  return measure_quality(positions, triangles, topology, threads).mean_min_angle_deg;
}

/// The last stage, whose steps are counted on from `done`.
RunResult run_polish(const SmoothingProblem& problem, std::span<Vec3> positions, const PolishOptions& options,
                     unsigned done, const StepObserver& observer) {
  return run(*make_polish(problem, options), problem, positions,
             {.iterations = options.iterations, .tolerance = kPolishTolerance},
             [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
               return !observer || observer(done + iteration, record, moved);
             });
}

/// What stays the same from one attempt to the next.
struct Attempts {
  std::span<const Triangle> triangles;
  const SmootherFactory& make_smoother;
  const RunOptions& run_options;
  const DeviationLimit& limit;
  const StepObserver& observer;
  const std::optional<PolishOptions>& polish;
  const PartObserver& part_observer;
};

void announce(const Attempts& attempts, const RunPart& part, std::span<const Vec3> positions) {
  if (attempts.part_observer) attempts.part_observer(part, positions);
}

/// One attempt of run_from, not polished, whose deviation is not measured yet.
BoundedResult attempt(const SmoothingProblem& problem, const SurfaceHolds& holds, std::span<Vec3> positions,
                      const Attempts& attempts, const RunOptions& run_options) {
  BoundedResult result;
  result.notes = problem.notes;
  result.limits = count_limits(problem.fixed_limits);
  result.run = run_with_continuation(
      problem, attempts.make_smoother, positions, run_options,
      [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
        result.limits = count_limits(record.limits);
        return !attempts.observer || attempts.observer(iteration, record, moved);
      },
      [&](unsigned done, double exponent) {
        announce(attempts, {done, exponent, false, holds}, positions);
      });
  return result;
}

/// The last stage, from positions that are sound. Where it leads too far or folds something, it holds more
/// and is done again.
SurfaceWatch::Finding polish_soundly(BoundedResult& result, std::span<Vec3> positions,
                                     std::span<const Vec3> original, const SmoothingProblem& unheld,
                                     SurfaceHolds holds, const SurfaceWatch& watch, double limit,
                                     const Attempts& attempts) {
  const std::vector<Vec3> smoothed(positions.begin(), positions.end());
  holds.apart = false;
  for (double share = 1;; std::copy(smoothed.begin(), smoothed.end(), positions.begin())) {
    holds.distance = share * watch.largest_distance(limit);
    SmoothingProblem problem = unheld;
    hold(problem, holds, original);
    announce(attempts, {result.run.iterations, problem.exponent, true, holds}, positions);
    result.polish =
        run_polish(problem, positions, *attempts.polish, result.run.iterations, attempts.observer);
    SurfaceWatch::Finding found = watch.look(positions, limit);
    if (found.sound()) return found;
    watch.hold_more(holds, share, found, limit, false);
  }
}

/// The limits that may hold. High exponents are reached in stages of their own.
AutomaticLimits limits_of(std::span<const Vec3> positions, const SmoothingProblem& problem,
                          const ProblemOptions& options, const DeviationLimit& limit) {
  if (limit.max) return {*limit.max, *limit.max, false};
  AutomaticLimits limits = automatic_limits(positions, problem, options);
  const bool only_widest = limit.automatic == AutomaticLimit::widest ||
                           (limit.automatic == AutomaticLimit::either && problem.exponent > kDefaultExponent);
  if (only_widest) limits.nearest = limits.widest;
  if (limit.automatic == AutomaticLimit::nearest) limits.widest = limits.nearest;
  return limits;
}

/// The smoothing part of run_bounded, with deviations measured against `surface`. `smoothed_mean` becomes the
/// mean of the smallest angles before the last stage.
BoundedResult run_from(std::span<Vec3> positions, std::span<const Vec3> surface,
                       const ProblemOptions& options, const Attempts& attempts, double& smoothed_mean) {
  const std::vector<Vec3> original(positions.begin(), positions.end());
  const SmoothingProblem unheld = make_problem(original, attempts.triangles, options);
  const SurfaceWatch watch(surface, original, unheld);
  auto [limit, widest, on_fits] = limits_of(original, unheld, options, attempts.limit);
  SurfaceHolds holds = options.holds;
  holds.on_fits = on_fits;
  double share = 1;  // of the largest distance
  const auto hold_within = [&](double deviation) {
    holds.distance = share * watch.largest_distance(deviation);
    SmoothingProblem problem = unheld;
    hold(problem, holds, original);
    return problem;
  };
  // The first attempt mostly is the last. Some find that the limit should be wider. After one that went too
  // far all the same, quick tries find what has to be held.
  RunOptions quick = attempts.run_options;
  quick.tolerance = std::max(quick.tolerance, kTryTolerance);
  std::vector<std::string> notes;
  for (bool trying = false;; std::copy(original.begin(), original.end(), positions.begin())) {
    const SmoothingProblem problem = hold_within(limit);
    BoundedResult result =
        attempt(problem, holds, positions, attempts, trying ? quick : attempts.run_options);
    const bool cancelled = result.run.stopped == StopReason::cancelled;
    const std::size_t at_limit = result.limits[kSurfaceBit] - holds.still.size();
    if (limit < widest && at_limit > 0 && !cancelled && !trying &&
        wider_limit_pays(hold_within(widest), attempts.make_smoother, positions,
                         attempts.run_options.iterations)) {
      notes.push_back("done again with " + short_text(widest) +
                      " of the diagonal as the largest distance: " + short_text(limit) + " held " +
                      counted(at_limit, "vertex", "vertices") + " back, and more pays");
      limit = widest;
      continue;
    }
    if (cancelled && limit < widest) {
      result.notes.push_back("ended early, within " + short_text(limit) +
                             " of the diagonal: a whole run tries that first and begins again with " +
                             short_text(widest) +
                             " where more pays (--max-deviation nearest or widest: only one)");
    }
    if (!attempts.limit.max && at_limit > 0) {
      result.notes.push_back(counted(at_limit, "vertex is", "vertices are") +
                             " as far from the input as is allowed, " + short_text(limit) +
                             " of its diagonal, and would have gone farther (--max-deviation)");
    }
    result.notes.insert(result.notes.end(), notes.begin(), notes.end());
    SurfaceWatch::Finding found = watch.look(positions, limit);
    result.deviation_limit = limit;
    smoothed_mean = mean_of_smallest_angles(positions, unheld.triangles, unheld.topology, options.threads);
    const bool sound = found.sound();
    if (attempts.polish && sound && !trying && !cancelled && result.run.stopped != StopReason::fixed) {
      result.deviation_limit = widest;
      found = polish_soundly(result, positions, original, unheld, holds, watch, widest, attempts);
    }
    result.deviation = found.deviation;
    if (result.run.stopped == StopReason::fixed || (sound && !trying)) {
      if (const auto note = note_on_worst(unheld, positions)) result.notes.push_back(*note);
      return result;
    }
    if (!sound) watch.hold_more(holds, share, found, limit, true);
    trying = !sound;
  }
}

/// `run_from` with the exponent asked for, or the better one of 2 and 1 for what came in.
BoundedResult run_with_some_exponent(std::span<Vec3> positions, std::span<const Vec3> surface,
                                     std::span<const Vec3> input, const ProblemOptions& options,
                                     const Attempts& attempts) {
  const bool is_about_angles = options.weights.area <= options.weights.shape;
  const std::vector<Vec3> original(positions.begin(), positions.end());
  double with_squares = 0;
  BoundedResult result = run_from(positions, surface, options, attempts, with_squares);
  if (options.exponent || !is_about_angles || result.run.stopped == StopReason::cancelled) return result;
  const Topology topology(attempts.triangles, static_cast<Index>(input.size()));
  if (with_squares >=
      mean_of_smallest_angles(input, attempts.triangles, topology, options.threads) - kSameMean)
    return result;
  ProblemOptions linear = options;
  linear.exponent = 1;
  std::copy(original.begin(), original.end(), positions.begin());
  double with_one = 0;
  result = run_from(positions, surface, linear, attempts, with_one);
  if (result.run.stopped == StopReason::cancelled) return result;
  if (with_one <= with_squares + kSameMean) {
    std::copy(original.begin(), original.end(), positions.begin());
    return run_from(positions, surface, options, attempts, with_squares);
  }
  result.notes.emplace_back(
      "the exponent is 1: with 2, the mean of the triangles' smallest angles would end below what it was");
  return result;
}

/// Untangles, smooths from there, and measures against what came in.
BoundedResult untangle_and_run(std::span<Vec3> positions, const ProblemOptions& problem_options,
                               const Attempts& attempts) {
  const std::span<const Triangle> triangles = attempts.triangles;
  const DeviationLimit& limit = attempts.limit;
  const std::vector<Vec3> input(positions.begin(), positions.end());
  auto [untangled, notes] = untangle_start(positions, triangles, problem_options, limit);
  const bool moved = !untangled.moved.empty();
  const std::vector<Vec3> start(positions.begin(), positions.end());
  BoundedResult result =
      run_with_some_exponent(positions, limit.max ? input : start, input, problem_options, attempts);
  // Triangles upside down in a plane cover what the sound ones cover as well.
  const auto topology = [&] { return Topology(triangles, static_cast<Index>(positions.size())); };
  if (moved && !plane_normal(input, triangles, topology(), problem_options.threads))
    result.deviation = measure_deviation(input, positions, triangles, topology(), problem_options.threads);
  result.untangled = std::move(untangled);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  return result;
}

/// The power of two that brings a mesh of extreme size near one, where squares of areas neither overflow nor
/// vanish; 1 for any other mesh.
double scale_of(std::span<const Vec3> positions) {
  constexpr int kLargestExponent = 100;
  double largest = 0;
  for (const Vec3& p : positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  const int exponent = std::ilogb(largest);
  return std::abs(exponent) > kLargestExponent ? std::ldexp(1.0, -exponent) : 1;
}

/// The same options for a mesh scaled by this factor.
ProblemOptions scaled(ProblemOptions options, double factor) {
  if (auto* edge = std::get_if<EdgeLengthReference>(&options.reference)) edge->edge_length *= factor;
  if (auto* mesh = std::get_if<MeshReference>(&options.reference))
    for (Vec3& p : mesh->positions) p *= factor;
  return options;
}

}  // namespace

UntangledStart untangle_start(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options, const DeviationLimit& limit) {
  const std::vector<Vec3> input(positions.begin(), positions.end());
  UntangledStart start{untangle_input(positions, triangles, options), {}};
  UntangleResult& result = start.result;
  start.notes = note_of(result);
  if (result.moved.empty() || !limit.max) return start;
  const Topology topology(triangles, static_cast<Index>(positions.size()));
  const Deviation deviation = measure_deviation(input, positions, triangles, topology, options.threads);
  if (!is_over_limit(deviation.max, *limit.max)) return start;
  std::copy(input.begin(), input.end(), positions.begin());
  start.notes = {"untangling would leave the input surface by more than the limit: not done"};
  result = {result.before, result.before, {}};
  return start;
}

BoundedResult run_bounded(std::span<Vec3> positions, std::span<const Triangle> triangles,
                          const ProblemOptions& problem_options, const SmootherFactory& make_smoother,
                          const RunOptions& run_options, const DeviationLimit& limit,
                          const StepObserver& observer, const std::optional<PolishOptions>& polish,
                          const PartObserver& part_observer) {
  const double factor = scale_of(positions);
  if (factor == 1) {
    return untangle_and_run(positions, problem_options,
                            {triangles, make_smoother, run_options, limit, observer, polish, part_observer});
  }
  std::vector<Vec3> near_one(positions.begin(), positions.end());
  for (Vec3& p : near_one) p *= factor;
  const std::vector<Vec3> before = near_one;
  std::vector<Vec3> shown;
  const StepObserver observe = [&](unsigned iteration, const StepRecord& record,
                                   std::span<const Vec3> moved) {
    if (!observer) return true;
    shown.assign(moved.begin(), moved.end());
    for (Vec3& p : shown) p /= factor;
    return observer(iteration, record, shown);
  };
  const PartObserver announce = [&](const RunPart& part, std::span<const Vec3> moved) {
    if (!part_observer) return;
    shown.assign(moved.begin(), moved.end());
    for (Vec3& p : shown) p /= factor;
    part_observer(part, shown);
  };
  BoundedResult result =
      untangle_and_run(near_one, scaled(problem_options, factor),
                       {triangles, make_smoother, run_options, limit, observe, polish, announce});
  for (Index v = 0; v < positions.size(); ++v)
    if (near_one[v] != before[v]) positions[v] = near_one[v] / factor;
  return result;
}

}  // namespace isorelax
