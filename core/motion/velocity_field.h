#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/error.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A motion that cannot go on: names the time, and the vertex where there is one. Exit status 3.
class MotionError : public Error {
 public:
  MotionError(double time, Index vertex, const std::string& reason);
};

/// A velocity given everywhere in space: the motion is dx/dt = u(x, t).
class VelocityField {
 public:
  virtual ~VelocityField() = default;
  /// Length units over time units. Called from several threads at once. May throw.
  [[nodiscard]] virtual Vec3 at(const Vec3& x, double t) const = 0;
};

/// u[i] = field(x[i], t). Throws MotionError, naming the first vertex, where the field throws or its value is
/// not finite.
void sample_field(const VelocityField& field, std::span<const Vec3> x, double t, unsigned threads,
                  std::span<Vec3> u);

/// Eq. (10) of the paper: cos(pi t / T) (sin^2(pi x) (sin 2 pi z - sin 2 pi y), and cyclic). Reverses at T/2.
std::unique_ptr<VelocityField> make_paper_field(double period);
/// LeVeque 1996, Enright et al. 2002: cos(pi t / T) (2 sin^2(pi x) sin 2 pi y sin 2 pi z,
/// -sin 2 pi x sin^2(pi y) sin 2 pi z, -sin 2 pi x sin 2 pi y sin^2(pi z)).
std::unique_ptr<VelocityField> make_enright_field(double period);

/// A rigid motion: u = velocity + rotation x (x - centre).
struct RigidMotion {
  Vec3 rotation = Vec3::Zero();  ///< angular velocity, radians over time
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
};
std::unique_ptr<VelocityField> make_rigid_field(const RigidMotion& motion);
/// Where a point is after a time.
[[nodiscard]] Vec3 place_after(const Vec3& x, const RigidMotion& motion, double t);

/// A shear: u = rate * ((x - centre) . across) * along.
struct ShearMotion {
  double rate = 1;
  Vec3 along = Vec3::UnitX();
  Vec3 across = Vec3::UnitY();
  Vec3 centre = Vec3::Zero();
};
std::unique_ptr<VelocityField> make_shear_field(const ShearMotion& motion);
/// Where a point is after a time. Precondition: along and across are orthogonal.
[[nodiscard]] Vec3 place_after(const Vec3& x, const ShearMotion& motion, double t);

/// Any function.
std::unique_ptr<VelocityField> make_function_field(std::function<Vec3(const Vec3&, double)> function);

}  // namespace isorelax
