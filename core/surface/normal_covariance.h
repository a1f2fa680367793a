#pragma once

#include <span>

#include "mesh/lanes.h"
#include "mesh/topology.h"

namespace isorelax {

/// Symmetric 3 x 3 matrix by its six numbers.
struct SymmetricMatrix {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds v v^T.
  void add_outer(double x, double y, double z) {
    xx += x * x;
    xy += x * y;
    xz += x * z;
    yy += y * y;
    yz += y * z;
    zz += z * z;
  }
  [[nodiscard]] Mat3 to_matrix() const {
    Mat3 m;
    m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return m;
  }
};

/// Eigenvalues l1 >= l2 >= l3 of a normal covariance matrix and their unit eigenvectors (columns, same
/// order).
struct CovarianceEigen {
  Vec3 values;
  Mat3 vectors;
};

/// Normal covariance N W N^T at a vertex: sum over its triangles of area * n n^T (paper Sec. 3). Length units
/// squared.
SymmetricMatrix normal_covariance(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, Index vertex);

/// Full decomposition. The largest eigenvector is the normal, the smallest the direction of a ridge.
CovarianceEigen decompose(const SymmetricMatrix& covariance);

/// Eight covariance matrices, and what `dominant_eigenvectors` finds: one number per lane.
struct CovarianceBatch {
  Lanes xx, xy, xz, yy, yz, zz;

  void set(unsigned lane, const SymmetricMatrix& m) {
    xx.at[lane] = m.xx, xy.at[lane] = m.xy, xz.at[lane] = m.xz;
    yy.at[lane] = m.yy, yz.at[lane] = m.yz, zz.at[lane] = m.zz;
  }
};

/// Unit eigenvectors of the largest eigenvalues: exact for planar neighbourhoods, many times cheaper than
/// `decompose` where the largest eigenvalue stands out, equal to it elsewhere. Zero for a zero matrix. Signs
/// are arbitrary.
std::array<Vec3, kLanes> dominant_eigenvectors(const CovarianceBatch& batch);

}  // namespace isorelax
