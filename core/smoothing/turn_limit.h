#pragma once

#include <array>
#include <span>
#include <vector>

#include "smoothing/problem.h"

namespace isorelax {

/// Edges across which the surface turns so far that they count as folds: by more than 119 degrees; sharp are
/// those by more than 149. Fresh are those that turned by less than 120, or 150, at the start.
struct Folds {
  std::uint8_t all = 0, fresh = 0, fresh_sharp = 0;

  Folds& operator+=(const Folds& other) {
    all += other.all;
    fresh += other.fresh;
    fresh_sharp += other.fresh_sharp;
    return *this;
  }
  [[nodiscard]] bool any() const { return all > 0; }
};

/// Whether a triangle faces away from the surface as it was, where that is nearest to its centroid, and its
/// initial normal does not: where that does, it lies about a crease, or on the other side of something thin.
[[nodiscard]] bool faces_away(const ClosestPointIndex& surface, const Vec3& initial_normal,
                              const std::array<Vec3, 3>& corners);

/// How far the triangles of a curved surface may turn: none by more than 60 degrees from its normal at the
/// start, or from its surroundings' if it stood on them, and none back from its neighbours, with a fresh fold
/// of over 149 degrees, or with folds at two edges, or at its only one, of which one is fresh. Triangles that
/// count as upside down have such folds, and so have patches of one or two that count as folded over
/// (inverted.h, folded_patches.h), whose limits are 120 and 150 degrees. What had turned back at the start
/// may do what it likes. None that has turned by more than kLittleTurned2 allows faces away.
class TurnLimit {
 public:
  /// Cosine of the largest turn of a triangle.
  static constexpr double kLeastCosine = 0.5;

  /// Keeps a reference to the problem.
  explicit TurnLimit(const SmoothingProblem& problem);

  /// Whether there is such a limit: not in a plane, where signed areas tell all.
  [[nodiscard]] bool applies() const { return !problem_.initial_normals.empty(); }

  /// Whether a triangle that is beyond the largest turn is let go there, by its area vectors before and
  /// after: it comes nearer to its initial normal, where that is not its own, or lies as the surroundings do
  /// that it stood on.
  [[nodiscard]] bool lets_go(Index triangle, const Vec3& before, const Vec3& after) const;

  /// Of the two triangles at a fresh fold at least one has a cosine to its own initial normal below this;
  /// squared, with its sign.
  [[nodiscard]] double folding_cosine(Index triangle) const { return folding_cosines_[triangle]; }

  /// Squared cosine of the turn up to which a triangle has no fold, fresh or not, to a neighbour that has
  /// turned by no more than it may; 2 where it may have one all the same.
  [[nodiscard]] double unfolded_cosine(Index triangle) const { return unfolded_cosines_[triangle]; }

  /// Squared cosine of the turn up to which no triangle is looked at closer: 20 degrees.
  static constexpr double kLittleTurned2 = 0.883;
  /// The same of the problem's triangle with these corners; false where no surface is known.
  [[nodiscard]] bool faces_away(Index triangle, const std::array<Vec3, 3>& corners) const;

  /// The fold between two triangles with these area vectors that share an edge.
  [[nodiscard]] Folds fold_between(Index t, const Vec3& area_of_t, Index u, const Vec3& area_of_u) const;
  /// All folds at a triangle's edges with all vertices at `x`, except those to one neighbour.
  [[nodiscard]] Folds folds_of(std::span<const Vec3> x, Index triangle, Index except = kNone) const;
  /// Whether a triangle with these folds has turned back.
  [[nodiscard]] bool turns_back(Index triangle, const Folds& folds) const;

  /// Calls act(triangle) for this triangle and its neighbours over folds, where one of them has turned back,
  /// and for those over the folds of that one.
  template <typename Act>
  void for_turned_back(std::span<const Vec3> x, Index triangle, const Act& act) const {
    if (!folds_of(x, triangle).any()) return;  // nearly all
    const auto around = [&](Index t) {
      if (!turns_back(t, folds_of(x, t))) return;
      act(t);
      for (unsigned k = 0; k < 3; ++k)
        if (const Index u = over_fold(x, t, k); u != kNone) act(u);
    };
    around(triangle);
    for (unsigned k = 0; k < 3; ++k)
      if (const Index u = over_fold(x, triangle, k); u != kNone) around(u);
  }

 private:
  [[nodiscard]] double cosine_at_start(Index t, Index u) const;
  [[nodiscard]] std::uint8_t folds_to_turn_back(Index t) const;
  [[nodiscard]] double room_of(Index t) const;
  [[nodiscard]] double room_beside_others(Index t) const;
  /// The neighbour over the edge opposite to a corner if that is a fold, else kNone.
  [[nodiscard]] Index over_fold(std::span<const Vec3> x, Index triangle, unsigned corner) const;
  [[nodiscard]] Vec3 area_at(std::span<const Vec3> x, Index triangle) const;

  const SmoothingProblem& problem_;
  const ClosestPointIndex* surface_ = nullptr;
  std::vector<std::uint8_t> needed_;  // folds of either kind that a triangle has turned back with
  std::vector<double> folding_cosines_, unfolded_cosines_;
};

}  // namespace isorelax
