#pragma once

#include <Eigen/Core>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// The edges of a reference triangle in its plane, inverted: F = (x1 - x0, x2 - x0) * inverse maps the
/// reference onto the triangle.
using ReferenceInverse = Eigen::Matrix2d;
[[nodiscard]] ReferenceInverse reference_inverse(const std::array<Vec3, 3>& corners);

/// Weights of E = (1 - area) K + area (det + 1/det): shape as everywhere (method Sec. 2), areas by tau_1,
/// which holds where tau_(1/2) gives way on triangles that are stretched many times over.
struct ElementWeights {
  double area = 0.3;
  double power = 1;  ///< p of det^p + det^-p
};

/// Value of one triangle; infinite where it has no area.
[[nodiscard]] double element_energy(const std::array<Vec3, 3>& x, const ReferenceInverse& inverse,
                                    ElementWeights weights);

/// Second-order model of one triangle for moves of its corners in their tangent planes.
struct ElementModel {
  double energy = 0;
  Eigen::Matrix<double, 6, 1> gradient;
  Eigen::Matrix<double, 6, 6> hessian;  ///< positive semi-definite
};

/// `tangents[k]` spans the plane in which corner k moves (orthonormal columns). The second derivatives in the
/// triangle's plane (4 x 4) and out of it (2 x 2) are made positive semi-definite each by itself.
/// Precondition: the triangle has area.
[[nodiscard]] ElementModel element_model(const std::array<Vec3, 3>& x,
                                         const std::array<Eigen::Matrix<double, 3, 2>, 3>& tangents,
                                         const ReferenceInverse& inverse, ElementWeights weights);

}  // namespace isorelax
