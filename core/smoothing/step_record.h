#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "surface/vertex_class.h"

namespace isorelax {

/// What kept a vertex from the move its gradient asked for; a bit mask per vertex.
enum Limit : std::uint16_t {
  kLimitPinned = 1,       ///< held by the user, or because the mesh is flawed there
  kLimitCorner = 2,       ///< no tangent direction
  kLimitRidge = 4,        ///< only along the ridge
  kLimitBoundary = 8,     ///< held or guided by the border of the surface
  kLimitFold = 16,        ///< cut back: a triangle would have folded
  kLimitEnergy = 32,      ///< cut back: the energy would have risen
  kLimitSurface = 64,     ///< cut back: too far from the input surface
  kLimitConverged = 128,  ///< asked for no move worth making
};

/// Sums over the mesh at one set of positions.
struct StepTotals {
  double energy = 0;         ///< sum of E^exponent over the treated triangles: what is minimised
  double shape = 0;          ///< sum of K
  double area = 0;           ///< sum of S
  double worst_energy = 0;   ///< largest E
  double gradient_norm = 0;  ///< 2-norm of the gradient in the free tangent coordinates; only in `before`
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

  StepTotals before, after;
  double largest_move = 0;     ///< length of the longest accepted move
  unsigned fold_passes = 0;    ///< rounds of the asynchronous step-size control
  unsigned energy_passes = 0;  ///< rounds of the energy guard
  std::size_t moved = 0;       ///< vertices that move
};

/// How many vertices are limited by each bit, in bit order.
std::array<std::size_t, 8> count_limits(std::span<const std::uint16_t> limits);

/// Name of one bit of Limit for people: "pinned", "corner", ...
std::string_view limit_name(Limit limit);

/// positions[v] += alpha[v] * displacement[v]: exactly the positions whose totals are `record.after`.
void apply_step(const StepRecord& record, std::span<Vec3> positions);

}  // namespace isorelax
