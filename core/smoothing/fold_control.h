#pragma once

#include <optional>
#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "smoothing/surface_limit.h"
#include "smoothing/trial.h"
#include "smoothing/triangle_batch.h"
#include "smoothing/turn_limit.h"

namespace isorelax {

/// Share a in (0, 1] of the way from triangle x to triangle y that keeps it safely on its side. Along x + a
/// (y - x) the signed area over the old normal is c + b a + q a^2 with c = N.N (paper Sec. 3; method Sec. 5):
/// 0.6 of the first positive root where that is below 1.25, else 1. Precondition: x has area.
double fold_free_share(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& y);

/// A direction for all vertices is far too long where more than this share of them would fold something: then
/// all go so much less far.
inline constexpr double kManyFolds = 0.3;
inline constexpr double kShorter = 0.25;

/// The paper's asynchronous step-size control, which also makes no triangle worse than the problem's worst
/// angles and on curved surfaces lets none turn too far from its normal at the start of the run or back from
/// its neighbours (TurnLimit): scales each vertex' move by the smallest share of its triangles and repeats
/// with the scaled moves until no triangle limits. After a bounded number of rounds what still folds is
/// stopped (its vertices do not move), which always ends. Rounds after the first look only at triangles whose
/// vertices were scaled. Likewise what would be farther from the surface as it was than the problem allows
/// (SurfaceLimit): vertices there slide along the limit first, then are cut back. And what would come to
/// cross something, where the problem asks for that.
class FoldControl {
 public:
  /// Keeps a reference to the problem.
  explicit FoldControl(const SmoothingProblem& problem);

  /// Checks all triangles of the trial. Moves that only make sense `together` are cut back alike where many
  /// of them would have to be: cut back one after another, nothing is left of any.
  void limit(Trial& trial, StepRecord& record, bool together = false);
  /// Checks these triangles first, the only ones whose moves changed since the trial was last free of folds.
  /// Returns all triangles whose moves it changed.
  std::vector<Index> limit(Trial& trial, StepRecord& record, std::span<const Index> triangles);

 private:
  struct Cut {
    Index vertex;
    Index triangle;
    double share;
  };
  void check(const Trial& trial, const BatchIds& ids, bool all_are_checked, std::vector<Cut>& cuts);
  [[nodiscard]] bool lets_go(const Trial& trial, Index triangle) const;
  [[nodiscard]] bool faces_away(std::span<const Vec3> x, Index triangle) const;
  [[nodiscard]] bool may_have_folds(Index triangle, double cosine, bool all_are_checked) const;
  [[nodiscard]] std::vector<Cut> check(const Trial& trial, std::span<const Index> triangles);
  [[nodiscard]] std::vector<Cut> check_all(const Trial& trial);
  /// Gives up, and returns nothing, once it has cut back more than so many vertices.
  std::optional<std::vector<Index>> shrink_few_until_free(Trial& trial, StepRecord& record,
                                                          std::vector<Cut> cuts, double most);
  std::vector<Index> shrink_until_free(Trial& trial, StepRecord& record, std::vector<Cut> cuts);
  std::vector<Index> shrink_until_near(Trial& trial, StepRecord& record);
  std::vector<Index> shrink_until_apart(Trial& trial, StepRecord& record, std::vector<Index> crossing);

  const SmoothingProblem& problem_;
  TurnLimit turns_;
  SurfaceLimit surface_;
  /// Triangles that had turned by more than they may when last checked, or are not checked.
  std::vector<std::uint8_t> has_turned_;
  std::vector<std::vector<Cut>> block_cuts_;
};

}  // namespace isorelax
