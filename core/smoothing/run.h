#pragma once

#include <functional>
#include <memory>
#include <string>

#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// How detailed a record is.
enum class RecordDetail : std::uint8_t {
  vertices,
  vertices_and_triangles,
  stages,  ///< these, and StepRecord::detail
};

/// One way of finding the next positions. A step is pure: it fills the caller's record (whose arrays are
/// reused) and moves nothing.
class Smoother {
 public:
  virtual ~Smoother() = default;
  virtual void step(std::span<const Vec3> positions, StepRecord& record) = 0;
  /// Whether every step lowers the problem's energy; a run of another method stops by its moves alone.
  [[nodiscard]] virtual bool descends() const { return true; }
  /// Whether steps of another kind are still to come: then small ones are not the end of a run.
  [[nodiscard]] virtual bool leads_on() const { return false; }
};

/// Makes the smoother for a problem.
using SmootherFactory = std::function<std::unique_ptr<Smoother>(const SmoothingProblem&)>;

/// Options of the paper's step (Sec. 3, Eq. 9).
struct JacobiOptions {
  /// Factor on the displacement of Eq. 9.
  double relaxation = 0.9;
  RecordDetail detail = RecordDetail::vertices;
};

/// The paper's Jacobi step: direction of Eq. 9, asynchronous step-size control, energy guard. Keeps a
/// reference to the problem.
std::unique_ptr<Smoother> make_jacobi(const SmoothingProblem& problem, const JacobiOptions& options = {});

/// Options of the block-Jacobi Newton step.
struct NewtonOptions {
  /// Factor on each vertex' own Newton step: at 1 neighbours that move at once overshoot.
  double relaxation = 0.7;
  /// Share of the vertex' last move that is added to its step where that still leads downhill: what one
  /// vertex learns of those far away comes through its neighbours, and this carries it on.
  double momentum = 0.6;
  RecordDetail detail = RecordDetail::vertices;
};

/// Every vertex takes a damped Newton step of its own in its tangent space, with the second derivatives of
/// its triangles made positive definite (method Sec. 6); at slivers several, to the minimum of its own
/// triangles. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_newton(const SmoothingProblem& problem, const NewtonOptions& options = {});

/// Options of L-BFGS.
struct LbfgsOptions {
  /// Pairs of moves and gradient changes that are remembered.
  unsigned memory = 10;
  RecordDetail detail = RecordDetail::vertices;
};

/// Limited-memory BFGS over all free tangent coordinates, preconditioned by the Newton blocks: converges. Its
/// steps depend on the steps before; at positions it did not lead to it starts afresh. Keeps a reference to
/// the problem.
std::unique_ptr<Smoother> make_lbfgs(const SmoothingProblem& problem, const LbfgsOptions& options = {});

/// Which way of stepping.
enum class Solver : std::uint8_t {
  automatic,  ///< evening out (make_even_out) and Newton steps while they pay, then L-BFGS to convergence,
              ///< with steps of one vertex after another (make_one_by_one) where many are at the limit; a
              ///< free border slides before it leaves its outline (make_slide_first)
  jacobi,     ///< the paper's
  newton,     ///< make_newton; where it finds no step or jams, one vertex after another
  lbfgs,      ///< make_lbfgs, likewise
};
/// The solver with its default options. Keeps a reference to the problem.
std::unique_ptr<Smoother> make_smoother(const SmoothingProblem& problem, Solver solver,
                                        RecordDetail detail = RecordDetail::vertices);

/// Why a run ended.
enum class StopReason : std::uint8_t {
  iterations,  ///< the allowed number was done
  gradient,    ///< the tangent gradient fell below tolerance times its start
  energy,      ///< the energy hardly falls any more
  movement,    ///< no vertex moves any more
  stalled,     ///< no step along the direction lowers the energy
  fixed,       ///< no vertex may move
  cancelled,   ///< the caller said stop
  breakpoint,  ///< the caller said stop where a breakpoint held
  diverged,    ///< without a guard the vertices ran away
};
/// One sentence for people.
std::string_view to_string(StopReason reason);
/// The same, and of a breakpoint what held there.
std::string to_string(StopReason reason, const std::string& condition);
/// One word for programs: "iterations", "gradient", ...
std::string_view name_of(StopReason reason);

struct RunOptions {
  unsigned iterations = 1000;
  /// Relative threshold of all three tests: gradient norm against its start, energy decrease against the
  /// energy (RunResult::energy_change) in five steps in a row, largest move against the mean edge length. 0:
  /// only the iteration count stops the run.
  double tolerance = 1e-6;
};

struct RunResult {
  unsigned iterations = 0;
  StopReason stopped = StopReason::iterations;
  double seconds = 0;
  StepTotals before, after;
  double gradient_ratio = 0;  ///< last tangent gradient norm over the first
  /// Last decrease of the energy, relative to it, but to no more than twice the least energy that so many
  /// triangles can have: slivers must not hide what the others gain.
  double energy_change = 0;
  double relative_move = 0;  ///< last largest move over the mean edge length
};

/// Called after each accepted step, with the positions already moved; returning false stops the run.
using StepObserver =
    std::function<bool(unsigned iteration, const StepRecord& record, std::span<const Vec3> positions)>;

/// Steps a smoother until a stop reason holds. With a smoother that descends it never raises the energy and
/// never turns a triangle over.
RunResult run(Smoother& smoother, const SmoothingProblem& problem, std::span<Vec3> positions,
              const RunOptions& options, const StepObserver& observer = {});

}  // namespace isorelax
