#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/topology.h"
#include "surface/vertex_class.h"

namespace isorelax {

/// What kept a vertex from the move its gradient asked for; a bit mask per vertex.
enum Limit : std::uint16_t {
  kLimitPinned = 1,       ///< held by the user, or because the mesh is flawed there
  kLimitCorner = 2,       ///< no tangent direction
  kLimitRidge = 4,        ///< only along the ridge
  kLimitBoundary = 8,     ///< held or guided by the border of the surface
  kLimitFold = 16,        ///< cut back: a triangle would have folded, or been worse than the worst
  kLimitEnergy = 32,      ///< cut back: the energy would have risen, or is not finite there
  kLimitSurface = 64,     ///< cut back: too far from the input surface
  kLimitConverged = 128,  ///< asked for no move worth making
};
inline constexpr std::size_t kLimitBits = 8;
/// The limit of a bit, 0 to kLimitBits - 1.
constexpr Limit limit_of_bit(std::size_t bit) {
  return static_cast<Limit>(1U << bit);
}

/// What made a step. Written to traces: new ones come last.
enum class StepKind : std::uint8_t {
  unknown,     ///< of a trace that does not tell
  jacobi,      ///< the paper's: along the gradient of each vertex
  newton,      ///< of each vertex, with its block of the Hessian
  lbfgs,       ///< of all vertices together
  even_out,    ///< sweeps to the means of neighbours (make_even_out)
  one_by_one,  ///< each vertex downhill from where the ones before it are by then (make_one_by_one)
  laplacian,
  angle_based,
  raise_worst,  ///< of the last stage, for the worst angles
  raise_mean,   ///< of the last stage, for the mean of the triangles' smallest angles
};
inline constexpr std::size_t kStepKinds = 10;

/// Sums over the mesh at one set of positions.
struct StepTotals {
  double energy = 0;        ///< sum of E^exponent over the treated triangles: what is minimised
  double shape = 0;         ///< sum of K
  double area = 0;          ///< sum of S
  double worst_energy = 0;  ///< largest E
  /// The same of those triangles alone that have a vertex that may move: what solvers compare. High powers of
  /// a sliver that nothing can be done about leave nothing of the others in the sum of all.
  double movable_energy = 0, worst_movable_energy = 0;
  double gradient_norm = 0;  ///< 2-norm of the gradient in the free tangent coordinates; only in `before`
};

/// One vertex cut back in a round of the step control.
struct ControlCut {
  Index vertex = 0;
  double alpha = 1;        ///< what is left of its move
  Index triangle = kNone;  ///< that would have folded; kNone: it was the energy, the distance, or many
};
/// One round of the step control, against folds (kLimitFold) or distance from the surface (kLimitSurface), or
/// of the energy guard (kLimitEnergy).
struct ControlPass {
  Limit why = kLimitFold;
  std::vector<ControlCut> cuts;
};

/// What a step found on its way: for looking at it stage by stage.
struct StepDetail {
  std::vector<std::uint8_t> dimensions;  ///< of each vertex' tangent space: 0, 1 or 2
  std::vector<Vec3> axis;      ///< unit normal of a plane, unit direction of a line; zero where it has none
  std::vector<Vec3> tangent;   ///< V V^T g: the gradient's part in the tangent space
  std::vector<Vec3> proposed;  ///< the move before it is bent to the surface and cut back
  std::vector<ControlPass> passes;  ///< in the order in which they were made
};

/// Everything one step of a smoother found out. Computing it moves nothing; `apply_step` does.
///
/// Arrays are indexed by vertex or by triangle. The command line, the tests, the traces, the plots and the
/// editor all read this record: nothing is computed a second way for display.
struct StepRecord {
  std::vector<Vec3> gradient;      ///< of the energy at each vertex, all three components
  std::vector<Vec3> displacement;  ///< proposed move, already in the tangent space
  std::vector<double> alpha;  ///< accepted share of it, 0..1: the vertex goes to x + alpha * displacement
  std::vector<std::uint16_t> limits;  ///< bits of Limit
  std::vector<VertexClass> tangent_class;

  /// Per triangle K, S and E before the step; filled only when detail is asked for.
  std::vector<double> shape, area, energy;
  /// The way to the step; only when all detail is asked for.
  std::optional<StepDetail> detail;

  StepKind kind = StepKind::unknown;
  StepTotals before, after;
  double largest_move = 0;     ///< length of the longest accepted move
  unsigned fold_passes = 0;    ///< rounds of the asynchronous step-size control, against distance too
  unsigned energy_passes = 0;  ///< rounds of the energy guard
  std::size_t moved = 0;       ///< vertices that move
};

/// Begins a round of the step control in the record, and notes in it that a vertex was cut back: nothing is
/// done without detail.
void begin_pass(StepRecord& record, Limit why);
void note_cut(StepRecord& record, Index vertex, Index triangle);

/// The share of its move that each vertex has left after so many rounds of the step control. Precondition:
/// the record has detail.
[[nodiscard]] std::vector<double> alpha_after(const StepRecord& record, std::size_t passes);

/// The triangle that set a vertex' share last; kNone where nothing or the energy did. Without detail kNone.
[[nodiscard]] Index triangle_that_cut(const StepRecord& record, Index vertex);

/// Memory held by the record's arrays, in bytes.
[[nodiscard]] std::size_t bytes_of(const StepRecord& record);

/// How many vertices are limited by each bit, in bit order.
std::array<std::size_t, kLimitBits> count_limits(std::span<const std::uint16_t> limits);

/// Name of one bit of Limit for people: "pinned", "corner", ...
std::string_view limit_name(Limit limit);

/// Name of what made a step for people: "Newton", "even out", ...
std::string_view step_kind_name(StepKind kind);

/// positions[v] += alpha[v] * displacement[v]: exactly the positions whose totals are `record.after`.
void apply_step(const StepRecord& record, std::span<Vec3> positions);

}  // namespace isorelax
