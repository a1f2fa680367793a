#pragma once

#include <span>

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

/// Eigenvector of the largest eigenvalue alone: exact for planar neighbourhoods, several times cheaper than
/// `decompose`. Zero for a zero matrix. Its sign is arbitrary.
Vec3 dominant_eigenvector(const SymmetricMatrix& covariance);

}  // namespace isorelax
