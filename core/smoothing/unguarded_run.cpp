#include "smoothing/unguarded_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "quality/inverted.h"

namespace isorelax {
namespace {

/// Diagonals of the input that no smoothing takes a vertex: beyond, coordinates soon overflow.
constexpr double kAway = 1e6;

std::optional<Index> vertex_beyond(double distance, std::span<const Vec3> from, std::span<const Vec3> to) {
  for (Index v = 0; v < from.size(); ++v)
    if (!((to[v] - from[v]).stableNorm() <= distance)) return v;
  return std::nullopt;
}

}  // namespace

UnguardedResult run_unguarded(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& problem_options, const SmootherFactory& make_smoother,
                              const RunOptions& run_options, const StepObserver& observer) {
  const std::vector<Vec3> original(positions.begin(), positions.end());
  const SmoothingProblem problem = make_problem(original, triangles, problem_options);
  UnguardedResult result;
  result.deviation_limit = INFINITY;
  result.notes = problem.notes;
  result.limits = count_limits(problem.fixed_limits);
  const double away = kAway * bounding_diagonal(original);
  result.run =
      run_with_continuation(problem, make_smoother, positions, run_options,
                            [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
                              result.limits = count_limits(record.limits);
                              result.ran_away = vertex_beyond(away, original, moved);
                              return !result.ran_away && (!observer || observer(iteration, record, moved));
                            });
  if (result.ran_away) {
    result.run.stopped = StopReason::diverged;
    result.deviation.max = result.deviation.rms = INFINITY;
    return result;
  }
  result.deviation = measure_deviation(original, positions, triangles, problem.topology, problem.threads);
  const auto inverted = [&](std::span<const Vec3> x) {
    return inverted_triangles(x, triangles, problem.topology, problem.threads);
  };
  const std::vector<Index> before = inverted(original);
  const std::vector<Index> after = inverted(positions);
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(result.turned_over));
  return result;
}

}  // namespace isorelax
