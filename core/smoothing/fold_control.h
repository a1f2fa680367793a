#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "smoothing/step_record.h"

namespace isorelax {

/// Largest share a in [0, 1] of the corner moves d that keeps triangle x safely on its side: along x + a d
/// the signed area over the old normal is c + b a + q a^2 with c = N.N; the share is `safety` times its first
/// positive root, or 1 where that is 1 or more (paper Sec. 3; method Sec. 5). Precondition: the triangle has
/// area, 0 < safety < 1.
double fold_free_share(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& d, double safety);

/// The paper's asynchronous step-size control: scales each vertex' move by the smallest share of its
/// triangles and repeats with the scaled moves until no triangle limits. After a bounded number of rounds
/// what still folds is stopped (its vertices do not move), which always ends.
class FoldControl {
 public:
  /// Keeps a reference to the problem.
  explicit FoldControl(const SmoothingProblem& problem);

  /// Lowers record.alpha, sets kLimitFold, counts record.fold_passes.
  void limit(std::span<const Vec3> positions, StepRecord& record);

 private:
  struct Cut {
    Index triangle;
    double share;
  };
  const SmoothingProblem& problem_;
  std::vector<std::vector<Cut>> cuts_;  // per block: triangles that limit, in order
};

}  // namespace isorelax
