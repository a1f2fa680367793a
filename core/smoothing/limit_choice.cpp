#include "smoothing/limit_choice.h"

#include <algorithm>
#include <numbers>

#include "quality/report.h"
#include "surface/deviation.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

constexpr double kFine = 0.003;
constexpr double kMedium = 0.005;
/// The nearest limit is at least this share of the widest.
constexpr double kLeastLimit = 1.0 / 16;

/// A run hardly gets on when the energy falls by no more than this share in so many steps in a row.
constexpr double kIdle = 1e-3;
constexpr unsigned kIdleInARow = 3;
/// Steps under the wider limit, and what they have to gain, in degrees.
constexpr unsigned kTrialSteps = 10;
constexpr double kSmallestGain = 1;
constexpr double kLargestGain = 2;
constexpr double kMeanGain = 0.3;

/// Mean of edge length times dihedral turn over the smooth edges, over the diagonal.
double mean_chord(std::span<const Vec3> positions, const SmoothingProblem& problem,
                  const ProblemOptions& options) {
  constexpr double kRadians = std::numbers::pi / 180;
  double sum = 0;
  std::size_t count = 0;
  for (Corner c = 0; c < 3 * problem.triangles.size(); ++c) {
    if (problem.topology.opposite(c) == kNone || problem.topology.opposite(c) < c) continue;
    const double turn = dihedral_turn_deg(positions, problem.triangles, problem.topology, c);
    if (turn >= options.features.ridge_angle_deg) continue;
    const Triangle& t = problem.triangles[c / 3];
    sum += kRadians * turn * (positions[t[next(c % 3)]] - positions[t[previous(c % 3)]]).norm();
    ++count;
  }
  return count == 0 ? 0 : sum / (static_cast<double>(count) * bounding_diagonal(positions));
}

}  // namespace

double automatic_limit(std::span<const Vec3> positions, const SmoothingProblem& problem,
                       const ProblemOptions& options) {
  return automatic_limits(positions, problem, options).back();
}

std::vector<double> automatic_limits(std::span<const Vec3> positions, const SmoothingProblem& problem,
                                     const ProblemOptions& options) {
  const double chord = mean_chord(positions, problem, options);
  const bool free_border = options.boundary == BoundaryRule::free;
  const double border = free_border ? problem.mean_edge_length / bounding_diagonal(positions) : 0;
  const double widest = std::max({kFine, std::min(kMedium, 1.2 * chord), 0.5 * chord, border});
  std::vector<double> limits;
  if (!problem.plane_normal && !free_border && options.surface == SurfaceRule::project) {
    for (double limit = std::clamp(chord, kLeastLimit * widest, 0.5 * widest); limit < 0.7 * widest;
         limit *= 2)
      limits.push_back(limit);
  }
  limits.push_back(widest);
  return limits;
}

WiderLimit::Angles WiderLimit::angles_of(std::span<const Vec3> positions) const {
  const QualityReport report =
      measure_quality(positions, problem_.triangles, problem_.topology, problem_.threads);
  return {report.min_angle_deg, report.max_angle_deg, report.mean_min_angle_deg};
}

bool WiderLimit::is_better_than(std::span<const Vec3> positions) const {
  const Angles here = angles_of(positions);
  return under_wider_.smallest >= here.smallest + kSmallestGain ||
         under_wider_.largest <= here.largest - kLargestGain || under_wider_.mean >= here.mean + kMeanGain;
}

void WiderLimit::try_from(std::span<const Vec3> positions) {
  std::vector<Vec3> copy(positions.begin(), positions.end());
  const SmoothingProblem wider = make_wider_();
  run(*make_smoother_(wider), wider, copy, {.iterations = kTrialSteps, .tolerance = kIdle});
  under_wider_ = angles_of(copy);
  steps_until_compared_ = kTrialSteps;
}

bool WiderLimit::is_worth_it(const StepRecord& record, std::span<const Vec3> positions) {
  if (steps_until_compared_) {
    if (*steps_until_compared_ == 0 || --*steps_until_compared_ > 0) return false;
    return is_better_than(positions);
  }
  at_limit_ = false;
  for (Index v = 0; v < record.limits.size() && !at_limit_; ++v)
    at_limit_ = (record.limits[v] & ~problem_.fixed_limits[v] & kLimitSurface) != 0;
  const double fall = (record.before.energy - record.after.energy) / record.before.energy;
  idle_steps_ = fall <= kIdle && at_limit_ ? idle_steps_ + 1 : 0;
  if (idle_steps_ == kIdleInARow) try_from(positions);
  return false;
}

bool WiderLimit::is_worth_it_at_end(std::span<const Vec3> positions) {
  if (steps_until_compared_) return *steps_until_compared_ > 0 && is_better_than(positions);
  if (!at_limit_) return false;
  try_from(positions);
  return is_better_than(positions);
}

}  // namespace isorelax
