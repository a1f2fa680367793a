#pragma once

#include <optional>

#include "smoothing/run.h"

namespace isorelax {

/// Whether a step of a baseline is cut back.
enum class BaselineGuard : std::uint8_t {
  on,   ///< a move that turns a triangle over is cut back, as in all other steps
  off,  ///< as published: triangles may fold
};

/// How much each neighbour counts in Laplacian smoothing.
enum class LaplacianWeighting : std::uint8_t {
  uniform,  ///< all alike
  length,   ///< by the length of the edge to it (the paper's Table 1)
};

struct LaplacianOptions {
  LaplacianWeighting weighting = LaplacianWeighting::length;
  BaselineGuard guard = BaselineGuard::on;
  /// Share of the way to the mean of the neighbours. None: 1 for uniform weights, 1/2 for lengths, whose full
  /// moves overshoot and, all made at once, fold the mesh.
  std::optional<double> relaxation;
  RecordDetail detail = RecordDetail::vertices;
};

/// Laplacian smoothing: x_i goes to sum w_ij x_j / sum w_ij over the neighbours j, with w_ij = 1 or |x_j -
/// x_i|; of that move the part in the tangent space is made. An edge of the border counts in full, at a
/// vertex of any number of triangles. Knows no energy: the record's totals only tell what became of it. Keeps
/// a reference to the problem.
std::unique_ptr<Smoother> make_laplacian(const SmoothingProblem& problem,
                                         const LaplacianOptions& options = {});

/// How much each neighbour counts in angle-based smoothing.
enum class AngleWeighting : std::uint8_t {
  plain,  ///< all alike: the basic form
  angle,  ///< by 1 / (a1 + a2)^2: sharp angles first
};

struct AngleBasedOptions {
  AngleWeighting weighting = AngleWeighting::angle;
  BaselineGuard guard = BaselineGuard::on;
  /// Share of the way to the mean place.
  double relaxation = 1;
  RecordDetail detail = RecordDetail::vertices;
};

/// Angle-based smoothing (T. Zhou and K. Shimada, An angle-based approach to two-dimensional mesh smoothing,
/// 9th International Meshing Roundtable, 2000): around each neighbour j, with the angles a1 and a2 at j on
/// both sides of edge ij, x_i is turned by (a1 - a2) / 2 to their bisector; it goes to the mean of these
/// places. On a curved surface the turn is about the surface normal at i, and of the move the part in the
/// tangent space is made. An edge of the border has one angle only and counts for nothing. Keeps a reference
/// to the problem.
std::unique_ptr<Smoother> make_angle_based(const SmoothingProblem& problem,
                                           const AngleBasedOptions& options = {});

}  // namespace isorelax
