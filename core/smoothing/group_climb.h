#pragma once

#include <Eigen/SparseCholesky>

#include "smoothing/newton_block.h"
#include "smoothing/polish_state.h"

namespace isorelax {

/// Raises the worst angles by moving all vertices around them together, where each for itself is held by its
/// neighbours: what a chain of triangles shares gets better by moves of the whole chain only.
///
/// A group are triangles that are connected by vertices that may move. Its step is Newton's for the soft
/// minimum -1/b log sum exp(-b s) of the scores s of all triangles at these vertices, without the second
/// derivatives of the scores, and damped. It is halved until the soft minimum is higher, and made by all
/// vertices or by none.
class GroupClimb {
 public:
  explicit GroupClimb(const SmoothingProblem& problem);

  /// What is to get better, and no worse.
  struct Aim {
    AngleGoal goal;
    double sharpness;  ///< b, per degree
    AngleRange bound;  ///< of all angles
    double spare;      ///< what the sum of the triangles' smallest angles may fall by, in degrees
  };
  /// Makes one step for each group of the flagged triangles. Returns the most that a soft minimum gained, in
  /// degrees.
  double sweep(PolishState& state, Aim aim, std::span<const std::uint8_t> flags);

 private:
  struct Group {
    std::vector<Index> vertices, triangles;  ///< the latter: all that change when the former move
  };
  [[nodiscard]] std::vector<Group> find_groups(const PolishState& state,
                                               std::span<const std::uint8_t> flags) const;
  double climb(PolishState& state, Aim& aim, const Group& group);
  /// Their triangles' soft minimum with all vertices as they are in `there_`; none where an angle is beyond
  /// the bound.
  [[nodiscard]] std::optional<double> value(const Aim& aim, const Group& group);
  /// The moves of the group's vertices, to `moves_`: none longer than it may be.
  void find_moves(PolishState& state, const Aim& aim, const Group& group, double value);
  void add_triangle(const Aim& aim, Index triangle, double value);

  const SmoothingProblem& problem_;
  std::vector<Vec3> there_;          // of all vertices, with the move that is tried
  std::vector<Index> place_;         // of a vertex in its group, or kNone
  std::vector<NewtonBlock> spaces_;  // tangent spaces, by place
  std::vector<Vec3> moves_;          // by place
  std::vector<double> scores_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd slope_, smallest_slope_;
  double smallest_ = 0;
};

}  // namespace isorelax
