#pragma once

#include <vector>

#include "quality/triangle_metrics.h"
#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// What one triangle tells one of its vertices: the gradient of E^p at it, by its two terms.
struct TriangleShare {
  Index triangle = 0;
  Vec3 shape = Vec3::Zero();  ///< p E^(p-1) w_s grad K
  Vec3 area = Vec3::Zero();   ///< p E^(p-1) w_a grad S
};

/// A measurement that decides a vertex' class, with the threshold it is compared with, both in degrees.
struct ClassMeasure {
  double value = 0;
  double threshold = 0;
};

/// Why a vertex moved in a step, or did not: what the step's record holds about it, and what that was made
/// from.
struct VertexExplanation {
  Index vertex = 0;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  ///< where it stands
  // Class.
  VertexClass tangent_class = VertexClass::smooth;
  Vec3 eigenvalues = Vec3::Zero();  ///< of the normal covariance, largest first, length units squared
  ClassMeasure spread, angle_defect, sharpest_edge, turn;
  double margin_deg = 0;  ///< from another class
  unsigned dimensions = 0;
  std::vector<Vec3> basis;  ///< orthonormal, as many vectors as the tangent space has dimensions
  // Gradient.
  Vec3 gradient = Vec3::Zero();       ///< the record's
  std::vector<TriangleShare> shares;  ///< of the treated triangles around it, in corner order
  Vec3 quotient = Vec3::Zero();       ///< the same gradient by central differences of the energy
  /// Distance from the record's gradient to the sum of the shares and to the quotient, over the larger norm.
  double share_error = 0, quotient_error = 0;
  Vec3 tangent = Vec3::Zero();  ///< its part in the tangent space
  // Move.
  Vec3 proposed = Vec3::Zero();      ///< as asked for
  Vec3 displacement = Vec3::Zero();  ///< bent to the surface
  double alpha = 1;
  std::uint16_t limits = 0;
  Index set_by = kNone;  ///< the triangle that set alpha
};

/// Errors below this are rounding: of the shares' sum, and of difference quotients.
inline constexpr double kShareErrorLimit = 1e-6;
inline constexpr double kQuotientErrorLimit = 1e-3;

/// `record` is of the step from `before`, with detail; `features` are those the problem was made with.
/// Precondition: the vertex exists.
[[nodiscard]] VertexExplanation explain_vertex(const SmoothingProblem& problem,
                                               const FeatureOptions& features, std::span<const Vec3> before,
                                               const StepRecord& record, Index vertex);

/// Whether the gradients of a record are those of the plain formulas, over all vertices.
struct GradientCheck {
  std::size_t wrong = 0;  ///< vertices whose share_error is over the limit
  Index worst = kNone;    ///< the vertex with the largest error, when there are any
  double largest = 0;     ///< its error
};

/// As explain_vertex finds it for each vertex. Parallel.
[[nodiscard]] GradientCheck check_gradients(const SmoothingProblem& problem, std::span<const Vec3> before,
                                            const StepRecord& record);

/// One corner of a triangle: who it is and where it goes.
struct CornerMove {
  Index vertex = 0;
  Vec3 move = Vec3::Zero();  ///< as accepted
  double alpha = 1;
  std::uint16_t limits = 0;
};

/// A triangle in a plane, its first side along x.
using FlatTriangle = std::array<std::array<double, 2>, 3>;

/// What a triangle is to the energy, at one moment.
struct TriangleMoment {
  FlatTriangle outline{};
  double shape = 0, area = 0, energy = 0;  ///< K, S and E
  TriangleMetrics metrics;
  std::array<double, 3> angles_deg{};
  std::array<double, 2> singular_values{};  ///< of A, which maps the reference to the triangle
};

/// A triangle before and after a step, and what the step does to it.
struct TriangleExplanation {
  Index triangle = 0;
  bool treated = true;
  TriangleMoment before, after;  ///< K, S and E before are those of the record
  double reference_area = 0;
  FlatTriangle reference{};
  std::array<CornerMove, 3> corners;
};

/// Precondition: the triangle exists.
[[nodiscard]] TriangleExplanation explain_triangle(const SmoothingProblem& problem,
                                                   std::span<const Vec3> before, const StepRecord& record,
                                                   Index triangle);
/// The same between any two positions of the mesh, without a step that led from one to the other.
[[nodiscard]] TriangleExplanation compare_triangle(const SmoothingProblem& problem,
                                                   std::span<const Vec3> before, std::span<const Vec3> after,
                                                   Index triangle);

}  // namespace isorelax
