#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "smoothing/step_record.h"
#include "smoothing/triangle_batch.h"

namespace isorelax {

/// What a vertex gathers from its triangles.
struct VertexSums {
  Vec3 gradient = Vec3::Zero();
  double stiffness = 0;        ///< sum of s_{i+} + s_{i-}: the denominator of Eq. 9
  SymmetricMatrix covariance;  ///< sum of 2 area n n^T; left zero for planar problems
};

/// What is kept of a triangle at the last evaluation: two cache lines. All zero for untreated triangles.
struct alignas(64) TriangleState {
  double e1x, e1y, e1z, e2x, e2y, e2z;  ///< edges from vertex 0 to vertices 1 and 2
  double g0x, g0y, g0z, g1x, g1y, g1z;  ///< gradients of E^p at corners 0 and 1; corner 2 has minus their sum
  double scale;                         ///< 1 / sqrt(D2)
  double stiffness;       ///< s_{i+} + s_{i-} times the derivative of E^p where it is the same at all corners
  double shape, powered;  ///< K and E^p
};

/// Value and gradient of sum E^p over the treated triangles at one set of positions.
///
/// Two passes: `evaluate` runs once over the triangles and keeps a few numbers of each, `gather` sums them
/// around a vertex in corner order. No vertex is written by two threads and every sum has one order: results
/// do not depend on the number of threads.
class Objective {
 public:
  /// Keeps a pointer to the problem.
  explicit Objective(const SmoothingProblem& problem);

  /// Evaluates all triangles at these positions and returns the totals (gradient_norm left 0).
  const StepTotals& evaluate(std::span<const Vec3> positions);
  /// Evaluates again only these triangles, whose vertices alone have moved since: same totals as `evaluate`,
  /// to the bit.
  const StepTotals& update(std::span<const Vec3> positions, std::span<const Index> triangles);

  /// Remembers that the numbers held belong to these positions.
  void mark(std::span<const Vec3> positions) { at_.assign(positions.begin(), positions.end()); }
  /// Whether the numbers held were marked as belonging to exactly these positions.
  [[nodiscard]] bool is_at(std::span<const Vec3> positions) const;
  [[nodiscard]] const StepTotals& totals() const { return totals_; }

  /// Sums around a vertex at the positions of the last evaluation.
  [[nodiscard]] VertexSums gather(Index vertex) const;

  /// Per triangle, at the last evaluation.
  [[nodiscard]] const TriangleState& state(Index t) const { return states_[t]; }

  /// Per triangle, at the last evaluation; 0 for untreated triangles.
  [[nodiscard]] std::span<const double> shape() const { return shape_; }
  [[nodiscard]] std::span<const double> area() const { return area_; }
  /// E^p: what is summed up.
  [[nodiscard]] std::span<const double> powered() const { return powered_; }
  /// E of one triangle.
  [[nodiscard]] double energy(Index t) const {
    return problem_->weights.shape * shape_[t] + problem_->weights.area * area_[t];
  }

 private:
  void evaluate_batch(std::span<const Vec3> positions, const BatchIds& ids);
  void sum_block(std::size_t block);
  void sum_blocks();
  template <bool kEquilateral, bool kCovariance>
  [[nodiscard]] VertexSums gather_as(Index vertex) const;

  const SmoothingProblem* problem_;  // a pointer, so that two objectives can be swapped
  ReferenceBatch uniform_{};         // where all references are the same
  std::vector<TriangleState> states_;
  std::vector<std::array<double, 3>> corner_stiffness_;  // where the references differ from corner to corner
  std::vector<double> shape_, area_, powered_;
  std::vector<std::uint8_t> movable_;
  std::vector<Vec3> at_;
  std::vector<StepTotals> partials_;
  StepTotals totals_;
};

}  // namespace isorelax
