#include <gtest/gtest.h>

#include <cmath>

#include "motion/runge_kutta.h"

namespace isorelax {
namespace {

/// One turn about the z axis.
double error_after_a_turn(int steps) {
  const auto field = make_rigid_field({Vec3(0, 0, 2 * M_PI), Vec3::Zero(), Vec3::Zero()});
  RungeKutta integrator(*field, 1);
  std::vector<Vec3> x = {Vec3(1, 0, 0)};
  for (int i = 0; i < steps; ++i) integrator.step(x, static_cast<double>(i) / steps, 1.0 / steps);
  return (x[0] - Vec3(1, 0, 0)).norm();
}

TEST(RungeKutta, ConvergesAtFourthOrder) {
  const double order = std::log2(error_after_a_turn(50) / error_after_a_turn(100));
  EXPECT_NEAR(order, 4, 0.2);
}

TEST(RungeKutta, ThePairEstimatesItsErrorAndIsOfFifthOrder) {
  const auto field = make_function_field([](const Vec3& x, double) -> Vec3 { return x; });
  RungeKutta integrator(*field, 1);
  std::vector<Vec3> moved;
  const std::vector<Vec3> x = {Vec3(1, 0, 0)};
  double last_error = 0;
  for (const double dt : {0.2, 0.1}) {
    const double estimate = integrator.pair_step(x, 0, dt, moved).largest;
    const double error = std::abs(moved[0].x() - std::exp(dt));
    EXPECT_LT(error, estimate);
    if (last_error > 0) {
      EXPECT_NEAR(std::log2(last_error / error), 6, 0.4);  // of one step
    }
    last_error = error;
  }
}

TEST(RungeKutta, AFieldThatThrowsOrIsNotFiniteNamesTimeAndVertexAndMovesNothing) {
  for (const bool throws : {true, false}) {
    const auto field = make_function_field([&](const Vec3& x, double t) -> Vec3 {
      if (t > 0.2 && x.x() > 2.5) {
        if (throws) throw std::runtime_error("no wind here");
        return Vec3::Constant(NAN);
      }
      return Vec3::UnitY();
    });
    RungeKutta integrator(*field, 0);
    std::vector<Vec3> x = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)};
    const std::vector<Vec3> before = x;
    try {
      integrator.step(x, 0, 0.5);
      FAIL() << "went on";
    } catch (const MotionError& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.rfind("at time 0.25, vertex 2: ", 0), 0U) << text;
      EXPECT_EQ(text.find("no wind here") != std::string::npos, throws) << text;
    }
    EXPECT_EQ(x, before);
  }
}

TEST(StepSizeControl, ShortensWhatWasRefusedAndLengthensWhatWasEasy) {
  const StepSizeControl control(1e-6);
  EXPECT_FALSE(control.accepts(1e-5));
  EXPECT_LT(control.next(0.1, 1e-5), 0.1);
  EXPECT_GT(control.next(0.1, 1e-9), 0.1);
  EXPECT_LE(control.next(0.1, 0), 0.4);
}

}  // namespace
}  // namespace isorelax
