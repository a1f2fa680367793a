#include "motion/isometry_element.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace isorelax {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;

template <typename Matrix>
Matrix clamp_positive(const Matrix& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(m);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

}  // namespace

ReferenceInverse reference_inverse(const std::array<Vec3, 3>& corners) {
  const Vec3 first = corners[1] - corners[0];
  const Vec3 second = corners[2] - corners[0];
  const double length = first.norm();
  Eigen::Matrix2d edges;
  edges << length, first.dot(second) / length, 0, first.cross(second).norm() / length;
  return edges.inverse();
}

double element_energy(const std::array<Vec3, 3>& x, const ReferenceInverse& inverse, ElementWeights weights) {
  Mat32 edges;
  edges << x[1] - x[0], x[2] - x[0];
  const Mat32 f = edges * inverse;
  const double det = f.col(0).cross(f.col(1)).norm();
  if (!(det > 0)) return std::numeric_limits<double>::infinity();
  return (1 - weights.area) * f.squaredNorm() / det +
         weights.area * (std::pow(det, weights.power) + std::pow(det, -weights.power));
}

ElementModel element_model(const std::array<Vec3, 3>& x, const std::array<Mat32, 3>& tangents,
                           const ReferenceInverse& inverse, ElementWeights weights) {
  Mat32 edges;
  edges << x[1] - x[0], x[2] - x[0];
  Mat3 frame;  // in-plane, in-plane, normal
  frame.col(0) = edges.col(0).normalized();
  frame.col(2) = edges.col(0).cross(edges.col(1)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  const Eigen::Matrix2d a = frame.leftCols<2>().transpose() * edges * inverse;
  const double d = a.determinant();
  const double i = a.squaredNorm();
  const double shape = 1 - weights.area;
  const double p = weights.power;
  const double up = std::pow(d, p);
  const double down = 1 / up;
  const double by_i = shape / d;
  const double by_d = -shape * i / (d * d) + weights.area * p * (up - down) / d;
  const double by_id = -shape / (d * d);
  const double by_dd =
      2 * shape * i / (d * d * d) + weights.area * p * ((p - 1) * up + (p + 1) * down) / (d * d);

  ElementModel model;
  model.energy = shape * i / d + weights.area * (up + down);
  using Vec4 = Eigen::Vector4d;
  const Vec4 flat(a(0, 0), a(1, 0), a(0, 1), a(1, 1));
  const Vec4 cofactor(a(1, 1), -a(0, 1), -a(1, 0), a(0, 0));
  const Vec4 gradient = 2 * by_i * flat + by_d * cofactor;
  Eigen::Matrix4d second = 2 * by_i * Eigen::Matrix4d::Identity() + by_dd * cofactor * cofactor.transpose() +
                           2 * by_id * (flat * cofactor.transpose() + cofactor * flat.transpose());
  second(0, 3) += by_d, second(3, 0) += by_d;
  second(1, 2) -= by_d, second(2, 1) -= by_d;
  second = clamp_positive(second);
  const Eigen::Matrix2d metric = a.transpose() * a;
  const Eigen::Matrix2d out =
      clamp_positive(Eigen::Matrix2d(2 * by_i * Eigen::Matrix2d::Identity() + by_d * d * metric.inverse()));

  // F = sum over the corners of x_k times a row; in-plane parts column by column, then the part along the
  // normal.
  Eigen::Matrix<double, 3, 2> rows;
  rows.row(1) = inverse.row(0);
  rows.row(2) = inverse.row(1);
  rows.row(0) = -rows.row(1) - rows.row(2);
  Eigen::Matrix<double, 4, 6> in_plane;
  Eigen::Matrix<double, 2, 6> normal;
  for (int k = 0; k < 3; ++k) {
    const Mat32 local = frame.transpose() * tangents[k];
    in_plane.block<2, 2>(0, 2 * k) = rows(k, 0) * local.topRows<2>();
    in_plane.block<2, 2>(2, 2 * k) = rows(k, 1) * local.topRows<2>();
    normal.block<1, 2>(0, 2 * k) = rows(k, 0) * local.row(2);
    normal.block<1, 2>(1, 2 * k) = rows(k, 1) * local.row(2);
  }
  model.gradient = in_plane.transpose() * gradient;
  model.hessian = in_plane.transpose() * second * in_plane + normal.transpose() * out * normal;
  return model;
}

}  // namespace isorelax
