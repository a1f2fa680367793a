#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"
#include "surface/deviation.h"

namespace isorelax {

/// Finds what a run did to the surface that it must not do, and says what to hold so that it does not.
class SurfaceWatch {
 public:
  /// What is wrong with a result.
  struct Finding {
    Deviation deviation;
    std::vector<Index> far;  ///< vertices of triangles over the limit, or near it where one is over
    /// Of triangles that lie upside down and did not at the start, of those that face away from the surface
    /// beside them, as it was, and did not, and of those that cross others where none did.
    std::vector<Index> turned;
    std::size_t turned_triangles = 0, crossing_triangles = 0;

    [[nodiscard]] bool sound() const { return far.empty() && turned.empty(); }
  };

  /// Deviations are measured from `surface`, runs begin at `start`. Keeps references to all three.
  SurfaceWatch(std::span<const Vec3> surface, std::span<const Vec3> start, const SmoothingProblem& problem);

  /// `limit` is over the diagonal of the surface.
  [[nodiscard]] Finding look(std::span<const Vec3> positions, double limit) const;

  /// The largest distance that steps may lead to under a limit, in length units.
  [[nodiscard]] double largest_distance(double limit) const;

  /// Holds more than was held in vain. Where something crosses, steps that can have to look out for that;
  /// where steps that keep the surface near let it go too far between the edges that they look at, they have
  /// to keep it nearer, within a smaller share of the largest distance; at last vertices do not move at all,
  /// as where triangles turned over, and then their neighbours neither. `limit` is the one that was looked
  /// with.
  void hold_more(SurfaceHolds& holds, double& share, const Finding& found, double limit,
                 bool steps_can_look_out) const;

 private:
  [[nodiscard]] std::vector<Index> facing_away(std::span<const Vec3> positions) const;
  [[nodiscard]] bool covers_the_same(std::span<const Vec3> after, std::span<const Index> inverted) const;
  [[nodiscard]] bool keeps_border(std::span<const Vec3> after, double rounding) const;

  std::span<const Vec3> surface_, start_;
  const SmoothingProblem& problem_;
  std::vector<Index> inverted_;                            // at the start
  std::shared_ptr<const ClosestPointIndex> at_the_start_;  // of a surface that is not flat
};

}  // namespace isorelax
