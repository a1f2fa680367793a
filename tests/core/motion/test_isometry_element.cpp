#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "energy/triangle_energy.h"
#include "motion/isometry_element.h"

namespace isorelax {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;

const std::array<Vec3, 3> kTriangleCorners = {Vec3(0.1, 0, 0.3), Vec3(1.2, 0.1, 0), Vec3(0.3, 0.7, 0.2)};
const std::array<Vec3, 3> kReferenceCorners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, 0, 0.9)};

Mat32 plane_about(const Vec3& normal) {
  Mat32 plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.normalized().cross(plane.col(0));
  return plane;
}

TEST(IsometryElement, ItsShapePartIsTheEnergyOfTheSmoothers) {
  const ReferenceTriangle reference =
      reference_from_points(kReferenceCorners[0], kReferenceCorners[1], kReferenceCorners[2]);
  const double expected = evaluate_energy(kTriangleCorners, reference, {1, 0}).shape;
  EXPECT_NEAR(element_energy(kTriangleCorners, reference_inverse(kReferenceCorners), {0, 1}), expected,
              1e-12);
}

TEST(IsometryElement, GradientAgreesWithDifferences) {
  for (const double power : {1.0, 3.0}) {
    const ElementWeights weights{0.3, power};
    const ReferenceInverse inverse = reference_inverse(kReferenceCorners);
    const std::array<Mat32, 3> planes = {plane_about({0.1, 0.2, 1}), plane_about({0, -0.3, 1}),
                                         plane_about({0.4, 0, 1})};
    const ElementModel model = element_model(kTriangleCorners, planes, inverse, weights);
    EXPECT_NEAR(model.energy, element_energy(kTriangleCorners, inverse, weights), 1e-12);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 6; ++i) {
      std::array<Vec3, 3> ahead = kTriangleCorners;
      std::array<Vec3, 3> back = kTriangleCorners;
      const Vec3 move = kStep * planes[i / 2].col(i % 2);
      ahead[i / 2] += move;
      back[i / 2] -= move;
      const double slope =
          (element_energy(ahead, inverse, weights) - element_energy(back, inverse, weights)) / (2 * kStep);
      EXPECT_NEAR(slope, model.gradient[i], 1e-7);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(model.hessian);
    EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-9);
  }
}

TEST(IsometryElement, HessianIsTheSecondDerivativeWhereThatIsPositive) {
  // At the reference itself, in its plane, nothing is clamped.
  const ElementWeights weights{0.3, 3};
  const ReferenceInverse inverse = reference_inverse(kReferenceCorners);
  const Mat32 plane =
      plane_about(area_vector(kReferenceCorners[0], kReferenceCorners[1], kReferenceCorners[2]));
  const ElementModel model = element_model(kReferenceCorners, {plane, plane, plane}, inverse, weights);
  constexpr double kStep = 1e-4;
  const auto at = [&](int i, double a, int j, double b) {
    std::array<Vec3, 3> x = kReferenceCorners;
    x[i / 2] += a * plane.col(i % 2);
    x[j / 2] += b * plane.col(j % 2);
    return element_energy(x, inverse, weights);
  };
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double second = (at(i, kStep, j, kStep) - at(i, kStep, j, -kStep) - at(i, -kStep, j, kStep) +
                             at(i, -kStep, j, -kStep)) /
                            (4 * kStep * kStep);
      EXPECT_NEAR(second, model.hessian(i, j), 1e-4);
    }
  }
}

}  // namespace
}  // namespace isorelax
