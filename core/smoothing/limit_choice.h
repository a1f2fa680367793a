#pragma once

#include <span>

#include "smoothing/run.h"

namespace isorelax {

/// The largest deviations for a mesh when nobody stated one, over the bounding-box diagonal, with c the mean
/// of edge length times dihedral turn over the smooth edges.
struct AutomaticLimits {
  /// To begin under: c, but no less than an eighth of the widest. The widest itself where c is more than 0.7
  /// of it, where nothing can leave the surface, where vertices are not brought back to it, or where the
  /// border is free.
  double nearest;
  /// 0.003, more where the mesh is coarse, since two good meshes of one curved surface differ by the height
  /// of their chords: 1.2 c up to 0.005, and 0.5 c beyond. With a free border at least a mean edge: that is
  /// how far its outline may go.
  double widest;
  /// Vertices stay on the fits of the surface, which agree with each other: more than 9 in 10 curved
  /// triangles. Else they give up height before they give up way. 1.2 c counts up to 0.0075 then.
  bool on_fits;
};
[[nodiscard]] AutomaticLimits automatic_limits(std::span<const Vec3> positions,
                                               const SmoothingProblem& problem,
                                               const ProblemOptions& options);

/// Whether a run of at most so many steps that ended at `positions` should be done under a wider limit:
/// whether a few from there with the wider problem, no more than that, make a much better mesh, by a degree
/// of the smallest angle, two of the largest, or half of one in the mean of the triangles' smallest.
[[nodiscard]] bool wider_limit_pays(const SmoothingProblem& wider, const SmootherFactory& make_smoother,
                                    std::span<const Vec3> positions, unsigned iterations);

}  // namespace isorelax
