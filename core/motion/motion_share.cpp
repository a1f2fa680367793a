#include "motion/motion_share.h"

namespace isorelax {
namespace {

/// A tolerance, over the diagonal, that any step keeps.
constexpr double kAnyError = 1e100;

}  // namespace

MotionShare::MotionShare(const MotionSetup& setup) : setup_(&setup) {
  const bool offsets_faces = !setup.motion.field || setup.options.integration == Integration::face_offsetting;
  if (!offsets_faces || setup.options.redistribution == Redistribution::none) return;
  MovingSurfaceOptions options = setup.options;
  options.redistribution = Redistribution::none;
  // Error control has chosen the length of the step already, perhaps by another mesh: that of the carrier.
  if (options.tolerance) options.tolerance = kAnyError;
  alone_.emplace(setup.start, setup.motion, options);
}

Vec3 MotionShare::of(std::span<const Vec3> before, std::span<const Vec3> after, const StepPlace& place,
                     Index vertex) {
  if (setup_->options.redistribution == Redistribution::none) return after[vertex] - before[vertex];
  if (alone_) {
    MovingState state;
    state.step = place.step;
    state.time = place.time;
    state.next_step = place.dt;
    state.positions.assign(before.begin(), before.end());
    alone_->restore(state, setup_->until);
    alone_->advance(setup_->until);
    return alone_->state().positions[vertex] - before[vertex];
  }
  std::vector<Vec3> point{before[vertex]};
  RungeKutta flow(*setup_->motion.field, 1);
  if (setup_->options.tolerance) {
    flow.pair_step(point, place.time, place.dt, moved_);
    return moved_[0] - before[vertex];
  }
  flow.step(point, place.time, place.dt);
  return point[0] - before[vertex];
}

}  // namespace isorelax
