#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// What a vertex gathers from its triangles.
struct VertexSums {
  Vec3 gradient = Vec3::Zero();
  double stiffness = 0;        ///< sum of s_{i+} + s_{i-}: the denominator of Eq. 9
  SymmetricMatrix covariance;  ///< sum of 2 area n n^T; left zero for planar problems
};

/// Value and gradient of sum E^p over the treated triangles at one set of positions.
///
/// Two passes: `evaluate` runs once over the triangles and keeps five numbers of each, `gather` sums them
/// around a vertex in corner order. No vertex is written by two threads and every sum has one order: results
/// do not depend on the number of threads.
class Objective {
 public:
  /// Keeps a reference to the problem.
  explicit Objective(const SmoothingProblem& problem);

  /// Totals at these positions (gradient_norm left 0). Keeps what `gather` needs.
  StepTotals evaluate(std::span<const Vec3> positions);

  /// Whether the last `evaluate` was at exactly these positions.
  [[nodiscard]] bool is_at(std::span<const Vec3> positions) const;
  [[nodiscard]] const StepTotals& totals() const { return totals_; }

  /// Sums around a vertex; `positions` are those of the last `evaluate`.
  [[nodiscard]] VertexSums gather(std::span<const Vec3> positions, Index vertex) const;

  /// E^p of every triangle at these positions, 0 for untreated ones.
  void triangle_energies(std::span<const Vec3> positions, std::vector<double>& powered) const;

  /// K, S and E of every triangle into the record (0 for untreated ones).
  void record_triangles(std::span<const Vec3> positions, StepRecord& record) const;

 private:
  /// N / sqrt(D2), and s and t of the gradient times the derivative of E^p, t times sqrt(D2) / D2.
  struct TriangleState {
    double mx, my, mz, s, t;
  };

  struct Terms;
  template <bool kEquilateral>
  [[nodiscard]] Terms terms(std::span<const Vec3> positions, Index t) const;
  template <bool kEquilateral>
  void evaluate_block(std::span<const Vec3> positions, std::size_t begin, std::size_t end,
                      StepTotals& partial);
  template <bool kEquilateral, bool kCovariance>
  [[nodiscard]] VertexSums gather_as(std::span<const Vec3> positions, Index vertex) const;

  const SmoothingProblem* problem_;  // a pointer, so that two objectives can be swapped
  std::vector<TriangleState> states_;
  std::vector<Vec3> at_;
  std::vector<StepTotals> partials_;
  StepTotals totals_;
};

}  // namespace isorelax
