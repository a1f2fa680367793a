#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "smoothing/bounded_run.h"
#include "trace/trace.h"
#include "trace/trace_diff.h"

namespace isorelax {

/// What the words of a run ask for: what its steps are made with, but for what only the run itself finds out
/// (TracePart).
struct RunPlan {
  ProblemOptions problem;
  SmootherFactory make_smoother;
  PolishOptions polish;
};

/// Understands the words of a run on a mesh, which is that at the start of the run. Throws Error where they
/// are not understood, or a file that they name is gone.
using PlanReader = std::function<RunPlan(const RunWords& words, const TriangleMesh& mesh)>;

/// The problem of a part. Throws as make_problem and base_of.
[[nodiscard]] SmoothingProblem make_part_problem(const Trace& trace, const TracePart& part,
                                                 const RunPlan& plan);

/// make_polish with records that say as much as those of the solvers: gradients, triangles and stages, too.
[[nodiscard]] std::unique_ptr<Smoother> make_explained_polish(const SmoothingProblem& problem,
                                                              const PolishOptions& options);

/// A smoother for the first step of a part; of a polish, make_explained_polish. Keeps a reference to the
/// problem.
[[nodiscard]] std::unique_ptr<Smoother> make_part_smoother(const SmoothingProblem& problem,
                                                           const TracePart& part, const RunPlan& plan);

/// Makes all iterations of a trace again, every part from where it was recorded to begin, and tells the first
/// one that leads elsewhere. Precondition: the trace has parts. Throws as `read_plan` and make_part_problem.
[[nodiscard]] std::optional<TraceParting> replay_parts(const Trace& trace, const PlanReader& read_plan);

}  // namespace isorelax
