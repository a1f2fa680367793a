#include "motion/runge_kutta.h"

#include <algorithm>
#include <cmath>

namespace isorelax {
namespace {

void check_finite(std::span<const Vec3> x, double t) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!x[i].allFinite()) throw MotionError(t, static_cast<Index>(i), "the position is no longer finite");
}

/// Dormand and Prince 1980: nodes, rows of the tableau, and fifth minus fourth order weights.
constexpr std::size_t kStages = 7;
constexpr std::array<double, kStages> kNodes = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
constexpr std::array<std::array<double, kStages - 1>, kStages> kTableau = {
    {{},
     {1.0 / 5},
     {3.0 / 40, 9.0 / 40},
     {44.0 / 45, -56.0 / 15, 32.0 / 9},
     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}}};
constexpr std::array<double, kStages> kErrorWeights = {
    71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

}  // namespace

void RungeKutta::step(std::span<Vec3> x, double t, double dt) {
  slopes_.resize(std::max<std::size_t>(slopes_.size(), 4));
  for (std::vector<Vec3>& slope : slopes_) slope.resize(x.size());
  at_.resize(x.size());
  const auto stage = [&](std::size_t k, double share) {
    for (std::size_t i = 0; i < x.size(); ++i) at_[i] = x[i] + share * dt * slopes_[k - 1][i];
    sample_field(*field_, at_, t + share * dt, threads_, slopes_[k]);
  };
  sample_field(*field_, x, t, threads_, slopes_[0]);
  stage(1, 0.5);
  stage(2, 0.5);
  stage(3, 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    at_[i] = x[i] + dt / 6 * (slopes_[0][i] + 2 * slopes_[1][i] + 2 * slopes_[2][i] + slopes_[3][i]);
  check_finite(at_, t + dt);
  std::ranges::copy(at_, x.begin());
}

StepError RungeKutta::pair_step(std::span<const Vec3> x, double t, double dt, std::vector<Vec3>& moved) {
  slopes_.resize(kStages);
  for (std::vector<Vec3>& slope : slopes_) slope.resize(x.size());
  moved.resize(x.size());
  for (std::size_t k = 0; k < kStages; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t j = 0; j < k; ++j) sum += kTableau[k][j] * slopes_[j][i];
      moved[i] = x[i] + dt * sum;
    }
    sample_field(*field_, moved, t + kNodes[k] * dt, threads_, slopes_[k]);
  }
  StepError error;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < kStages; ++k) sum += kErrorWeights[k] * slopes_[k][i];
    const double own = dt * sum.norm();
    if (own > error.largest) error = {own, static_cast<Index>(i)};
  }
  check_finite(moved, t + dt);  // the last stage stands at the fifth-order result
  return error;
}

double StepSizeControl::next(double dt, double error) const {
  constexpr double kSafety = 0.9;
  constexpr double kLeast = 0.2;
  constexpr double kMost = 4;
  const double factor = error > 0 ? kSafety * std::pow(tolerance_ / error, 0.2) : kMost;
  return dt * std::clamp(factor, kLeast, kMost);
}

}  // namespace isorelax
