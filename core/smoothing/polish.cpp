#include "smoothing/polish.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "smoothing/angle_ring.h"
#include "smoothing/newton_block.h"
#include "smoothing/surface_limit.h"
#include "smoothing/tangent.h"
#include "smoothing/trial.h"

namespace isorelax {
namespace {

/// Sharpness of the soft minimum, per degree, stage by stage.
constexpr std::array kSharpness = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
/// A stage ends after this many steps, or when in this many in a row no vertex moves by more than kIdleMove
/// mean edges and neither of the worst angles gains kGain degrees.
constexpr unsigned kStageSteps = 60;
constexpr unsigned kPolishIdleSteps = 5;
constexpr double kIdleMove = 1e-3;
constexpr double kGain = 0.005;
/// Triangles within this many degrees of the worst are treated; halved where the mean would fall too
/// far, down to the least.
constexpr double kWindow = 5;
constexpr double kLeastWindow = 0.5;
/// A visit moves a vertex at most this share of its shortest edge at a time.
constexpr double kPolishReach = 0.2;
constexpr unsigned kStepsPerVisit = 2;
constexpr unsigned kPolishHalvings = 5;

/// Flags of the treated triangles with a vertex that may move: what the others are like is not up to us.
std::vector<std::uint8_t> triangles_that_move(const SmoothingProblem& problem) {
  std::vector<std::uint8_t> flags = problem.treated;
  for (Index t = 0; t < problem.triangle_count(); ++t) {
    const Triangle& v = problem.triangles[t];
    if (std::all_of(v.begin(), v.end(), [&](Index i) { return problem.mobility[i] == Mobility::none; }))
      flags[t] = 0;
  }
  return flags;
}

class PolishSmoother : public Smoother {
 public:
  PolishSmoother(const SmoothingProblem& problem, const PolishOptions& options)
      : problem_(problem),
        options_(options),
        ring_(problem),
        surface_(problem),
        objective_(problem),
        movable_(triangles_that_move(problem)),
        ranges_(problem.triangle_count()) {}

  [[nodiscard]] bool descends() const override { return false; }

  void step(std::span<const Vec3> positions, StepRecord& record) override {
    prepare(positions, record);
    if (!objective_.is_at(positions)) objective_.evaluate(positions);
    record.before = objective_.totals();
    while (stage_ < kSharpness.size() && !sweep(positions)) measure();
    finish(positions, record);
  }

 private:
  void prepare(std::span<const Vec3> positions, StepRecord& record) {
    const std::size_t n = problem_.vertex_count();
    record.gradient.assign(n, Vec3::Zero());
    record.displacement.assign(n, Vec3::Zero());
    record.alpha.assign(n, 1);
    record.limits = problem_.fixed_limits;
    record.tangent_class = problem_.classes.classes;
    record.fold_passes = record.energy_passes = 0;
    // A run asks for the positions that the step before led to: all is known of them.
    if (!std::ranges::equal(positions, x_)) {
      x_.assign(positions.begin(), positions.end());
      measure();
      surface_.start(x_);
    }
    if (started_) return;
    started_ = true;
    goal_ = {worst_, options_.obtuse_weight};
    ring_.aim_at(goal_);
    mean_ = mean();
  }

  /// Extreme angles of all triangles that move, and the worst of them.
  void measure() {
    parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) measure(static_cast<Index>(t));
    });
    find_worst();
  }

  void measure(Index t) {
    const Triangle& v = problem_.triangles[t];
    if (movable_[t] != 0) ranges_[t] = angle_range(x_[v[0]], x_[v[1]], x_[v[2]]);
  }

  void find_worst() {
    worst_ = {180, 0};
    for (Index t = 0; t < problem_.triangle_count(); ++t) {
      if (movable_[t] == 0) continue;
      worst_.min = std::min(worst_.min, ranges_[t].min);
      worst_.max = std::max(worst_.max, ranges_[t].max);
    }
  }

  /// How far a triangle is from the worst of the mesh, in the angle in which it is nearer: where the largest
  /// angle of all can fall no more, the smallest can still rise.
  [[nodiscard]] double lead(Index t) const {
    return std::min(goal_.of_small(ranges_[t].min) - goal_.of_small(worst_.min),
                    goal_.of_large(ranges_[t].max) - goal_.of_large(worst_.max));
  }

  [[nodiscard]] double mean() const {
    double sum = 0;
    std::size_t count = 0;
    for (Index t = 0; t < problem_.triangle_count(); ++t) {
      if (movable_[t] == 0) continue;
      sum += ranges_[t].min;
      ++count;
    }
    return sum / static_cast<double>(count);
  }

  /// Free vertices of the triangles to be treated, those of the worst triangles first.
  [[nodiscard]] std::vector<Index> vertices_in_order() const {
    std::vector<std::pair<double, Index>> led;
    for (Index t = 0; t < problem_.triangle_count(); ++t) {
      if (movable_[t] == 0 || lead(t) > window_) continue;
      for (const Index v : problem_.triangles[t])
        if (problem_.mobility[v] != Mobility::none) led.emplace_back(lead(t), v);
    }
    std::sort(led.begin(), led.end());
    std::vector<Index> order;
    std::vector<std::uint8_t> seen(problem_.vertex_count(), 0);
    for (const auto& [lead, v] : led) {
      if (seen[v] == 0) order.push_back(v);
      seen[v] = 1;
    }
    return order;
  }

  /// Visits all vertices to be treated once. False if that came to nothing, and another stage or fewer
  /// triangles are next.
  bool sweep(std::span<const Vec3> positions) {
    const AngleRange before = worst_;
    double largest = 0;
    for (const Index v : vertices_in_order()) largest = std::max(largest, visit(v));
    find_worst();
    if (mean_ - mean() > options_.largest_mean_loss) {
      // Back to where the step began, and on with fewer triangles.
      x_.assign(positions.begin(), positions.end());
      surface_.start(x_);
      window_ /= 2;
      if (window_ < kLeastWindow) stage_ = kSharpness.size();
      return false;
    }
    const bool gained = worst_.min > before.min + kGain || worst_.max < before.max - kGain;
    const bool idle = largest < kIdleMove * problem_.mean_edge_length && !gained;
    idle_ = idle ? idle_ + 1 : 0;
    if (largest > 0 && ++steps_ < kStageSteps && idle_ < kPolishIdleSteps) return true;
    ++stage_;
    steps_ = idle_ = 0;
    return largest > 0;
  }

  /// Moves a vertex to where the triangles around it are better, if it can. Returns how far.
  double visit(Index v) {
    ring_.look_at(x_, v);
    Vec3 at = x_[v];
    // What a blunt minimum asks for may be too bad for the worst triangle: then a sharper one decides.
    for (std::size_t s = stage_; s < kSharpness.size() && at == x_[v]; ++s) {
      for (unsigned i = 0; i < kStepsPerVisit; ++i)
        if (!climb(v, kSharpness[s], at)) break;
    }
    if (at == x_[v]) return 0;
    const double distance = (at - x_[v]).norm();
    x_[v] = at;
    const auto ranges = ring_.ranges(at);
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges_[ring_.triangles()[i]] = ranges[i];
    return distance;
  }

  /// One step of a vertex from `at` to a higher soft minimum. False if there is none.
  bool climb(Index v, double sharpness, Vec3& at) {
    const double value = ring_.soft_value(at, sharpness);
    Vec3 d = ascent(v, at, sharpness);
    for (unsigned k = 0; k <= kPolishHalvings; ++k, d *= 0.5) {
      const Vec3 there = bring_back(problem_, v, at + d);
      if (!ring_.is_upright(there)) continue;
      if (!(ring_.soft_value(there, sharpness) > value) || !keeps_floor(there) || !keeps_near(v, there))
        continue;
      at = there;
      return true;
    }
    return false;
  }

  /// Step in the tangent space towards a higher soft minimum: (spread + |g| / r)^-1 g, no longer than r.
  [[nodiscard]] Vec3 ascent(Index v, const Vec3& at, double sharpness) {
    const AngleRing::Soft soft = ring_.soft(at, sharpness);
    const Vec3 axis = tangent_axis(problem_, x_, v);
    const Vec3 g = tangent_part(problem_.mobility[v], axis, soft.gradient);
    const double slope = g.norm();
    if (!(slope > 0)) return Vec3::Zero();
    NewtonBlock block(problem_.mobility[v], axis);
    const double damping = slope / (kPolishReach * ring_.shortest_edge(at));
    block.h11 = damping + block.t1.dot(soft.spread * block.t1);
    block.h12 = block.t1.dot(soft.spread * block.t2);
    block.h22 = damping + block.t2.dot(soft.spread * block.t2);
    return block.solve(g);
  }

  /// No triangle around the vertex gets worse than the worst of the mesh at the start.
  [[nodiscard]] bool keeps_floor(const Vec3& at) {
    for (const AngleRange& r : ring_.ranges(at))
      if (r.min < goal_.start.min || r.max > goal_.start.max) return false;
    return true;
  }

  /// Nor does the surface go farther from where it was than it may.
  [[nodiscard]] bool keeps_near(Index v, const Vec3& at) {
    const Vec3 here = x_[v];
    x_[v] = at;
    const bool near = surface_.keeps(x_, v);
    x_[v] = here;
    return near;
  }

  void finish(std::span<const Vec3> positions, StepRecord& record) {
    double largest = 0;
    record.moved = 0;
    std::vector<Index> changed;
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      record.displacement[v] = x_[v] - positions[v];
      const double squared = record.displacement[v].squaredNorm();
      largest = std::max(largest, squared);
      record.moved += squared > 0 ? 1 : 0;
      if (!(squared > 0)) continue;
      x_[v] = positions[v] + record.displacement[v];
      for (const Corner c : problem_.topology.corners_of(v)) changed.push_back(c / 3);
    }
    record.largest_move = std::sqrt(largest);
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const Index t : changed) measure(t);
    find_worst();
    record.after = objective_.update(x_, changed);
    objective_.mark(x_);
  }

  const SmoothingProblem& problem_;
  PolishOptions options_;
  AngleRing ring_;
  SurfaceLimit surface_;
  Objective objective_;
  std::vector<std::uint8_t> movable_;
  std::vector<Vec3> x_;
  std::vector<AngleRange> ranges_;
  AngleRange worst_{0, 180};  // of the mesh now
  AngleGoal goal_{{0, 180}, 1};
  double mean_ = 0;  // of the smallest angles at the start
  double window_ = kWindow;
  std::size_t stage_ = 0;
  unsigned steps_ = 0, idle_ = 0;
  bool started_ = false;
};

}  // namespace

std::unique_ptr<Smoother> make_polish(const SmoothingProblem& problem, const PolishOptions& options) {
  return std::make_unique<PolishSmoother>(problem, options);
}

}  // namespace isorelax
