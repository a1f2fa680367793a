#pragma once

#include <array>
#include <cmath>

#include "energy/reference.h"

namespace isorelax {

/// Weights of the two parts of the near-isometry energy E = shape * K + area * S (paper Eq. 2 has 1 - mu_A
/// and mu_A).
struct EnergyWeights {
  double shape = 1;
  double area = 0;

  /// The paper's one-parameter form, 0 <= mu_A <= 1.
  static constexpr EnergyWeights from_mu(double mu_a) { return {1 - mu_a, mu_a}; }
};

/// Energy of one triangle and the scalars its gradient is made of (paper Eqs. 5-7, sign of t corrected).
///   K = (1 / D2) sum_k cot(alpha_k) |l_k|^2 = kappa + 1 / kappa >= 2
///   S = sqrt(D2 / D1) + sqrt(D1 / D2) >= 2
/// with the edge l_k = x_{k-} - x_{k+} opposite to corner k, alpha_k the reference's angles, and D1, D2 twice
/// the area of the reference and of the triangle.
struct TriangleEnergy {
  double shape = 0;           ///< K
  double area = 0;            ///< S
  double energy = 0;          ///< E = w_s K + w_a S
  double d2 = 0;              ///< twice the triangle's area
  std::array<double, 3> s{};  ///< s_k = w_s 2 cot(alpha_k) / D2
  double t = 0;  ///< t = -w_s K / D2 + w_a (D2 - D1) / (2 sqrt(D1) D2^(3/2)), the same at all corners
};

/// Energy of the triangle with the given squared edge lengths |l_k|^2 and doubled area d2 > 0. Inline: this
/// is what the smoothers' loops run.
inline TriangleEnergy triangle_energy(const std::array<double, 3>& edge_squared, double d2,
                                      const ReferenceTriangle& reference, EnergyWeights weights) {
  TriangleEnergy e;
  const double inverse = 1 / d2;
  e.d2 = d2;
  e.shape = (reference.cot[0] * edge_squared[0] + reference.cot[1] * edge_squared[1] +
             reference.cot[2] * edge_squared[2]) *
            inverse;
  const double root = std::sqrt(d2 / reference.d1);  // sqrt(det A)
  e.area = root + 1 / root;
  e.energy = weights.shape * e.shape + weights.area * e.area;
  const double s = 2 * weights.shape * inverse;
  e.s = {s * reference.cot[0], s * reference.cot[1], s * reference.cot[2]};
  // (D2 - D1) / (2 sqrt(D1) D2^(3/2)) = (root - 1 / root) / (2 D2)
  e.t = inverse * (0.5 * weights.area * (root - 1 / root) - weights.shape * e.shape);
  return e;
}

/// Energy of triangle (x[0], x[1], x[2]) in space. Precondition: it has area.
TriangleEnergy evaluate_energy(const std::array<Vec3, 3>& x, const ReferenceTriangle& reference,
                               EnergyWeights weights);

/// Gradient of E with respect to the three corners (paper Eq. 6): g_i = s_{i+} l_{i+} - s_{i-} l_{i-} + t n x
/// l_i.
std::array<Vec3, 3> energy_gradient(const std::array<Vec3, 3>& x, const ReferenceTriangle& reference,
                                    EnergyWeights weights);

/// Second derivative of E with respect to corner `i` alone, for moves in the triangle's plane (3 x 3,
/// symmetric, the plane's normal is in its kernel), with the area term's clamped at zero: exact for D2 < 3 D1
/// or w_a = 0, and positive semi-definite everywhere. What Newton steps are made of (method Sec. 3).
Mat3 energy_hessian_block_psd(const std::array<Vec3, 3>& x, unsigned i, const ReferenceTriangle& reference,
                              EnergyWeights weights);

}  // namespace isorelax
