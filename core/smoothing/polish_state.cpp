#include "smoothing/polish_state.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/parallel.h"
#include "smoothing/newton_block.h"
#include "smoothing/tangent.h"
#include "smoothing/trial.h"

namespace isorelax {
namespace {

/// A visit moves a vertex at most this share of its shortest edge at a time.
constexpr double kPolishReach = 0.2;
/// Times that a move is halved before a vertex stays where it is.
constexpr unsigned kPolishHalvings = 5;
constexpr unsigned kTurnedHalvings = 2;
/// A vertex at bounds that could gain less than this, in degrees or of its energy, stays; one that could gain
/// more has so many tries, each with what was missing times the factor.
constexpr double kLeastClimb = 1e-5;
/// What promises less than that is made of rounding and leads anywhere.
constexpr double kNoClimb = 1e-10;
constexpr unsigned kBoundRounds = 4;
constexpr double kCorrection = 1.5;
/// Turns of a move that is held back, in the order in which they are tried; radians.
constexpr std::array kTurns = {0.7, -0.7, 1.3, -1.3};

}  // namespace

PolishState::PolishState(const SmoothingProblem& problem)
    : problem_(problem),
      ring_(problem),
      surface_(problem),
      can_change_(movable_triangles(problem)),
      ranges_(problem.triangle_count()) {}

void PolishState::start(std::span<const Vec3> positions) {
  x_.assign(positions.begin(), positions.end());
  parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) measure(static_cast<Index>(t));
  });
  surface_.start(x_);
  changed_at_.assign(problem_.vertex_count(), ++clock_);
  stuck_at_.assign(problem_.vertex_count(), 0);
}

/// Of a vertex: everything that can be seen from a neighbour.
void PolishState::note_change(Index vertex) {
  ++clock_;
  for (const Corner c : problem_.topology.corners_of(vertex))
    for (const Index v : problem_.triangles[c / 3]) changed_at_[v] = clock_;
}

void PolishState::measure(Index triangle) {
  const Triangle& v = problem_.triangles[triangle];
  if (can_change(triangle)) ranges_[triangle] = angle_range(x_[v[0]], x_[v[1]], x_[v[2]]);
}

AngleRange PolishState::worst() const {
  AngleRange worst{180, 0};
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    if (!can_change(t)) continue;
    worst.min = std::min(worst.min, ranges_[t].min);
    worst.max = std::max(worst.max, ranges_[t].max);
  }
  return worst;
}

double PolishState::mean() const {
  double sum = 0;
  std::size_t count = 0;
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    if (!can_change(t)) continue;
    sum += ranges_[t].min;
    ++count;
  }
  return sum / static_cast<double>(count);
}

AngleRing& PolishState::look_at(Index vertex) {
  ring_.look_at(x_, vertex);
  return ring_;
}

std::optional<Vec3> PolishState::climb(Index vertex, const Vec3& at, const AngleRing::Soft& soft,
                                       const std::function<double(const Vec3&)>& value,
                                       std::span<const AngleRange> bounds) {
  const Climb climb{vertex, at, soft, value, bounds};
  held_back_ = 0;
  hold_ = Hold::none;
  const NewtonBlock model = model_of(climb);
  const Vec3 d = model.solve(soft.gradient);
  if (!(d.dot(soft.gradient) > kNoClimb)) return std::nullopt;
  if (auto there = along(climb, d, kPolishHalvings)) return there;
  if (held_back_ == 0 || problem_.mobility[vertex] != Mobility::plane) return std::nullopt;
  if (hold_ == Hold::angles) return along_bounds(climb, model);
  // What holds a vertex back leads along itself.
  const Vec3 side = model.t2 * model.t1.dot(d) - model.t1 * model.t2.dot(d);
  for (const double turn : kTurns) {
    if (auto there = along(climb, std::cos(turn) * d + std::sin(turn) * side, kTurnedHalvings)) return there;
  }
  return std::nullopt;
}

bool PolishState::leads_up_to(const Climb& climb, const Vec3& there) {
  hold_ = Hold::none;
  if (!(climb.value(there) > climb.soft.value)) return false;
  hold_ = hold_at(climb.vertex, there, climb.bounds);
  return hold_ == Hold::none;
}

/// Ends at once where bounds on angles hold the vertex back in a plane: halves lead there more slowly than a
/// move along them.
std::optional<Vec3> PolishState::along(const Climb& climb, const Vec3& direction, unsigned halvings) {
  Vec3 move = direction;
  for (unsigned k = 0; k <= halvings; ++k, move *= 0.5) {
    const Vec3 there = bring_back(problem_, climb.vertex, climb.at + move);
    if (leads_up_to(climb, there)) return there;
    if (hold_ == Hold::angles && problem_.mobility[climb.vertex] == Mobility::plane) break;
  }
  return std::nullopt;
}

/// The best move of the model that keeps all angles within their bounds, which are straight lines at first;
/// where that leads over one, the line is moved by as much and more.
std::optional<Vec3> PolishState::along_bounds(const Climb& climb, const NewtonBlock& model) {
  std::vector<MoveBound> limits = ring_.move_bounds(climb.at, climb.bounds);
  for (unsigned round = 0; round < kBoundRounds; ++round) {
    const Vec3 move = best_move(model, climb.soft.gradient, limits);
    if (!(move.dot(climb.soft.gradient) > kLeastClimb)) return std::nullopt;
    const Vec3 there = bring_back(problem_, climb.vertex, climb.at + move);
    if (hold_of_triangles(there, climb.bounds) != Hold::angles) {
      if (leads_up_to(climb, there)) return there;
      return along(climb, 0.5 * move, kTurnedHalvings - 1);
    }
    const std::vector<MoveBound> beyond = ring_.move_bounds(there, climb.bounds);
    for (std::size_t i = 0; i < limits.size(); ++i)
      limits[i].slack += kCorrection * std::min(0.0, beyond[i].slack);
  }
  return std::nullopt;
}

/// Curvature + |g| / r, by which a step in the vertex' tangent space is no longer than r, a share of its
/// shortest edge.
NewtonBlock PolishState::model_of(const Climb& climb) const {
  const Mobility mobility = problem_.mobility[climb.vertex];
  const Vec3 axis = tangent_axis(problem_, x_, climb.vertex);
  const double slope = tangent_part(mobility, axis, climb.soft.gradient).norm();
  NewtonBlock block(mobility, axis);
  const double damping = slope / (kPolishReach * ring_.shortest_edge(climb.at));
  block.add(climb.soft.spread);
  block.h11 += damping;
  block.h22 += damping;
  return block;
}

PolishState::Hold PolishState::hold_of_triangles(const Vec3& there, std::span<const AngleRange> bounds) {
  if (!ring_.is_upright(there)) {
    held_back_ |= kLimitFold;
    return Hold::fold;
  }
  const auto ranges = ring_.ranges(there);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const AngleRange& bound = bounds[ring_.triangles()[i]];
    if (ranges[i].min >= bound.min && ranges[i].max <= bound.max) continue;
    held_back_ |= kLimitFold;
    return Hold::angles;
  }
  return Hold::none;
}

/// Where nothing holds the vertex, the distance is counted from there on: what is asked last.
PolishState::Hold PolishState::hold_at(Index vertex, const Vec3& there, std::span<const AngleRange> bounds) {
  if (const Hold hold = hold_of_triangles(there, bounds); hold != Hold::none) return hold;
  if (keeps_near(vertex, there)) return Hold::none;
  held_back_ |= kLimitSurface;
  return Hold::distance;
}

bool PolishState::keeps_near(Index vertex, const Vec3& there) {
  const Vec3 here = x_[vertex];
  x_[vertex] = there;
  const bool near = surface_.keeps(x_, vertex);
  x_[vertex] = here;
  return near;
}

double PolishState::move(Index vertex, const Vec3& there) {
  const double distance = (there - x_[vertex]).norm();
  x_[vertex] = there;
  const auto ranges = ring_.ranges(there);
  for (std::size_t i = 0; i < ranges.size(); ++i) ranges_[ring_.triangles()[i]] = ranges[i];
  note_change(vertex);
  return distance;
}

bool PolishState::move_together(std::span<const Index> vertices, std::span<const Vec3> there) {
  std::vector<Vec3> back;
  const auto stays = [&](Index v) {
    if (!look_at(v).is_upright(there[v]) || !keeps_near(v, there[v])) return true;
    back.push_back(x_[v]);
    move(v, there[v]);
    return false;
  };
  if (std::ranges::none_of(vertices, stays)) return true;
  bool near = true;
  while (!back.empty()) {
    const Index v = vertices[back.size() - 1];
    look_at(v);
    near = keeps_near(v, back.back()) && near;
    move(v, back.back());
    back.pop_back();
  }
  // Bounds on distances may have grown on the way.
  if (!near) surface_.start(x_);
  return false;
}

std::vector<Index> PolishState::settle(std::span<const Vec3> positions, StepRecord& record) {
  double largest = 0;
  record.moved = 0;
  std::vector<Index> changed;
  for (Index v = 0; v < problem_.vertex_count(); ++v) {
    record.displacement[v] = x_[v] - positions[v];
    const double squared = record.displacement[v].squaredNorm();
    if (!(squared > 0)) continue;
    largest = std::max(largest, squared);
    ++record.moved;
    const Vec3 rounded = positions[v] + record.displacement[v];
    if (rounded != x_[v]) note_change(v);
    x_[v] = rounded;
    for (const Corner c : problem_.topology.corners_of(v)) changed.push_back(c / 3);
  }
  record.largest_move = std::sqrt(largest);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const Index t : changed) measure(t);
  return changed;
}

}  // namespace isorelax
