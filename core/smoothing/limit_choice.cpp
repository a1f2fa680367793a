#include "smoothing/limit_choice.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "quality/report.h"
#include "surface/deviation.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

constexpr double kFine = 0.003;
constexpr double kMedium = 0.005;
constexpr double kMediumOnFits = 0.0075;
/// From this share of agreement on, the fits of a surface are what it is.
constexpr double kAgreement = 0.9;
/// The nearest limit is between these shares of the widest.
constexpr double kLeastShareOfWidest = 1.0 / 8;
constexpr double kLargestShareOfWidest = 0.7;

/// Steps under the wider limit, and what they have to gain, in degrees.
constexpr unsigned kTrialSteps = 20;
constexpr double kSmallestGain = 1;
constexpr double kLargestGain = 2;
constexpr double kMeanGain = 0.5;

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

bool has_border(const Topology& topology) {
  for (Index v = 0; v < topology.vertex_count(); ++v)
    if (topology.is_boundary(v)) return true;
  return false;
}

}  // namespace

AutomaticLimits automatic_limits(std::span<const Vec3> positions, const SmoothingProblem& problem,
                                 const ProblemOptions& options) {
  const double chord = problem.plane_normal ? 0 : mean_chord(positions, problem, options);
  const bool free_border = options.boundary == BoundaryRule::free && has_border(problem.topology);
  const double border = free_border ? problem.mean_edge_length / bounding_diagonal(positions) : 0;
  const bool on_fits = problem.surface && problem.surface->agreement() > kAgreement;
  const double medium = on_fits ? kMediumOnFits : kMedium;
  const double widest = std::max({kFine, std::min(medium, 1.2 * chord), 0.5 * chord, border});
  const bool may_be_nearer = !problem.plane_normal && !free_border &&
                             options.surface == SurfaceRule::project &&
                             chord <= kLargestShareOfWidest * widest;
  return {may_be_nearer ? std::max(chord, kLeastShareOfWidest * widest) : widest, widest, on_fits};
}

bool wider_limit_pays(const SmoothingProblem& wider, const SmootherFactory& make_smoother,
                      std::span<const Vec3> positions, unsigned iterations) {
  std::vector<Vec3> there(positions.begin(), positions.end());
  run(*make_smoother(wider), wider, there, {.iterations = std::min(kTrialSteps, iterations), .tolerance = 0});
  const auto measure = [&](std::span<const Vec3> x) {
    return measure_quality(x, wider.triangles, wider.topology, wider.threads);
  };
  const QualityReport before = measure(positions);
  const QualityReport after = measure(there);
  return after.min_angle_deg >= before.min_angle_deg + kSmallestGain ||
         after.max_angle_deg <= before.max_angle_deg - kLargestGain ||
         after.mean_min_angle_deg >= before.mean_min_angle_deg + kMeanGain;
}

}  // namespace isorelax
