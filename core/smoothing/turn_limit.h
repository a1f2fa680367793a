#pragma once

#include <array>
#include <span>
#include <vector>

#include "smoothing/problem.h"

namespace isorelax {

/// How far the triangles of a curved surface may turn: none by more than 60 degrees from its normal at the
/// start, and none over onto its neighbour: an edge across which the surface turned by less than 120 degrees
/// at the start does not come to turn by more than 119, nor one of less than 150 by more than 149. What turns
/// by more than 120 or 150 is where triangles count as folded over or upside down (folded_patches.h,
/// inverted.h). Edges of triangles that turned back from their neighbours already are free.
class TurnLimit {
 public:
  /// Cosine of the largest turn of a triangle.
  static constexpr double kLeastCosine = 0.5;

  /// Keeps a reference to the problem.
  explicit TurnLimit(const SmoothingProblem& problem);

  /// Whether there is such a limit: not in a plane, where signed areas tell all.
  [[nodiscard]] bool applies() const { return !problem_.initial_normals.empty(); }

  /// Of two triangles that share an edge at least one has a cosine to its own initial normal below this where
  /// one folds onto the other; squared, with its sign.
  [[nodiscard]] double folding_cosine(Index triangle) const { return folding_cosines_[triangle]; }

  /// Whether two triangles that share an edge and have these area vectors fold onto each other.
  [[nodiscard]] bool is_fold(Index t, const Vec3& area_of_t, Index u, const Vec3& area_of_u) const;

  /// The neighbours that this triangle folds onto with all vertices at `x`, by the corner opposite to the
  /// edge; kNone where it does not.
  [[nodiscard]] std::array<Index, 3> folds_onto(std::span<const Vec3> x, Index triangle) const;

 private:
  [[nodiscard]] double cosine_at_start(Index t, Index u) const;
  [[nodiscard]] bool turns_back(Index t) const;
  [[nodiscard]] double room_of(Index t) const;
  /// Whether the edge between two triangles may turn as it likes.
  [[nodiscard]] bool is_free(Index t, Index u) const;

  const SmoothingProblem& problem_;
  std::vector<std::uint8_t> turned_back_;
  std::vector<double> folding_cosines_;
};

}  // namespace isorelax
