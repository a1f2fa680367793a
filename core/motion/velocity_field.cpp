#include "motion/velocity_field.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/text_out.h"
#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// sin(pi x) and cos(pi x) of the three coordinates.
struct HalfTurns {
  std::array<double, 3> sine, cosine;

  explicit HalfTurns(const Vec3& x) {
    for (int i = 0; i < 3; ++i) {
      sine[i] = std::sin(std::numbers::pi * x[i]);
      cosine[i] = std::cos(std::numbers::pi * x[i]);
    }
  }
  [[nodiscard]] double squared(int i) const { return sine[i] * sine[i]; }
  /// sin(2 pi x_i).
  [[nodiscard]] double twice(int i) const { return 2 * sine[i] * cosine[i]; }
};

class PaperField final : public VelocityField {
 public:
  explicit PaperField(double period) : period_(period) {}
  [[nodiscard]] Vec3 at(const Vec3& x, double t) const override {
    const HalfTurns s(x);
    const double pace = std::cos(std::numbers::pi * t / period_);
    return {pace * s.squared(0) * (s.twice(2) - s.twice(1)), pace * s.squared(1) * (s.twice(0) - s.twice(2)),
            pace * s.squared(2) * (s.twice(1) - s.twice(0))};
  }

 private:
  double period_;
};

class EnrightField final : public VelocityField {
 public:
  explicit EnrightField(double period) : period_(period) {}
  [[nodiscard]] Vec3 at(const Vec3& x, double t) const override {
    const HalfTurns s(x);
    const double pace = std::cos(std::numbers::pi * t / period_);
    return {2 * pace * s.squared(0) * s.twice(1) * s.twice(2), -pace * s.twice(0) * s.squared(1) * s.twice(2),
            -pace * s.twice(0) * s.twice(1) * s.squared(2)};
  }

 private:
  double period_;
};

class FunctionField final : public VelocityField {
 public:
  explicit FunctionField(std::function<Vec3(const Vec3&, double)> function)
      : function_(std::move(function)) {}
  [[nodiscard]] Vec3 at(const Vec3& x, double t) const override { return function_(x, t); }

 private:
  std::function<Vec3(const Vec3&, double)> function_;
};

}  // namespace

MotionError::MotionError(double time, Index vertex, const std::string& reason)
    : Error("at time " + digits_of(time) + (vertex == kNone ? "" : ", vertex " + std::to_string(vertex)) +
            ": " + reason) {}

void sample_field(const VelocityField& field, std::span<const Vec3> x, double t, unsigned threads,
                  std::span<Vec3> u) {
  struct Failure {
    Index vertex = kNone;
    std::string reason;
  };
  std::vector<Failure> failures(block_count(x.size()));
  parallel_for_blocks(x.size(), threads, [&](std::size_t begin, std::size_t end) {
    Failure& failure = failures[begin / kBlockSize];
    for (std::size_t i = begin; i < end && failure.vertex == kNone; ++i) {
      try {
        u[i] = field.at(x[i], t);
        if (u[i].allFinite()) continue;
        failure = {static_cast<Index>(i), "the velocity is not a finite number"};
      } catch (const std::exception& error) {
        failure = {static_cast<Index>(i), std::string("the velocity field fails: ") + error.what()};
      }
    }
  });
  for (const Failure& failure : failures)
    if (failure.vertex != kNone) throw MotionError(t, failure.vertex, failure.reason);
}

std::unique_ptr<VelocityField> make_paper_field(double period) {
  return std::make_unique<PaperField>(period);
}
std::unique_ptr<VelocityField> make_enright_field(double period) {
  return std::make_unique<EnrightField>(period);
}
std::unique_ptr<VelocityField> make_rigid_field(const RigidMotion& motion) {
  return make_function_field([motion](const Vec3& x, double) -> Vec3 {
    return motion.velocity + motion.rotation.cross(x - motion.centre);
  });
}
Vec3 place_after(const Vec3& x, const RigidMotion& motion, double t) {
  const double pace = motion.rotation.norm();
  if (!(pace > 0)) return x + t * motion.velocity;
  const Vec3 axis = motion.rotation / pace;
  const double angle = pace * t;
  // The integral of the turned velocity.
  const Vec3 along = axis.dot(motion.velocity) * axis;
  const Vec3 way = t * along + std::sin(angle) / pace * (motion.velocity - along) +
                   (1 - std::cos(angle)) / pace * axis.cross(motion.velocity);
  return motion.centre + Eigen::AngleAxisd(angle, axis) * (x - motion.centre) + way;
}
std::unique_ptr<VelocityField> make_shear_field(const ShearMotion& motion) {
  return make_function_field([motion](const Vec3& x, double) -> Vec3 {
    return motion.rate * (x - motion.centre).dot(motion.across) * motion.along;
  });
}
Vec3 place_after(const Vec3& x, const ShearMotion& motion, double t) {
  return x + t * motion.rate * (x - motion.centre).dot(motion.across) * motion.along;
}
std::unique_ptr<VelocityField> make_function_field(std::function<Vec3(const Vec3&, double)> function) {
  return std::make_unique<FunctionField>(std::move(function));
}

}  // namespace isorelax
