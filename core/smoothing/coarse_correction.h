#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "smoothing/newton_block.h"

namespace isorelax {

/// The second level of L-BFGS' preconditioner: what groups of neighbouring vertices do when each moves as
/// one.
///
/// Newton blocks see one vertex at a time: what is wrong over many vertices alike shows in none of them, and
/// the larger the mesh, the more steps it takes. Vertices are put together in groups of about seven, each
/// with two unknowns in the tangent space of its first vertex. Between them stand the second derivatives of
/// the energy without those of the triangles' areas: each triangle's part is then positive semidefinite, and
/// at a vertex the same as in its Newton block. The sparse system is factored, filled anew from time to time.
class CoarseCorrection {
 public:
  /// Makes the groups, beginning where `here` is worst: how vertices are numbered plays no part. Keeps a
  /// reference to the problem.
  CoarseCorrection(const SmoothingProblem& problem, const Objective& here);

  /// Fills and factors the system. `here` is what the blocks, one for each vertex, were made from.
  void refresh(const Objective& here, std::span<const NewtonBlock> blocks);
  /// Finds the groups' moves for a residual, one vector per vertex.
  void solve(std::span<const Vec3> residual, std::span<const NewtonBlock> blocks);
  /// What the last solution moves a vertex by: zero where there is no group or the system has no factors.
  [[nodiscard]] Vec3 at(Index vertex, const NewtonBlock& block) const {
    const Index g = group_of_[vertex];
    if (g == kNone || !factored_) return Vec3::Zero();
    return block.tangent(solution_[2 * g] * frames_[g][0] + solution_[2 * g + 1] * frames_[g][1]);
  }

 private:
  /// A triangle whose vertices are not all in one group, and where the blocks of its pairs of corners are
  /// among the blocks; kNone for a pair with a corner in no group.
  struct Element {
    Index triangle;
    std::array<std::uint32_t, 6> slots;
  };
  /// The second derivatives of one triangle between the six unknowns of its corners.
  using ElementMatrix = Eigen::Matrix<double, 6, 6>;

  void find_groups(const Objective& here);
  void find_pattern();
  [[nodiscard]] ElementMatrix matrix_of(Index triangle, const Objective& here,
                                        std::span<const NewtonBlock> blocks) const;
  void add(const Element& element, const ElementMatrix& matrix);
  void factor();

  const SmoothingProblem& problem_;
  std::vector<Index> group_of_;             // of each vertex; kNone where it may not move
  std::vector<std::vector<Index>> groups_;  // vertices; the first gives the frame
  std::vector<std::array<Vec3, 2>> frames_;
  std::vector<Element> elements_;
  std::vector<std::array<Index, 2>> places_;  // groups of each block: column, row; sorted
  std::vector<Eigen::Matrix2d> blocks_;       // of the lower half
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd right_, solution_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
  bool analysed_ = false, factored_ = false;
};

}  // namespace isorelax
