#pragma once

#include <optional>

#include "motion/motion_choices.h"

namespace isorelax {

/// A step of a moving surface, by what it began with.
struct StepPlace {
  std::size_t step = 0;  ///< steps before it
  double time = 0;       ///< at its beginning
  double dt = 0;         ///< its length
};

/// Tells a step's motion from its redistribution: where the motion alone would have taken a vertex.
///
/// Where vertices go with the flow that is the flow of the vertex; where faces are offset, it is a step of
/// the whole mesh without redistribution.
class MotionShare {
 public:
  /// Keeps a reference to the set-up. Throws as MovingSurface.
  explicit MotionShare(const MotionSetup& setup);

  /// The displacement, in length units. Throws MotionError.
  [[nodiscard]] Vec3 of(std::span<const Vec3> before, std::span<const Vec3> after, const StepPlace& place,
                        Index vertex);

 private:
  const MotionSetup* setup_;
  std::optional<MovingSurface> alone_;
  std::vector<Vec3> moved_;
};

}  // namespace isorelax
