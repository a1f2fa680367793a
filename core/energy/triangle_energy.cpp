#include "energy/triangle_energy.h"

#include <algorithm>

namespace isorelax {
namespace {

struct Geometry {
  std::array<Vec3, 3> l;               // l_k = x_{k-} - x_{k+}
  Vec3 normal;                         // unit
  double d2;                           // twice the area
  std::array<double, 3> edge_squared;  // |l_k|^2
};

Geometry measure(const std::array<Vec3, 3>& x) {
  Geometry g;
  for (unsigned k = 0; k < 3; ++k) {
    g.l[k] = x[previous(k)] - x[next(k)];
    g.edge_squared[k] = g.l[k].squaredNorm();
  }
  const Vec3 area = area_vector(x[0], x[1], x[2]);
  g.d2 = area.norm();
  g.normal = area / g.d2;
  return g;
}

/// d^2 S / d D2^2 = (3/4) D1^(1/2) D2^(-5/2) - (1/4) D1^(-1/2) D2^(-3/2).
double area_term_curvature(double d1, double d2) {
  const double root = std::sqrt(d1 / d2);
  return (0.75 * root - 0.25 / root) / (d2 * d2);
}

}  // namespace

TriangleEnergy evaluate_energy(const std::array<Vec3, 3>& x, const ReferenceTriangle& reference,
                               EnergyWeights weights) {
  const Geometry g = measure(x);
  return triangle_energy(g.edge_squared, g.d2, reference, weights);
}

std::array<Vec3, 3> energy_gradient(const std::array<Vec3, 3>& x, const ReferenceTriangle& reference,
                                    EnergyWeights weights) {
  const Geometry g = measure(x);
  const TriangleEnergy e = triangle_energy(g.edge_squared, g.d2, reference, weights);
  std::array<Vec3, 3> gradient;
  for (unsigned i = 0; i < 3; ++i) {
    gradient[i] =
        e.s[next(i)] * g.l[next(i)] - e.s[previous(i)] * g.l[previous(i)] + e.t * g.normal.cross(g.l[i]);
  }
  return gradient;
}

Mat3 energy_hessian_block_psd(const std::array<Vec3, 3>& x, unsigned i, const ReferenceTriangle& reference,
                              EnergyWeights weights) {
  const Geometry g = measure(x);
  const unsigned j = next(i);
  const unsigned k = previous(i);
  const Vec3 u = g.normal.cross(g.l[i]);  // dD2 / dx_i
  const Vec3 q = 2 * (reference.cot[j] * g.l[j] - reference.cot[k] * g.l[k]);
  double numerator = 0;  // Q = K D2
  for (unsigned c = 0; c < 3; ++c) numerator += reference.cot[c] * g.edge_squared[c];
  const double d = g.d2;
  const Mat3 plane = Mat3::Identity() - g.normal * g.normal.transpose();
  Mat3 h = weights.shape * (2 * (reference.cot[j] + reference.cot[k]) / d * plane -
                            (q * u.transpose() + u * q.transpose()) / (d * d) +
                            2 * numerator / (d * d * d) * (u * u.transpose()));
  // S depends on x_i through D2 alone, and D2 is linear in x_i within the plane; the shape term is Q / D2.
  h += weights.area * std::max(0.0, area_term_curvature(reference.d1, d)) * (u * u.transpose());
  return h;
}

}  // namespace isorelax
