#include "smoothing/unguarded_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "quality/inverted.h"

namespace isorelax {

UnguardedResult run_unguarded(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& problem_options, const SmootherFactory& make_smoother,
                              const RunOptions& run_options, const StepObserver& observer) {
  const std::vector<Vec3> original(positions.begin(), positions.end());
  const SmoothingProblem problem = make_problem(original, triangles, problem_options);
  UnguardedResult result;
  result.deviation_limit = INFINITY;
  result.notes = problem.notes;
  result.limits = count_limits(problem.fixed_limits);
  result.run =
      run_with_continuation(problem, make_smoother, positions, run_options,
                            [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
                              result.limits = count_limits(record.limits);
                              return !observer || observer(iteration, record, moved);
                            });
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
