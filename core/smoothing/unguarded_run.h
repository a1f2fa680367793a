#pragma once

#include "smoothing/bounded_run.h"

namespace isorelax {

/// What an unguarded run did; its deviation_limit is infinite.
struct UnguardedResult : BoundedResult {
  /// Triangles that lie upside down now and did not before, ascending.
  std::vector<Index> turned_over;
  /// A vertex that ran away, which ended the run: more than a million diagonals of the input from where it
  /// was, or nowhere at all. The deviation is infinite then, and turned_over is not looked for.
  std::optional<Index> ran_away;
};

/// Smooths a mesh in place, once, and takes what comes of it: for methods as published, which know no limit.
/// Who wants no triangle turned over looks at the result. Throws as make_problem.
UnguardedResult run_unguarded(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& problem_options, const SmootherFactory& make_smoother,
                              const RunOptions& run_options, const StepObserver& observer = {});

}  // namespace isorelax
