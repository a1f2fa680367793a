#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A mesh as OpenMesh holds it, which is seen nowhere else: the opponent in speed measurements. Vertex ids
/// are those of the mesh it was made from.
///
/// A half-edge structure holds manifold, consistently oriented surfaces only: triangles that do not fit are
/// left out and told by rejected_triangles().
class HalfedgeMesh {
 public:
  /// Copies positions and triangles; attributes are not looked at.
  explicit HalfedgeMesh(const TriangleMesh& mesh);
  ~HalfedgeMesh();
  HalfedgeMesh(HalfedgeMesh&& other) noexcept;
  HalfedgeMesh& operator=(HalfedgeMesh&& other) noexcept;

  /// Ids of the triangles that were not taken, ascending.
  [[nodiscard]] std::span<const Index> rejected_triangles() const;

  /// OpenMesh's own Jacobi Laplace smoother, tangential and C0. Fixes the boundary.
  void smooth_laplace(unsigned iterations);
  /// Vertices that smooth_laplace leaves where they are, besides those on borders: held[v] != 0.
  void hold(std::span<const std::uint8_t> held);

  [[nodiscard]] std::vector<Vec3> positions() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isorelax
