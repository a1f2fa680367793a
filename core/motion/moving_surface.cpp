#include "motion/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/degenerate.h"
#include "mesh/parallel.h"
#include "quality/triangle_metrics.h"
#include "surface/closest_point.h"
#include "surface/deviation.h"
#include "surface/vertex_class.h"

namespace isorelax {
namespace {

/// Of the time of the whole motion: shorter steps lead nowhere.
constexpr double kLeastStepShare = 1e-10;
/// Of the start's bounding box: how far a vertex may go.
constexpr double kMostDiagonals = 1e9;

/// The corners of each triangle's reference. Throws MeshError, UsageError.
std::vector<std::array<Vec3, 3>> reference_corners(const ReferenceChoice& choice, std::span<const Vec3> start,
                                                   std::span<const Triangle> triangles) {
  const ReferenceMesh reference = make_reference(choice, start, triangles);
  if (!reference.replaced().empty())
    throw MeshError("triangle " + std::to_string(reference.replaced()[0]) + " of the reference has no area");
  const auto* mesh = std::get_if<MeshReference>(&choice);
  std::vector<std::array<Vec3, 3>> corners;
  for (Index t = 0; t < triangles.size(); ++t) {
    const Triangle& v = triangles[t];
    const double side = std::sqrt(2 / std::sqrt(3.0) * reference.d1(t));
    if (mesh != nullptr)
      corners.push_back({mesh->positions[v[0]], mesh->positions[v[1]], mesh->positions[v[2]]});
    else
      corners.push_back({Vec3::Zero(), side * Vec3::UnitX(), Vec3(0.5 * side, std::sqrt(0.75) * side, 0)});
  }
  return corners;
}

}  // namespace

MovingSurface::MovingSurface(const TriangleMesh& start, Motion motion, const MovingSurfaceOptions& options)
    : triangles_(start.triangles),
      topology_(start.triangles, start.vertex_count()),
      start_(start.positions),
      motion_(std::move(motion)),
      options_(options) {
  check(start);
  diagonal_ = bounding_diagonal(start_);
  closed_ = encloses_volume(start_, triangles_, topology_, options_.threads);
  start_volume_ = enclosed_volume(start_, triangles_, options_.threads);
  if (std::holds_alternative<InitialReference>(options_.reference))
    options_.reference = MeshReference{start_};
  state_.positions = start_;
  state_.next_step = options_.step;
  if (motion_.field) integrator_.emplace(*motion_.field, options_.threads);
  if (!motion_.field || options_.integration == Integration::face_offsetting)
    offsetting_.emplace(triangles_, topology_, FaceOffsettingOptions{}, options_.threads);
  if (options_.redistribution == Redistribution::carrier) make_carrier(start);
}

void MovingSurface::check(const TriangleMesh& start) const {
  if (start.triangles.empty()) throw MeshError("the mesh has no triangle");
  if (!(options_.step > 0) || !std::isfinite(options_.step)) throw UsageError("the step is not positive");
  if (options_.tolerance && !(*options_.tolerance > 0)) throw UsageError("the tolerance is not positive");
  if (options_.every == 0) throw UsageError("redistribution every 0 steps");
  if (!motion_.field)
    for (Index v = 0; v < topology_.vertex_count(); ++v)
      if ((topology_.flags(v) & kInconsistentVertex) != 0)
        throw MeshError("triangles about vertex " + std::to_string(v) +
                        " are oriented inconsistently: they have no common normal to move along");
  if (options_.redistribution == Redistribution::none) return;
  for (Index t = 0; t < triangles_.size(); ++t) {
    const Triangle& v = triangles_[t];
    if (has_no_area(start_[v[0]], start_[v[1]], start_[v[2]]))
      throw MeshError("triangle " + std::to_string(t) + " of the start has no area");
  }
  for (Index v = 0; v < topology_.vertex_count(); ++v)
    if (topology_.corners_of(v).empty())
      throw MeshError("vertex " + std::to_string(v) + " is in no triangle");
}

void MovingSurface::make_carrier(const TriangleMesh& start) {
  const VertexClasses classes =
      classify_vertices(start_, triangles_, topology_, FeatureOptions{}, options_.threads);
  EdgeWalls walls(3 * triangles_.size(), 0);
  for (Corner c = 0; c < walls.size(); ++c)
    if (topology_.opposite(c) == kNone) walls[c] = 1;
  for (const FeatureEdge& crease : classes.creases) {
    walls[crease.corner] = 1;
    if (topology_.opposite(crease.corner) != kNone) walls[topology_.opposite(crease.corner)] = 1;
  }
  for (Index v = 0; v < start.vertex_count(); ++v) {
    const Corner corner = topology_.corners_of(v)[0];
    MaterialPoint point{corner / 3, Vec3::Zero()};
    point.weights[corner % 3] = 1;
    state_.points.push_back(point);
    const bool smooth = classes.classes[v] == VertexClass::smooth && topology_.flags(v) == 0;
    always_held_.push_back(smooth ? 0 : 1);
  }
  held_ = always_held_;
  carrier_ = start_;
  carrier_volume_ = start_volume_;
  material_ = std::make_unique<MaterialSurface>(start_, triangles_, topology_, walls);
  map_ = std::make_unique<FlowMap>(*material_, topology_, walls, options_.threads);
  relaxation_ = std::make_unique<CarrierRelaxation>(triangles_, topology_,
                                                    reference_corners(options_.reference, start_, triangles_),
                                                    options_.carrier, options_.threads);
  relaxation_->allow_heights(*map_, state_.points, start_);
  middles_ = std::make_unique<EdgeMiddles>(triangles_, topology_, options_.threads);
  if (closed_ && options_.balance_volume)
    balance_ = std::make_unique<VolumeBalance>(triangles_, topology_, options_.threads);
}

double MovingSurface::next_dt(double time, std::size_t step, double proposed, double end) const {
  // Fixed steps stand on a grid, so that no rounding gathers.
  constexpr double kRounding = 1e-9;
  const double next = options_.tolerance ? time + proposed : static_cast<double>(step + 1) * options_.step;
  return next > end - kRounding * options_.step ? end - time : next - time;
}

void MovingSurface::offset_along(std::vector<Vec3>& x, double time, double dt) {
  constexpr unsigned kMostParts = 4096;
  const std::vector<Vec3> before = x;
  for (unsigned parts = 1;; parts *= 2) {
    bool folds = false;
    for (unsigned i = 0; i < parts && !folds; ++i) {
      moved_ = x;
      integrator_->step(moved_, time + dt * i / parts, dt / parts);
      folds = !offsetting_->advect(moved_, x);
    }
    report_.parts = parts;
    if (!folds) return;
    x = before;
    if (parts == kMostParts) throw MotionError(time, kNone, "the surface folds: no shorter step helps");
  }
}

/// Moves points by one step; returns its length. `proposed` is the one that error control asks for.
double MovingSurface::move(std::vector<Vec3>& x, double time, double end, std::size_t step,
                           double& proposed) {
  report_ = {};
  double dt = next_dt(time, step, proposed, end);
  if (!motion_.field) {
    report_.parts = offsetting_->propagate(motion_.speed, time, dt, x).parts;
    check_encloses(x, time + dt);
  } else if (options_.tolerance) {
    dt = controlled_step(x, time, dt, end, proposed);
    if (options_.integration == Integration::face_offsetting)
      offset_along(x, time, dt);
    else
      std::swap(x, moved_);
  } else if (options_.integration == Integration::face_offsetting) {
    offset_along(x, time, dt);
  } else {
    integrator_->step(x, time, dt);
  }
  check_in_reach(x, time + dt);
  report_.dt = dt;
  return dt;
}

/// Takes a step of dt or less, as error control has it, to `moved_`; returns its length. Near a time at which
/// the motion has no end, steps would get shorter and shorter until time stands still.
double MovingSurface::controlled_step(std::span<const Vec3> x, double time, double dt, double end,
                                      double& proposed) {
  const StepSizeControl control(*options_.tolerance * diagonal_);
  const double least = kLeastStepShare * end;
  for (;;) {
    const StepError error = integrator_->pair_step(x, time, dt, moved_);
    const double next = control.next(dt, error.largest);
    const bool accepted = control.accepts(error.largest);
    const bool arrives = accepted && !(time + dt < end);
    if (next < least && !arrives)
      throw MotionError(time, error.vertex, "no step is short enough for the tolerance");
    if (accepted) {
      if (!arrives) proposed = next;
      return dt;
    }
    dt = next;
  }
}

/// Farther away, a shape is lost to rounding.
void MovingSurface::check_in_reach(std::span<const Vec3> x, double time) const {
  for (Index v = 0; v < x.size(); ++v)
    if (!((x[v] - start_[v]).norm() <= kMostDiagonals * diagonal_))
      throw MotionError(
          time, v, "the motion blows up: the vertex is over a billion times the mesh's size from its start");
}

/// A closed surface that propagates through itself can do so with every triangle on its side.
void MovingSurface::check_encloses(std::span<const Vec3> x, double time) const {
  if (!closed_ || enclosed_volume(x, triangles_, options_.threads) * start_volume_ > 0) return;
  Index smallest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles_) {
    const double area = area_vector(x[t[0]], x[t[1]], x[t[2]]).squaredNorm();
    if (area < least) {
      least = area;
      smallest = t[0];
    }
  }
  throw MotionError(time, smallest, "the surface folds: it has gone through itself and encloses no volume");
}

double MovingSurface::wanted_volume() const {
  if (motion_.keeps_volume) return start_volume_;
  return start_volume_ * (enclosed_volume(carrier_, triangles_, options_.threads) / carrier_volume_);
}

bool MovingSurface::choose_held(std::span<const Vec3> positions) {
  if (options_.only_below_deg <= 0) return true;
  std::vector<std::uint8_t> near(positions.size(), 0);
  bool any = false;
  for (const Triangle& t : triangles_) {
    if (measure_triangle(positions, t).min_angle_deg >= options_.only_below_deg) continue;
    any = true;
    for (const Index v : t) near[v] = 1;
  }
  constexpr int kRings = 2;
  for (int ring = 0; ring < kRings; ++ring) {
    const std::vector<std::uint8_t> inner = near;
    for (const Triangle& t : triangles_)
      if (inner[t[0]] + inner[t[1]] + inner[t[2]] > 0)
        for (const Index v : t) near[v] = 1;
  }
  held_.resize(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v)
    held_[v] = near[v] == 0 || (!always_held_.empty() && always_held_[v] != 0) ? 1 : 0;
  return any;
}

void MovingSurface::redistribute_tangent(std::vector<Vec3>& x) {
  ProblemOptions problem_options;
  problem_options.weights = options_.weights;
  problem_options.exponent = 1;  // as in Eq. 2 of the paper
  problem_options.reference = options_.reference;
  problem_options.surface = SurfaceRule::tangent;
  problem_options.untangle = UntangleRule::off;
  problem_options.threads = options_.threads;
  if (options_.only_below_deg > 0)
    for (Index v = 0; v < held_.size(); ++v)
      if (held_[v] != 0) problem_options.pinned.push_back(v);
  const SmoothingProblem problem = make_problem(x, triangles_, problem_options);
  const auto smoother = make_smoother(problem, options_.solver);
  RunOptions run_options;
  run_options.iterations = options_.iterations;
  run_options.tolerance = 0;
  const RunResult result = run(*smoother, problem, x, run_options);
  report_.relaxation = {result.before.energy, result.after.energy, result.iterations};
}

void MovingSurface::advance(double end) {
  MovingState next = state_;
  const bool due = (state_.step + 1) % options_.every == 0;
  if (options_.redistribution != Redistribution::carrier) {
    next.time = state_.time + move(next.positions, state_.time, end, state_.step, next.next_step);
    if (due && options_.redistribution == Redistribution::tangent && choose_held(next.positions)) {
      const std::vector<Vec3> before = next.positions;
      redistribute_tangent(next.positions);
      const ClosestPointIndex surface(before, triangles_);
      DistanceSum sum;
      for (const Vec3& x : next.positions) sum.add(surface.closest(x).distance);
      report_.deviation = sum.result();
      report_.redistributed = true;
    }
  } else {
    std::vector<Vec3> carrier = carrier_;
    next.time = state_.time + move(carrier, state_.time, end, state_.step, next.next_step);
    std::swap(carrier_, carrier);
    map_->set_carrier(carrier_);
    parallel_for_blocks(next.points.size(), options_.threads, [&](std::size_t begin, std::size_t stop) {
      for (std::size_t v = begin; v < stop; ++v) next.positions[v] = map_->position(next.points[v]);
    });
    if (due && choose_held(next.positions)) {
      report_.relaxation = relaxation_->relax(*map_, held_, next.points, next.positions);
      report_.redistributed = true;
    }
    const std::vector<Vec3> on_surface = next.positions;
    if (balance_)
      report_.balance = balance_->balance(*map_, next.points, always_held_, wanted_volume(), next.positions);
    measure_deviation_of(next, on_surface);
  }
  // On the grid of fixed steps again, not where rounding led.
  if (!options_.tolerance && next.time != end)
    next.time = static_cast<double>(state_.step + 1) * options_.step;
  next.step = state_.step + 1;
  state_ = std::move(next);
}

void MovingSurface::measure_deviation_of(const MovingState& state, std::span<const Vec3> on_surface) {
  middles_->measure(*map_, state.points, state.positions);
  DistanceSum sum;
  for (std::size_t e = 0; e < middles_->edges().size(); ++e)
    sum.add(middles_->distance(*material_, e, state.positions));
  for (std::size_t v = 0; v < on_surface.size(); ++v) sum.add((state.positions[v] - on_surface[v]).norm());
  report_.deviation = sum.result();
}

void MovingSurface::restore(const MovingState& state, double end) {
  if (state.positions.size() != start_.size() ||
      state.points.size() != (options_.redistribution == Redistribution::carrier ? start_.size() : 0))
    throw MeshError("the state has another number of vertices than the start");
  for (const MaterialPoint& point : state.points)
    if (point.triangle >= triangles_.size() || !point.weights.allFinite() || point.weights.minCoeff() < 0 ||
        std::abs(point.weights.sum() - 1) > 1e-9)
      throw MeshError("the state's material points are not those of the start");
  if (options_.redistribution == Redistribution::carrier) {
    // The carrier goes its way whatever its points do: it is moved again, from the start.
    std::vector<Vec3> carrier = start_;
    double time = 0;
    double proposed = options_.step;
    for (std::size_t step = 0; step < state.step; ++step) {
      time += move(carrier, time, std::max(end, state.time), step, proposed);
      if (!options_.tolerance && time != end) time = static_cast<double>(step + 1) * options_.step;
    }
    if (time != state.time && !(std::abs(time - state.time) <= 1e-9 * options_.step))
      throw MeshError("the state's time is not that of its step: it was made with other steps");
    carrier_ = std::move(carrier);
    map_->set_carrier(carrier_);
  }
  state_ = state;
}

}  // namespace isorelax
