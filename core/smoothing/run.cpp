#include "smoothing/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "smoothing/objective.h"

namespace isorelax {
namespace {

/// Steps in a row that have to gain next to nothing: a single one may have been cut back.
constexpr unsigned kIdleSteps = 5;

/// What a decrease of the energy is measured against: the energy itself, but no more than twice the least
/// that a mesh of so many triangles can have. Slivers that nothing can be done about may have a million times
/// that, and all others would still get better.
double energy_scale(const SmoothingProblem& problem, double energy) {
  const double least = std::pow(2 * (problem.weights.shape + problem.weights.area), problem.exponent);
  return std::min(energy, 2 * least * static_cast<double>(problem.triangle_count()));
}

/// What the norm of the gradient is measured against: the first one, but no more than what vertices have
/// whose triangles all change by their energies within an edge length. Slivers make the first one huge.
double gradient_scale_of(const SmoothingProblem& problem, const StepTotals& first) {
  const double energy_of_edge = energy_scale(problem, first.movable_energy) / problem.mean_edge_length;
  return std::min(first.gradient_norm, energy_of_edge / std::sqrt(problem.vertex_count()));
}

/// The stop that the last record asks for, if any.
std::optional<StopReason> stop_after(const Smoother& smoother, const StepRecord& record,
                                     const RunResult& result, const RunOptions& options,
                                     double gradient_scale, unsigned idle_steps) {
  if (!(options.tolerance > 0) || smoother.leads_on()) return std::nullopt;
  if (!smoother.descends()) {
    return result.relative_move <= options.tolerance ? std::optional(StopReason::movement) : std::nullopt;
  }
  if (record.before.gradient_norm <= options.tolerance * gradient_scale) return StopReason::gradient;
  if (record.moved == 0) return record.energy_passes > 0 ? StopReason::stalled : StopReason::movement;
  if (result.relative_move <= options.tolerance) return StopReason::movement;
  if (idle_steps >= kIdleSteps) return StopReason::energy;
  return std::nullopt;
}

}  // namespace

std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::iterations:
      return "the allowed number of iterations was done";
    case StopReason::gradient:
      return "the gradient fell below the tolerance";
    case StopReason::energy:
      return "the energy hardly falls any more";
    case StopReason::movement:
      return "no vertex moves by more than the tolerance";
    case StopReason::stalled:
      return "no step along the direction lowers the energy";
    case StopReason::fixed:
      return "no vertex may move";
    case StopReason::cancelled:
      return "cancelled";
    case StopReason::breakpoint:
      return "a breakpoint held";
    case StopReason::diverged:
      return "the vertices ran away";
  }
  return "unknown";
}

std::string to_string(StopReason reason, const std::string& condition) {
  return reason == StopReason::breakpoint ? "breakpoint: " + condition : std::string(to_string(reason));
}

std::string_view name_of(StopReason reason) {
  switch (reason) {
    case StopReason::iterations:
      return "iterations";
    case StopReason::gradient:
      return "gradient";
    case StopReason::energy:
      return "energy";
    case StopReason::movement:
      return "movement";
    case StopReason::stalled:
      return "stalled";
    case StopReason::fixed:
      return "fixed";
    case StopReason::cancelled:
      return "cancelled";
    case StopReason::breakpoint:
      return "breakpoint";
    case StopReason::diverged:
      return "diverged";
  }
  return "unknown";
}

RunResult run(Smoother& smoother, const SmoothingProblem& problem, std::span<Vec3> positions,
              const RunOptions& options, const StepObserver& observer) {
  RunResult result;
  const auto start = std::chrono::steady_clock::now();
  const bool any_free = std::any_of(problem.mobility.begin(), problem.mobility.end(),
                                    [](Mobility m) { return m != Mobility::none; });
  if (!any_free) result.stopped = StopReason::fixed;
  StepRecord record;
  double first_gradient = 0;
  double gradient_scale = 0;
  unsigned idle_steps = 0;
  for (unsigned i = 0; any_free && i < options.iterations; ++i) {
    smoother.step(positions, record);
    apply_step(record, positions);
    ++result.iterations;
    if (i == 0) {
      result.before = record.before;
      first_gradient = record.before.gradient_norm;
      gradient_scale = gradient_scale_of(problem, record.before);
    }
    result.after = record.after;
    result.gradient_ratio = first_gradient > 0 ? record.before.gradient_norm / first_gradient : 0;
    result.energy_change = (record.before.movable_energy - record.after.movable_energy) /
                           energy_scale(problem, record.before.movable_energy);
    idle_steps = result.energy_change <= options.tolerance && !smoother.leads_on() ? idle_steps + 1 : 0;
    result.relative_move = record.largest_move / problem.mean_edge_length;
    if (observer && !observer(result.iterations, record, positions)) {
      result.stopped = StopReason::cancelled;
      break;
    }
    if (const auto stop = stop_after(smoother, record, result, options, gradient_scale, idle_steps)) {
      result.stopped = *stop;
      break;
    }
  }
  if (result.iterations == 0) result.before = result.after = Objective(problem).evaluate(positions);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace isorelax
