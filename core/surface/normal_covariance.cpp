#include "surface/normal_covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace isorelax {
namespace {

SymmetricMatrix squared(const SymmetricMatrix& m, double scale) {
  const double xx = m.xx * scale, xy = m.xy * scale, xz = m.xz * scale;
  const double yy = m.yy * scale, yz = m.yz * scale, zz = m.zz * scale;
  return {xx * xx + xy * xy + xz * xz, xx * xy + xy * yy + xz * yz, xx * xz + xy * yz + xz * zz,
          xy * xy + yy * yy + yz * yz, xy * xz + yy * yz + yz * zz, xz * xz + yz * yz + zz * zz};
}

}  // namespace

SymmetricMatrix normal_covariance(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, Index vertex) {
  SymmetricMatrix sum;
  for (const Corner c : topology.corners_of(vertex)) {
    const Triangle& t = triangles[c / 3];
    const Vec3 n = area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
    const double doubled_area = n.norm();
    if (!(doubled_area > 0)) continue;
    const Vec3 weighted = n / std::sqrt(2 * doubled_area);  // area * n n^T = N N^T / (2 |N|)
    sum.add_outer(weighted.x(), weighted.y(), weighted.z());
  }
  return sum;
}

CovarianceEigen decompose(const SymmetricMatrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance.to_matrix());
  return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

Vec3 dominant_eigenvector(const SymmetricMatrix& covariance) {
  const double trace = covariance.xx + covariance.yy + covariance.zz;
  if (!(trace > 0)) return Vec3::Zero();
  // Four squarings raise the matrix to the 16th power: what is not the dominant direction shrinks to (l2 /
  // l1)^16.
  SymmetricMatrix power = covariance;
  double scale = 1 / trace;
  for (int i = 0; i < 4; ++i) {
    power = squared(power, scale);
    scale = 1 / (power.xx + power.yy + power.zz);
  }
  Vec3 v;
  if (power.xx >= power.yy && power.xx >= power.zz) {
    v = {power.xx, power.xy, power.xz};
  } else if (power.yy >= power.zz) {
    v = {power.xy, power.yy, power.yz};
  } else {
    v = {power.xz, power.yz, power.zz};
  }
  v /= std::sqrt(v.squaredNorm());
  // After convergence trace(P)^2 = trace(P^2); a second direction of comparable weight makes it larger.
  const double purity = (power.xx * power.xx + power.yy * power.yy + power.zz * power.zz +
                         2 * (power.xy * power.xy + power.xz * power.xz + power.yz * power.yz)) *
                        scale * scale;
  if (!(purity > 1 - 1e-13)) return decompose(covariance).vectors.col(0);
  return v;
}

}  // namespace isorelax
