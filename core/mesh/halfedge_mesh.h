#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A half-edge view of a mesh (OpenMesh, seen nowhere else) for walks that want neighbours in order and for
/// edits of the connectivity. Vertex and triangle ids are those of the mesh it was made from and stay valid
/// through edits.
///
/// A half-edge structure holds manifold, consistently oriented surfaces only: triangles that do not fit are
/// left out and told by rejected_triangles(). What is asked about holds for the triangles that were taken.
class HalfedgeMesh {
 public:
  /// Copies positions and triangles; attributes are not looked at.
  explicit HalfedgeMesh(const TriangleMesh& mesh);
  ~HalfedgeMesh();
  HalfedgeMesh(HalfedgeMesh&& other) noexcept;
  HalfedgeMesh& operator=(HalfedgeMesh&& other) noexcept;

  /// Ids of the triangles that were not taken, ascending.
  [[nodiscard]] std::span<const Index> rejected_triangles() const;
  [[nodiscard]] std::size_t edge_count() const;

  /// Neighbours of a vertex counter-clockwise seen from outside; at a boundary vertex from one end of the fan
  /// to the other. Empty for a vertex in no triangle. Precondition: vertex is in range.
  [[nodiscard]] std::vector<Index> one_ring(Index vertex) const;
  /// The vertices of every boundary loop in order, the surface to the left.
  [[nodiscard]] std::vector<std::vector<Index>> boundary_loops() const;

  /// Turns the edge (a, b) within its two triangles; both keep their ids. False, and nothing changed, where
  /// there is no such inner edge or the turned one exists already.
  [[nodiscard]] bool flip_edge(Index a, Index b);
  /// False when the triangle is not there. Vertices stay.
  [[nodiscard]] bool remove_triangle(Index triangle);

  /// OpenMesh's own Jacobi Laplace smoother, tangential and C0: the opponent in speed measurements. Fixes the
  /// boundary.
  void smooth_laplace(unsigned iterations);
  /// Vertices that smooth_laplace leaves where they are, besides those on borders: held[v] != 0.
  void hold(std::span<const std::uint8_t> held);

  [[nodiscard]] std::vector<Vec3> positions() const;
  /// The triangles in order of their ids, removed and rejected ones left out.
  [[nodiscard]] std::vector<Triangle> triangles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isorelax
