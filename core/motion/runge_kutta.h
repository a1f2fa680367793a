#pragma once

#include <span>
#include <vector>

#include "motion/velocity_field.h"

namespace isorelax {

/// The estimated error of a step: the largest of any point, in length units, and whose it is.
struct StepError {
  double largest = 0;
  Index vertex = 0;
};

/// Moves points along a velocity field. Keeps its memory between steps.
class RungeKutta {
 public:
  RungeKutta(const VelocityField& field, unsigned threads) : field_(&field), threads_(threads) {}

  /// One classical step of fourth order from t to t + dt. Throws MotionError; the points are then where they
  /// were.
  void step(std::span<Vec3> x, double t, double dt);

  /// One step of the embedded pair of Dormand and Prince (fifth order, with an estimate of fourth); `moved`
  /// gets the points at t + dt. Throws MotionError.
  StepError pair_step(std::span<const Vec3> x, double t, double dt, std::vector<Vec3>& moved);

 private:
  const VelocityField* field_;
  unsigned threads_;
  std::vector<Vec3> at_;
  std::vector<std::vector<Vec3>> slopes_;
};

/// Chooses the steps of an embedded pair: error a step at most `tolerance`.
class StepSizeControl {
 public:
  explicit StepSizeControl(double tolerance) : tolerance_(tolerance) {}
  [[nodiscard]] bool accepts(double error) const { return error <= tolerance_; }
  /// The step after one of dt with this error: for the same point in time if it was not accepted.
  [[nodiscard]] double next(double dt, double error) const;

 private:
  double tolerance_;
};

}  // namespace isorelax
