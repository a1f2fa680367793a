#include "surface/normal_covariance.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace isorelax {
namespace {

/// Unit vectors, and how purely the powers of the matrices consist of that one direction: 1 after
/// convergence.
struct PowerBatch {
  Lanes x, y, z, purity;
};

/// Four squarings raise each matrix to the 16th power: what is not the dominant direction shrinks to (l2 /
/// l1)^16.
ISORELAX_VECTOR_CLONES
void power_iteration(const CovarianceBatch& m, PowerBatch& out) {
  for (unsigned i = 0; i < kLanes; ++i) {
    double xx = m.xx.at[i], xy = m.xy.at[i], xz = m.xz.at[i], yy = m.yy.at[i], yz = m.yz.at[i],
           zz = m.zz.at[i];
    const double trace = xx + yy + zz;
    double scale = 1 / (trace > 0 ? trace : 1);
#pragma GCC unroll 4
    for (int round = 0; round < 4; ++round) {
      xx *= scale, xy *= scale, xz *= scale, yy *= scale, yz *= scale, zz *= scale;
      const double sxx = xx * xx + xy * xy + xz * xz;
      const double sxy = xx * xy + xy * yy + xz * yz;
      const double sxz = xx * xz + xy * yz + xz * zz;
      const double syy = xy * xy + yy * yy + yz * yz;
      const double syz = xy * xz + yy * yz + yz * zz;
      const double szz = xz * xz + yz * yz + zz * zz;
      xx = sxx, xy = sxy, xz = sxz, yy = syy, yz = syz, zz = szz;
      const double sum = xx + yy + zz;
      scale = 1 / (sum > 0 ? sum : 1);
    }
    // The longest column, without a branch.
    const bool y_wins = yy > xx;
    const double best = y_wins ? yy : xx;
    const bool z_wins = zz > best;
    const double vx = z_wins ? xz : (y_wins ? xy : xx);
    const double vy = z_wins ? yz : (y_wins ? yy : xy);
    const double vz = z_wins ? zz : (y_wins ? yz : xz);
    const double squares = vx * vx + vy * vy + vz * vz;
    const double inverse = 1 / std::sqrt(squares > 0 ? squares : 1);
    out.x.at[i] = vx * inverse;
    out.y.at[i] = vy * inverse;
    out.z.at[i] = vz * inverse;
    // trace(P^2) = trace(P)^2 for one direction alone; a second one of comparable weight makes it smaller.
    out.purity.at[i] = (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz)) * scale * scale;
  }
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

std::array<Vec3, kLanes> dominant_eigenvectors(const CovarianceBatch& m) {
  PowerBatch power;
  power_iteration(m, power);
  std::array<Vec3, kLanes> vectors;
  for (unsigned i = 0; i < kLanes; ++i) {
    if (!(m.xx.at[i] + m.yy.at[i] + m.zz.at[i] > 0)) {
      vectors[i].setZero();
    } else if (power.purity.at[i] > 1 - 1e-13) {
      vectors[i] = {power.x.at[i], power.y.at[i], power.z.at[i]};
    } else {
      vectors[i] =
          decompose({m.xx.at[i], m.xy.at[i], m.xz.at[i], m.yy.at[i], m.yz.at[i], m.zz.at[i]}).vectors.col(0);
    }
  }
  return vectors;
}

}  // namespace isorelax
