#include "smoothing/bounded_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/objective.h"
#include "smoothing/polish.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

double diagonal_of(std::span<const Vec3> positions) {
  Vec3 low = positions.front();
  Vec3 high = low;
  for (const Vec3& p : positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

/// The limit for a mesh when nobody stated one; see DeviationLimit.
double automatic_limit(std::span<const Vec3> positions, const SmoothingProblem& problem,
                       const ProblemOptions& options) {
  constexpr double kFine = 0.005;
  constexpr double kRadians = std::numbers::pi / 180;
  double sum = 0;
  std::size_t count = 0;
  for (Corner c = 0; c < 3 * problem.triangles.size(); ++c) {
    if (problem.topology.opposite(c) == kNone || problem.topology.opposite(c) < c) continue;
    const double turn = dihedral_turn_deg(positions, problem.triangles, problem.topology, c);
    if (turn >= options.features.ridge_angle_deg) continue;
    const Triangle& t = problem.triangles[c / 3];
    sum += kRadians * turn * (positions[t[next(c % 3)]] - positions[t[previous(c % 3)]]).norm();
    ++count;
  }
  const double diagonal = diagonal_of(positions);
  const double chords = count == 0 ? 0 : 0.5 * sum / (static_cast<double>(count) * diagonal);
  const double border = options.boundary == BoundaryRule::free ? problem.mean_edge_length / diagonal : 0;
  return std::max({kFine, chords, border});
}

/// Vertices of the triangles over the limit, sorted.
std::vector<Index> vertices_over(const DeviationByTriangle& deviation, std::span<const Triangle> triangles,
                                 double limit) {
  std::vector<Index> vertices;
  for (Index t = 0; t < triangles.size(); ++t) {
    if (deviation.largest[t] > limit)
      vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Vertices of triangles that lie upside down now and did not before. Whether one does depends on its
/// surroundings too, which no single step looks at.
std::vector<Index> vertices_turned_over(std::span<const Index> before, std::span<const Index> now,
                                        std::span<const Triangle> triangles) {
  std::vector<Index> turned, vertices;
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(turned));
  for (const Index t : turned) vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
  return vertices;
}

/// Adds to a sorted list. Whether that made it longer.
bool add(std::vector<Index>& sorted, std::span<const Index> more) {
  const std::size_t before = sorted.size();
  sorted.insert(sorted.end(), more.begin(), more.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted.size() > before;
}

/// Adds the neighbours of all held vertices: how the held region grows when holding the triangles alone was
/// in vain.
void grow(std::vector<Index>& held, std::span<const Triangle> triangles, std::size_t vertex_count) {
  std::vector<std::uint8_t> inside(vertex_count, 0);
  for (const Index v : held) inside[v] = 1;
  held.clear();
  std::vector<std::uint8_t> grown = inside;
  for (const Triangle& t : triangles) {
    if (inside[t[0]] + inside[t[1]] + inside[t[2]] == 0) continue;
    for (const Index v : t) grown[v] = 1;
  }
  for (Index v = 0; v < vertex_count; ++v) {
    if (grown[v] != 0) held.push_back(v);
  }
}

/// Holds more than was held in vain. Triangles whose vertices all stay within a distance of where they were
/// are no farther from the surface than that; where more is asked, or triangles turned over, vertices do not
/// move at all.
void hold_more(SurfaceHolds& holds, std::span<const Index> over, std::span<const Index> turned,
               std::span<const Triangle> triangles, std::size_t vertex_count) {
  const bool nearer = add(holds.near, over);
  if (add(holds.still, turned) || nearer || add(holds.still, over)) return;
  grow(holds.still, triangles, vertex_count);
}

/// Share of the largest distance that vertices may go: the rest is for rounding.
constexpr double kInside = 1 - 1e-9;

/// A stage that only leads to the next one need not be exact.
constexpr double kStageTolerance = 1e-4;

/// What the user is told about triangles that lay upside down; nothing where there were none.
std::vector<std::string> note_of(const UntangleResult& untangled) {
  if (untangled.before == 0) return {};
  const auto triangles = [](std::size_t count) {
    return std::to_string(count) + (count == 1 ? " triangle" : " triangles");
  };
  if (untangled.moved.empty()) {
    return {triangles(untangled.before) + " upside down " + (untangled.before == 1 ? "is" : "are") +
            " left: few folds of a surface, or held by vertices that may not move"};
  }
  return {triangles(untangled.before) + (untangled.before == 1 ? " was" : " were") +
          " upside down: untangled by moving " + std::to_string(untangled.moved.size()) +
          (untangled.moved.size() == 1 ? " vertex" : " vertices") + ", " +
          (untangled.after == 0 ? "none is"
                                : std::to_string(untangled.after) + (untangled.after == 1 ? " is" : " are")) +
          " left"};
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
  for (double exponent = 2;; exponent *= 2) {
    SmoothingProblem stage = problem;
    stage.exponent = std::min(exponent, problem.exponent);
    const bool last = stage.exponent == problem.exponent;
    RunOptions stage_options = options;
    stage_options.iterations = options.iterations - done;
    if (!last) stage_options.tolerance = std::max(options.tolerance, kStageTolerance);
    if (on_stage) on_stage(done, stage.exponent);
    result = run(*make_smoother(stage), stage, positions, stage_options, observe);
    done += result.iterations;
    seconds += result.seconds;
    if (last || done >= options.iterations || result.stopped == StopReason::cancelled ||
        result.stopped == StopReason::fixed)
      break;
  }
  result.iterations = done;
  result.seconds = seconds;
  result.before = before;
  result.after = objective.evaluate(positions);
  return result;
}

namespace {

double mean_of_smallest_angles(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                               unsigned threads) {
  const Topology topology(triangles, static_cast<Index>(positions.size()));
  return measure_quality(positions, triangles, topology, threads).mean_min_angle_deg;
}

/// The last stage, whose steps are counted on from `done`.
RunResult run_polish(const SmoothingProblem& problem, std::span<Vec3> positions, const PolishOptions& options,
                     unsigned done, const StepObserver& observer) {
  // Ends by moving nothing: any tolerance that is not 0 will do.
  return run(*make_polish(problem, options), problem, positions,
             {.iterations = options.iterations, .tolerance = 1e-12},
             [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
               return !observer || observer(done + iteration, record, moved);
             });
}

/// Whether both sets of positions surely cover the same part of one plane, so that there is nothing to
/// measure: all in it but for rounding, the border where it was, no triangle upside down before or after.
bool covers_the_same(const SmoothingProblem& problem, std::span<const Vec3> before,
                     std::span<const Vec3> after, std::span<const Index> inverted_before,
                     std::span<const Index> inverted_after) {
  constexpr double kRounding = 1e-14;
  if (!problem.plane_normal || !inverted_before.empty() || !inverted_after.empty()) return false;
  double low = INFINITY, high = -INFINITY, extent = 0;
  for (const Triangle& t : problem.triangles) {
    for (const Index v : t) {
      if (problem.topology.is_boundary(v) && before[v] != after[v]) return false;
      extent = std::max(extent, before[v].cwiseAbs().maxCoeff());
      for (const Vec3& x : {before[v], after[v]}) {
        low = std::min(low, problem.plane_normal->dot(x));
        high = std::max(high, problem.plane_normal->dot(x));
      }
    }
  }
  return high - low <= kRounding * extent;
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

/// The smoothing part of run_bounded, with deviations measured against `surface`.
BoundedResult run_from(std::span<Vec3> positions, std::span<const Vec3> surface,
                       const ProblemOptions& problem_options, const Attempts& attempts) {
  const std::span<const Triangle> triangles = attempts.triangles;
  const StepObserver& observer = attempts.observer;
  const std::vector<Vec3> original(positions.begin(), positions.end());
  ProblemOptions options = problem_options;
  std::optional<std::vector<Index>> inverted_before;
  std::optional<double> largest = attempts.limit.max;
  for (;;) {
    const SmoothingProblem problem = make_problem(original, triangles, options);
    if (!largest) largest = automatic_limit(original, problem, options);
    BoundedResult result;
    result.deviation_limit = *largest;
    result.notes = problem.notes;
    result.limits = count_limits(problem.fixed_limits);
    const auto announce = [&](unsigned done, double exponent, bool polish) {
      if (attempts.part_observer) attempts.part_observer({done, exponent, polish, options.holds}, positions);
    };
    result.run = run_with_continuation(
        problem, attempts.make_smoother, positions, attempts.run_options,
        [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
          result.limits = count_limits(record.limits);
          return !observer || observer(iteration, record, moved);
        },
        [&](unsigned done, double exponent) { announce(done, exponent, false); });
    if (attempts.polish && result.run.stopped != StopReason::cancelled) {
      announce(result.run.iterations, problem.exponent, true);
      result.polish = run_polish(problem, positions, *attempts.polish, result.run.iterations, observer);
    }
    const std::vector<Index> inverted =
        inverted_triangles(positions, triangles, problem.topology, options.threads);
    if (!inverted_before)
      inverted_before = inverted_triangles(original, triangles, problem.topology, options.threads);
    std::vector<Index> over;
    if (!std::ranges::equal(surface, original) ||
        !covers_the_same(problem, original, positions, *inverted_before, inverted)) {
      const DeviationByTriangle deviation =
          measure_deviation_by_triangle(surface, positions, triangles, problem.topology, options.threads);
      result.deviation = deviation.whole;
      if (deviation.whole.max > *largest) over = vertices_over(deviation, triangles, *largest);
    }
    const std::vector<Index> turned = vertices_turned_over(*inverted_before, inverted, triangles);
    if ((over.empty() && turned.empty()) || result.run.stopped == StopReason::fixed) return result;

    options.holds.distance = kInside * *largest * diagonal_of(surface);
    hold_more(options.holds, over, turned, triangles, positions.size());
    std::copy(original.begin(), original.end(), positions.begin());
  }
}

/// `run_from` with the exponent asked for, or the better one of 2 and 1.
BoundedResult run_with_some_exponent(std::span<Vec3> positions, std::span<const Vec3> surface,
                                     const ProblemOptions& options, const Attempts& attempts) {
  if (options.exponent) return run_from(positions, surface, options, attempts);
  const std::vector<Vec3> original(positions.begin(), positions.end());
  const double before = mean_of_smallest_angles(original, attempts.triangles, options.threads);
  BoundedResult result = run_from(positions, surface, options, attempts);
  const double after = mean_of_smallest_angles(positions, attempts.triangles, options.threads);
  if (after >= before || result.run.stopped == StopReason::cancelled) return result;
  ProblemOptions linear = options;
  linear.exponent = 1;
  std::copy(original.begin(), original.end(), positions.begin());
  result = run_from(positions, surface, linear, attempts);
  result.notes.emplace_back(
      "the exponent is 1: with 2, the worst triangles would get better at the cost of all others");
  return result;
}

/// Untangles, smooths from there, and measures against what came in.
BoundedResult untangle_and_run(std::span<Vec3> positions, const ProblemOptions& problem_options,
                               const Attempts& attempts) {
  const std::span<const Triangle> triangles = attempts.triangles;
  const DeviationLimit& limit = attempts.limit;
  const std::vector<Vec3> input(positions.begin(), positions.end());
  UntangleResult untangled = untangle_input(positions, triangles, problem_options);
  std::vector<std::string> notes = note_of(untangled);
  const Topology topology(triangles, static_cast<Index>(positions.size()));
  const auto deviation = [&] {
    return measure_deviation(input, positions, triangles, topology, problem_options.threads);
  };
  if (!untangled.moved.empty() && limit.max && deviation().max > *limit.max) {
    std::copy(input.begin(), input.end(), positions.begin());
    notes = {"untangling would leave the input surface by more than the limit: not done"};
    untangled = {untangled.before, untangled.before, {}};
  }
  const bool moved = !untangled.moved.empty();
  const std::vector<Vec3> start(positions.begin(), positions.end());
  BoundedResult result =
      run_with_some_exponent(positions, limit.max ? input : start, problem_options, attempts);
  // Triangles upside down in a plane cover what the sound ones cover as well.
  if (moved && !plane_normal(input, triangles, topology, problem_options.threads))
    result.deviation = deviation();
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
