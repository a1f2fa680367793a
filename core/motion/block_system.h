#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A symmetric sparse system with two unknowns at every vertex and a 2 x 2 block for every edge of a mesh.
/// Its pattern is found once; filling and factoring it again takes no new memory.
class BlockSystem {
 public:
  BlockSystem(std::span<const Triangle> triangles, Index vertex_count);

  void clear();
  /// Adds a triangle's 6 x 6 matrix and minus its gradient.
  void add(Index triangle, const Eigen::Matrix<double, 6, 6>& matrix,
           const Eigen::Matrix<double, 6, 1>& gradient);
  void add_diagonal(Index vertex, const Eigen::Matrix2d& matrix);
  /// Makes a vertex' unknowns zero. After all that was added.
  void hold(Index vertex);
  /// Weight of a vertex in the shift of `solve`.
  void set_shift(Index vertex, double weight) { shift_[vertex] = weight; }
  /// Solves (A + shift diag(weights)) s = right side by LDL^T. False where the matrix cannot be factored.
  [[nodiscard]] bool solve(double shift);
  [[nodiscard]] Eigen::Vector2d solution(Index vertex) const { return solution_.segment<2>(2 * vertex); }
  [[nodiscard]] Eigen::Vector2d right_side(Index vertex) const { return right_.segment<2>(2 * vertex); }

 private:
  [[nodiscard]] Eigen::Index slot(Index row, Index column) const;

  std::vector<Triangle> triangles_;
  Eigen::SparseMatrix<double> matrix_;  ///< lower half, compressed
  std::vector<std::array<Eigen::Index, 36>> slots_;
  std::vector<std::array<Eigen::Index, 3>> diagonal_;
  Eigen::VectorXd right_, solution_;
  std::vector<double> shift_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

}  // namespace isorelax
