#include <algorithm>
#include <cmath>
#include <functional>

#include "smoothing/polish_state.h"

namespace isorelax {
namespace {

/// Sharpness of the soft minimum of a triangle's angles, over what the mean is short of 60 degrees at the
/// start. The smallest angle itself has kinks that stop a vertex where two angles are equal; a blunt minimum
/// sees beyond them, and gets sharper with each sweep.
constexpr double kBluntest = 0.5;
constexpr double kGrowth = 1.1;
constexpr double kSharpest = 60;
constexpr double kLeastShort = 1e-3;
/// With the sharpest, a sweep that gains less than this, in degrees, is the last.
constexpr double kLeastMeanGain = 2e-4;
constexpr unsigned kMostSweeps = 100;

/// Bounds by triangle: of those that can change, the worst share get no worse, and no other gets as bad.
std::vector<AngleRange> bounds_of(const PolishState& state, double worst_share) {
  std::vector<double> smallest, largest;
  const auto triangles = static_cast<Index>(state.problem().triangle_count());
  for (Index t = 0; t < triangles; ++t) {
    if (!state.can_change(t)) continue;
    smallest.push_back(state.range(t).min);
    largest.push_back(state.range(t).max);
  }
  std::vector<AngleRange> bounds(triangles, {0, 180});
  if (smallest.empty()) return bounds;
  // A share of all triangles: those that cannot change may be among the worst, too.
  const auto last = static_cast<double>(smallest.size() - 1);
  const auto rank = static_cast<std::ptrdiff_t>(std::min(std::ceil(worst_share * triangles), last));
  std::nth_element(smallest.begin(), smallest.begin() + rank, smallest.end());
  std::nth_element(largest.begin(), largest.begin() + rank, largest.end(), std::greater<>());
  const double small = smallest[static_cast<std::size_t>(rank)];
  const double large = largest[static_cast<std::size_t>(rank)];
  for (Index t = 0; t < triangles; ++t)
    bounds[t] = {std::min(small, state.range(t).min), std::max(large, state.range(t).max)};
  return bounds;
}

class RaiseMean : public PolishGoalSweeps {
 public:
  explicit RaiseMean(const PolishOptions& options) : worst_share_(options.worst_share) {}

  bool sweep(PolishState& state) override {
    if (over_) return false;
    const double before = state.mean();
    if (start_.empty()) {
      start_ = state.positions();
      bounds_ = bounds_of(state, worst_share_);
      mean_ = before;
      short_of_ = std::max(60 - before, kLeastShort);
    }
    const SmoothingProblem& problem = state.problem();
    const double sharpness = std::min(kBluntest * std::pow(kGrowth, done_), kSharpest);
    bool moved = false;
    for (Index v = 0; v < problem.vertex_count(); ++v)
      if (problem.mobility[v] != Mobility::none) moved = visit(state, v, sharpness / short_of_) || moved;
    const double after = state.mean();
    over_ = !moved || ++done_ == kMostSweeps || (sharpness >= kSharpest && after - before < kLeastMeanGain);
    if (!over_ || after >= mean_) return moved;
    state.start(start_);
    return true;
  }

 private:
  /// Moves a vertex to where the triangles around it are better on average, if it can.
  bool visit(PolishState& state, Index v, double sharpness) {
    AngleRing& ring = state.look_at(v);
    const Vec3 at = state.positions()[v];
    const auto value = [&](const Vec3& there) { return ring.sum_of_soft_minima_value(there, sharpness); };
    const auto there = state.climb(v, at, ring.sum_of_soft_minima(at, sharpness), value, bounds_);
    if (there) state.move(v, *there);
    return there.has_value();
  }

  double worst_share_;
  std::vector<AngleRange> bounds_;
  std::vector<Vec3> start_;
  double mean_ = 0;      // at the start
  double short_of_ = 0;  // what the mean was short of 60 degrees
  unsigned done_ = 0;
  bool over_ = false;
};

}  // namespace

std::unique_ptr<PolishGoalSweeps> raise_mean(const PolishOptions& options) {
  return std::make_unique<RaiseMean>(options);
}

}  // namespace isorelax
