#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "smoothing/run.h"

namespace isorelax {

/// Makes the smoother for a problem.
using SmootherFactory = std::function<std::unique_ptr<Smoother>(const SmoothingProblem&)>;

/// The largest deviation for a mesh when nobody stated one, over the bounding-box diagonal: 0.003, more where
/// the mesh is coarse, since two good meshes of one curved surface differ by the height of their chords: with
/// the mean c of edge length times dihedral turn over its smooth edges 1.2 c up to 0.005, and 0.5 c beyond.
/// With a free border at least a mean edge: that is how far its outline may go.
[[nodiscard]] double automatic_limit(std::span<const Vec3> positions, const SmoothingProblem& problem,
                                     const ProblemOptions& options);

/// Limits to try before that one, nearest first, and it at last. The first is c, no more than half of the
/// last, each the double of the one before. It alone where nothing can leave the surface, where vertices
/// are not brought back to it, or where the border is free.
[[nodiscard]] std::vector<double> automatic_limits(std::span<const Vec3> positions,
                                                   const SmoothingProblem& problem,
                                                   const ProblemOptions& options);

/// Tells whether a run under one limit would end with a much better mesh under a wider one: when the energy
/// hardly falls any more and vertices are at the limit, some steps under the wider limit are made on a copy,
/// and compared with as many of the run.
class WiderLimit {
 public:
  /// `make_wider` makes the problem of the run with the wider limit. Keeps references to the others.
  WiderLimit(const SmoothingProblem& problem, std::function<SmoothingProblem()> make_wider,
             const SmootherFactory& make_smoother)
      : problem_(problem), make_wider_(std::move(make_wider)), make_smoother_(make_smoother) {}

  /// To be told of every step of the run. Whether the wider limit is worth it: a smallest angle larger by a
  /// degree, a largest one smaller by two, or a mean of the triangles' smallest larger by 0.3.
  [[nodiscard]] bool is_worth_it(const StepRecord& record, std::span<const Vec3> positions);
  /// The same of a run that has ended.
  [[nodiscard]] bool is_worth_it_at_end(std::span<const Vec3> positions);

 private:
  struct Angles {
    double smallest, largest, mean;
  };
  [[nodiscard]] Angles angles_of(std::span<const Vec3> positions) const;
  void try_from(std::span<const Vec3> positions);
  [[nodiscard]] bool is_better_than(std::span<const Vec3> positions) const;

  const SmoothingProblem& problem_;
  std::function<SmoothingProblem()> make_wider_;
  const SmootherFactory& make_smoother_;
  bool at_limit_ = false;  // in the last step
  unsigned idle_steps_ = 0;
  std::optional<unsigned> steps_until_compared_;  // once it was tried
  Angles under_wider_{};
};

}  // namespace isorelax
