#include "motion/motion_run.h"

#include <chrono>
#include <cmath>
#include <memory>

#include "surface/closest_point.h"
#include "surface/deviation.h"

namespace isorelax {
namespace {

/// Vertices are points of the start that go with the flow.
bool goes_with_flow(const MotionSetup& setup) {
  return setup.options.redistribution == Redistribution::none &&
         setup.options.integration == Integration::vertices;
}

SurfacePlacement placement_of(const MotionSetup& setup) {
  if (!setup.sphere) return {};
  return [sphere = *setup.sphere](const Vec3& x) -> Vec3 {
    return sphere.centre + sphere.radius * (x - sphere.centre).normalized();
  };
}

}  // namespace

MotionRun::MotionRun(MotionSetup setup, unsigned dense_levels)
    : setup_(std::move(setup)), surface_(setup_.start, setup_.motion, setup_.options) {
  if (dense_levels > 0) {
    if (!setup_.motion.field) throw UsageError("--exact is for velocity fields");
    dense_.emplace(setup_.start, dense_levels, placement_of(setup_), setup_.options.threads);
  }
  if (setup_.motion.place && !goes_with_flow(setup_)) {
    nearest_ = placement_of(setup_);
    if (!nearest_) {
      auto index = std::make_shared<ClosestPointIndex>(setup_.start.positions, setup_.start.triangles);
      nearest_ = [index](const Vec3& x) { return index->closest(x).point; };
    }
  }
  encloses_ = encloses_volume(setup_.start.positions, setup_.start.triangles, surface_.topology(),
                              setup_.options.threads);
  start_volume_ = enclosed_volume(setup_.start.positions, setup_.start.triangles, setup_.options.threads);
}

TriangleMesh MotionRun::mesh() const {
  TriangleMesh mesh;
  mesh.positions = surface_.state().positions;
  mesh.triangles = setup_.start.triangles;
  return mesh;
}

void MotionRun::restore(const MovingState& state) {
  if (!dense_) return surface_.restore(state, setup_.until);
  // The copy goes the same steps again.
  MotionSetup plain = setup_;
  plain.options.redistribution = Redistribution::none;
  plain.options.integration = Integration::vertices;
  MovingSurface steps(plain.start, plain.motion, plain.options);
  while (steps.state().step < state.step) {
    const double before = steps.state().time;
    steps.advance(setup_.until);
    dense_->advance(*setup_.motion.field, before, steps.report().dt);
  }
  surface_.restore(state, setup_.until);
}

void MotionRun::advance() {
  const double before = surface_.state().time;
  const auto start = std::chrono::steady_clock::now();
  surface_.advance(setup_.until);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (dense_) dense_->advance(*setup_.motion.field, before, surface_.report().dt);
}

Distances MotionRun::error_of_place() const {
  const MovingState& state = surface_.state();
  const auto& place = setup_.motion.place;
  DistanceSum sum;
  for (std::size_t v = 0; v < state.positions.size(); ++v) {
    const Vec3& x = state.positions[v];
    const Vec3 from = nearest_ ? nearest_(place(x, -state.time)) : setup_.start.positions[v];
    sum.add((x - place(from, state.time)).norm());
  }
  return sum.result();
}

std::optional<Distances> MotionRun::known_error() const {
  if (setup_.motion.place) return error_of_place();
  if (!setup_.sphere) return std::nullopt;
  const double time = surface_.state().time;
  double radius = setup_.sphere->radius;
  if (setup_.motion.constant_speed) {
    radius += time * *setup_.motion.constant_speed;
  } else if (setup_.motion.period) {
    const double turns = time / *setup_.motion.period;
    if (std::abs(turns - std::round(turns)) > 1e-12) return std::nullopt;
  } else if (time > 0) {
    return std::nullopt;
  }
  return distance_from_sphere(surface_.state().positions, setup_.sphere->centre, radius);
}

MotionEntry MotionRun::measure(Detail detail) const {
  MotionEntry entry;
  const MovingState& state = surface_.state();
  entry.step = state.step;
  entry.time = state.time;
  entry.measure =
      measure_motion(state.positions, setup_.start.triangles, surface_.topology(), setup_.options.threads);
  entry.encloses = encloses_;
  if (encloses_) entry.volume_change = (entry.measure.volume - start_volume_) / start_volume_;
  entry.report = surface_.report();
  entry.error = known_error();
  if (dense_ && detail == Detail::exact)
    entry.exact = dense_->distances(state.positions, setup_.start.triangles);
  entry.seconds = seconds_;
  return entry;
}

}  // namespace isorelax
