#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// Where a vertex ends that is sent to `target`: there, or on the frozen surface near it if there is one; and
/// half-way at most from the triangles as they were to where these must be near, unless it stays on fits.
[[nodiscard]] Vec3 bring_back(const SmoothingProblem& problem, Index vertex, const Vec3& target);

/// Where a record's accepted moves lead: x + alpha * displacement for every vertex, kept up to date while
/// alphas are cut back, together with the triangles that this touched.
class Trial {
 public:
  /// Keeps a reference to the problem.
  explicit Trial(const SmoothingProblem& problem)
      : problem_(problem), bends_(problem.surface != nullptr), stamp_(problem.triangle_count(), 0) {}

  /// Starts from the record's tangent moves, all alphas 1, and bends the displacements to the surface; where
  /// they lead there already, not before one is cut back.
  void start(std::span<const Vec3> from, StepRecord& record, bool lead_there = false);

  /// Multiplies a vertex' alpha by `factor`, sets `why` among its limits and moves the trial. No effect, and
  /// false, for a vertex that does not move.
  bool cut(StepRecord& record, Index vertex, double factor, Limit why);

  /// Cuts all vertices that move to the same alpha, whatever theirs was. None counts as touched.
  void cut_all(StepRecord& record, double alpha, Limit why);

  /// Takes from a vertex' move in its tangent plane what leads outwards, and moves the trial. False for one
  /// that does not move so.
  bool slide(StepRecord& record, Index vertex, const Vec3& outwards);

  [[nodiscard]] std::span<const Vec3> from() const { return from_; }
  [[nodiscard]] std::span<const Vec3> to() const { return to_; }

  /// Triangles at the vertices cut since the last call, each once, in the order they were touched.
  std::vector<Index> take_touched();

 private:
  void place(StepRecord& record, Index vertex);
  void touch(Index vertex);

  const SmoothingProblem& problem_;
  bool bends_;  // moves need not end where they were proposed to
  std::span<const Vec3> from_;
  std::vector<Vec3> tangent_;  // the moves as proposed
  std::vector<Vec3> to_;
  std::vector<std::uint32_t> stamp_;  // per triangle: round in which it was last noted
  std::uint32_t round_ = 1;
  std::vector<Index> touched_;
};

}  // namespace isorelax
