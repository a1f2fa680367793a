#include "smoothing/minimise.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace isorelax {
namespace {

/// Share of the decrease that the slope promises which a step must bring (Armijo).
constexpr double kEnough = 1e-4;
constexpr int kMaxHalvings = 40;

struct CurvaturePair {
  Eigen::VectorXd move, change;
  double curvature;  // move . change > 0
};

/// The two-loop recursion: minus the remembered inverse Hessian times the gradient.
Eigen::VectorXd two_loop_direction(const std::deque<CurvaturePair>& pairs, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd d = -gradient;
  std::vector<double> alphas(pairs.size());
  for (std::size_t k = pairs.size(); k-- > 0;) {
    alphas[k] = pairs[k].move.dot(d) / pairs[k].curvature;
    d -= alphas[k] * pairs[k].change;
  }
  d *= pairs.back().curvature / pairs.back().change.squaredNorm();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    d += (alphas[k] - pairs[k].change.dot(d) / pairs[k].curvature) * pairs[k].move;
  return d;
}

}  // namespace

double minimise(const DifferentiableFunction& function, Eigen::VectorXd& x, const MinimiseOptions& options) {
  Eigen::VectorXd gradient(x.size()), next_gradient(x.size());
  double value = function(x, gradient);
  std::deque<CurvaturePair> pairs;
  for (unsigned i = 0; i < options.iterations; ++i) {
    const double steepness = gradient.norm();
    if (!(steepness > 0)) break;
    Eigen::VectorXd d = pairs.empty() ? Eigen::VectorXd(-options.first_step / steepness * gradient)
                                      : two_loop_direction(pairs, gradient);
    const double slope = d.dot(gradient);
    if (!(slope < 0)) {  // rounding spoilt the memory
      if (pairs.empty()) break;
      pairs.clear();
      continue;
    }
    Eigen::VectorXd there = x + d;
    double next_value = function(there, next_gradient);
    double share = 1;
    for (int halving = 0; halving < kMaxHalvings && !(next_value <= value + kEnough * share * slope);
         ++halving) {
      share *= 0.5;
      there = x + share * d;
      next_value = function(there, next_gradient);
    }
    if (!(next_value < value)) {
      if (pairs.empty()) break;
      pairs.clear();
      continue;
    }
    CurvaturePair pair{there - x, next_gradient - gradient, 0};
    pair.curvature = pair.move.dot(pair.change);
    if (pair.curvature > 1e-10 * pair.move.norm() * pair.change.norm()) {
      pairs.push_back(std::move(pair));
      if (pairs.size() > options.memory) pairs.pop_front();
    }
    const double decrease = value - next_value;
    x.swap(there);
    gradient.swap(next_gradient);
    value = next_value;
    if (decrease <= options.tolerance * std::abs(value)) break;
  }
  return value;
}

}  // namespace isorelax
