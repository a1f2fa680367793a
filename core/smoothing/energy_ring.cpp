#include "smoothing/energy_ring.h"

#include <cmath>

namespace isorelax {
namespace {

constexpr unsigned kMaxSteps = 8;
/// A needle on a short edge bends so much that a whole step leads far too far.
constexpr unsigned kBlockHalvings = 24;
/// A step that gains less than this share of the sum is the last.
constexpr double kWorthwhileBlockGain = 0.03;

}  // namespace

double EnergyRing::energy(const Vec3& at) const {
  double sum = 0;
  for (const Corner c : p_.topology.corners_of(v_)) {
    if (p_.treated[c / 3] == 0) continue;
    const auto x = corners(c, at);
    const auto was = corners(c, x_[v_]);
    if (!(area_vector(x[0], x[1], x[2]).dot(area_vector(was[0], was[1], was[2])) > 0)) return INFINITY;
    sum += std::pow(evaluate_energy(x, p_.reference[c / 3], p_.weights).energy, p_.exponent);
  }
  return sum;
}

EnergyRing::Slope EnergyRing::slope(const Vec3& at) const {
  Slope sum;
  for (const Corner c : p_.topology.corners_of(v_)) {
    if (p_.treated[c / 3] == 0) continue;
    const auto x = corners(c, at);
    const ReferenceTriangle reference = p_.reference[c / 3];
    const double energy = evaluate_energy(x, reference, p_.weights).energy;
    const double factor = p_.exponent * std::pow(energy, p_.exponent - 1);
    sum.gradient += factor * energy_gradient(x, reference, p_.weights)[c % 3];
    sum.curvature += factor * energy_hessian_block_psd(x, c % 3, reference, p_.weights);
  }
  return sum;
}

std::array<Vec3, 3> EnergyRing::corners(Corner c, const Vec3& at) const {
  const Triangle& t = p_.triangles[c / 3];
  std::array<Vec3, 3> x{x_[t[0]], x_[t[1]], x_[t[2]]};
  x[c % 3] = at;
  return x;
}

Vec3 move_to_local_minimum(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                           const Vec3& axis) {
  const EnergyRing ring(problem, positions, vertex);
  Vec3 at = positions[vertex];
  double energy = ring.energy(at);
  for (unsigned i = 0; i < kMaxSteps; ++i) {
    const EnergyRing::Slope slope = ring.slope(at);
    NewtonBlock block(problem.mobility[vertex], axis);
    block.add(slope.curvature);
    Vec3 d = -block.solve(slope.gradient);
    double lower = ring.energy(at + d);
    for (unsigned k = 0; k < kBlockHalvings && !(lower < energy); ++k) {
      d *= 0.5;
      lower = ring.energy(at + d);
    }
    if (!(lower < energy)) break;
    at += d;
    const bool last = energy - lower < kWorthwhileBlockGain * energy;
    energy = lower;
    if (last) break;
  }
  return at - positions[vertex];
}

}  // namespace isorelax
