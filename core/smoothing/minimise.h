#pragma once

#include <Eigen/Core>
#include <functional>

namespace isorelax {

/// Value of a smooth function at x; fills its gradient.
using DifferentiableFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

struct MinimiseOptions {
  unsigned iterations = 100;
  /// Pairs of moves and gradient changes that are remembered; with none, every step goes down the gradient.
  unsigned memory = 8;
  /// Stops when an iteration lowers the value by less than this share of it.
  double tolerance = 1e-4;
  /// Length of the first step, in the units of x.
  double first_step = 1;
};

/// Minimises by limited-memory BFGS (Nocedal & Wright, Algorithm 7.5) with a line search that halves the step
/// until the value falls enough; x is where it starts and what comes of it. Returns the value there, never
/// more than at the start.
double minimise(const DifferentiableFunction& function, Eigen::VectorXd& x, const MinimiseOptions& options);

}  // namespace isorelax
