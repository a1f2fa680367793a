#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <random>

#include "energy/triangle_energy.h"

namespace isorelax {
namespace {

using Points = std::array<Vec3, 3>;

/// Random triangles, references and weights with some spread of shapes and sizes.
class RandomCases {
 public:
  Vec3 vector() { return {uniform(), uniform(), uniform()}; }
  Points triangle() {
    for (;;) {
      const double size = std::pow(10.0, 2 * uniform());
      Points x = {size * vector(), size * vector(), size * vector()};
      if (area_vector(x[0], x[1], x[2]).norm() > 0.05 * size * size) return x;
    }
  }
  ReferenceTriangle reference() {
    const Points r = triangle();
    return reference_from_points(r[0], r[1], r[2]);
  }
  EnergyWeights weights() { return {std::abs(uniform()) + 0.01, std::abs(uniform())}; }
  double uniform() { return distribution_(engine_); }

 private:
  std::mt19937_64 engine_{static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed())};
  std::uniform_real_distribution<double> distribution_{-1, 1};
};

/// The definition itself (paper Eqs. 1, 2): Jacobians of both triangles in their own planes, singular values
/// of A = J2 J1^-1. Slow and plain on purpose.
struct Oracle {
  double shape, area;
};
Eigen::Matrix2d jacobian(const Points& x) {
  const Vec3 e1 = (x[1] - x[0]).normalized();
  const Vec3 e3 = area_vector(x[0], x[1], x[2]).normalized();
  const Vec3 e2 = e3.cross(e1);
  Eigen::Matrix2d j;
  j << e1.dot(x[1] - x[0]), e1.dot(x[2] - x[0]), e2.dot(x[1] - x[0]), e2.dot(x[2] - x[0]);
  return j;
}
Oracle oracle(const Points& x, const Points& reference) {
  const Eigen::Matrix2d a = jacobian(x) * jacobian(reference).inverse();
  const Eigen::Vector2d sigma = Eigen::JacobiSVD<Eigen::Matrix2d>(a).singularValues();
  const double kappa = sigma[0] / sigma[1];
  const double root = std::sqrt(a.determinant());
  return {kappa + 1 / kappa, root + 1 / root};
}

double energy_at(const Points& x, const ReferenceTriangle& r, EnergyWeights w) {
  return evaluate_energy(x, r, w).energy;
}

/// Order at which a remainder falls when the step is divided by ten.
double observed_order(double large, double small) {
  return std::log10(large / small);
}

TEST(TriangleEnergy, AgreesWithTheSingularValuesOfA) {
  RandomCases random;
  for (int i = 0; i < 500; ++i) {
    const Points x = random.triangle();
    const Points r = random.triangle();
    const EnergyWeights w = random.weights();
    const TriangleEnergy e = evaluate_energy(x, reference_from_points(r[0], r[1], r[2]), w);
    const Oracle o = oracle(x, r);
    EXPECT_NEAR(e.shape, o.shape, 1e-10 * o.shape);
    EXPECT_NEAR(e.area, o.area, 1e-10 * o.area);
    EXPECT_NEAR(e.energy, w.shape * o.shape + w.area * o.area, 1e-10 * e.energy);
    EXPECT_GE(e.shape, 2 - 1e-12);
    EXPECT_GE(e.area, 2 - 1e-12);
  }
}

TEST(TriangleEnergy, IsSmallestWhereTheTriangleIsItsReference) {
  RandomCases random;
  const Points x = random.triangle();
  const ReferenceTriangle own = reference_from_points(x[0], x[1], x[2]);
  const TriangleEnergy e = evaluate_energy(x, own, {0.7, 0.3});
  EXPECT_NEAR(e.shape, 2, 1e-12);
  EXPECT_NEAR(e.area, 2, 1e-12);
  for (const Vec3& g : energy_gradient(x, own, {0.7, 0.3})) EXPECT_LT(g.norm() * std::sqrt(e.d2), 1e-9);
}

TEST(TriangleEnergy, GradientPassesTheTaylorTestAtSecondOrder) {
  RandomCases random;
  for (int i = 0; i < 200; ++i) {
    const Points x = random.triangle();
    const ReferenceTriangle r = random.reference();
    const EnergyWeights w = random.weights();
    const auto gradient = energy_gradient(x, r, w);
    const double scale = 0.1 * std::sqrt(evaluate_energy(x, r, w).d2);
    const Points direction = {scale * random.vector(), scale * random.vector(), scale * random.vector()};
    double slope = 0;
    for (unsigned k = 0; k < 3; ++k) slope += gradient[k].dot(direction[k]);
    const auto remainder = [&](double h) {
      Points moved = x;
      for (unsigned k = 0; k < 3; ++k) moved[k] += h * direction[k];
      return std::abs(energy_at(moved, r, w) - energy_at(x, r, w) - h * slope);
    };
    const double large = remainder(1e-2);
    const double small = remainder(1e-3);
    // Where the second derivative happens to vanish along this direction there is no order to observe.
    if (large < 1e-7 * energy_at(x, r, w)) continue;
    EXPECT_GT(observed_order(large, small), 1.7) << "case " << i;
  }
}

TEST(TriangleEnergy, GradientWithTheSignPrintedInThePaperWouldFailTheTaylorTest) {
  RandomCases random;
  const Points x = random.triangle();
  const ReferenceTriangle r = random.reference();
  const EnergyWeights w{1, 1};
  const TriangleEnergy e = evaluate_energy(x, r, w);
  const Vec3 normal = area_vector(x[0], x[1], x[2]).normalized();
  const Vec3 u = normal.cross(x[2] - x[1]);
  const Vec3 direction = 0.1 * std::sqrt(e.d2) * u.normalized();
  const Vec3 printed = energy_gradient(x, r, w)[0] - 2 * e.t * u;
  const auto remainder = [&](double h) {
    const Points moved = {x[0] + h * direction, x[1], x[2]};
    return std::abs(energy_at(moved, r, w) - e.energy - h * printed.dot(direction));
  };
  EXPECT_LT(observed_order(remainder(1e-3), remainder(1e-4)), 1.3);
}

TEST(TriangleEnergy, HessianBlockPassesTheTaylorTestInThePlane) {
  RandomCases random;
  for (int i = 0; i < 200; ++i) {
    const Points x = random.triangle();
    ReferenceTriangle r = random.reference();
    r.d1 = std::max(r.d1, area_vector(x[0], x[1], x[2]).norm() / 2.5);  // nothing is clamped
    const EnergyWeights w = random.weights();
    const Vec3 normal = area_vector(x[0], x[1], x[2]).normalized();
    const double scale = 0.1 * std::sqrt(evaluate_energy(x, r, w).d2);
    for (unsigned corner = 0; corner < 3; ++corner) {
      Vec3 direction = random.vector();
      direction -= normal * normal.dot(direction);
      direction *= scale / direction.norm();
      const Vec3 change = energy_hessian_block_psd(x, corner, r, w) * direction;
      const auto remainder = [&](double h) {
        Points moved = x;
        moved[corner] += h * direction;
        return (energy_gradient(moved, r, w)[corner] - energy_gradient(x, r, w)[corner] - h * change).norm();
      };
      EXPECT_GT(observed_order(remainder(1e-2), remainder(1e-3)), 1.7) << "case " << i;
    }
  }
}

TEST(TriangleEnergy, ClampedHessianBlockIsPositiveSemiDefinite) {
  RandomCases random;
  for (int i = 0; i < 200; ++i) {
    const Points x = random.triangle();
    const Mat3 h = energy_hessian_block_psd(x, 0, random.reference(), random.weights());
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Mat3>(h).eigenvalues();
    EXPECT_GE(values[0], -1e-9 * values[2]);
    EXPECT_GT(values[1], 0);  // only the normal is in the kernel
  }
}

TEST(TriangleEnergy, KnownValues) {
  // Right isosceles triangle with legs of 1 against an equilateral one of the same area: K = (1 + 1 + 2) /
  // sqrt(3).
  const Points x = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const TriangleEnergy e = evaluate_energy(x, equilateral_reference(1), {1, 1});
  EXPECT_NEAR(e.shape, 4 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(e.area, 2, 1e-15);
  EXPECT_NEAR(evaluate_energy(x, equilateral_reference(0.25), {1, 1}).area, 2.5, 1e-15);
}

}  // namespace
}  // namespace isorelax
