#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "surface/normal_covariance.h"

namespace isorelax {

/// Speed of a surface along its normal, at a point and a time; length units over time units.
using NormalSpeed = std::function<double(const Vec3& x, double t)>;

struct FaceOffsettingOptions {
  /// Eigenvalues of the normal covariance above this share of the largest span the primary space: tan^2 of
  /// half the turn of a crease of 30 degrees.
  double primary_share = 0.0717967697;
  /// Share of a step that is taken at a time when a triangle would fold: of the way to the fold.
  double safe_share = 0.5;
  /// Smallest part of a step, of the step: below it the surface folds.
  double least_part = 1e-4;
};

/// What one step did.
struct OffsetReport {
  unsigned parts = 1;  ///< that the step was cut into so that no triangle folds
};

/// Face offsetting (Jiao 2007): faces move, vertices are found again where the moved faces meet.
///
/// Every triangle moves to the plane offset by its motion; a vertex minimises the weighted squared distances
/// to the planes of its triangles. The eigen-decomposition of the weighted normal covariance N W N^T tells in
/// which directions the planes say something (the primary space: one in a smooth place, two on a ridge, three
/// in a corner); in the others, the null space, a vertex keeps its own tangential motion: none when the
/// motion propagates along normals. So creases and corners stay sharp, and a smooth surface does not wrinkle.
/// A step is cut where the signed area of a triangle would vanish along it.
class FaceOffsetting {
 public:
  FaceOffsetting(std::span<const Triangle> triangles, const Topology& topology,
                 const FaceOffsettingOptions& options, unsigned threads);

  /// Motion along normals with a speed that may depend on place and time: first order in dt, exact for planes
  /// of constant speed. Throws MotionError where the surface folds, the positions then unchanged.
  OffsetReport propagate(const NormalSpeed& speed, double t, double dt, std::span<Vec3> positions);

  /// Motion with the flow: `moved` is where a flow takes the vertices during the step. The planes of the
  /// moved triangles pass through the moved vertices, so that what is found agrees with them where the
  /// surface is resolved. Overwrites positions. Returns false, positions unchanged, where a triangle would
  /// fold: the caller takes a shorter step.
  [[nodiscard]] bool advect(std::span<const Vec3> moved, std::span<Vec3> positions);

 private:
  void offset_vertices(std::span<const Vec3> positions);
  [[nodiscard]] double fold_share(std::span<const Vec3> positions, Index& vertex) const;

  std::vector<Triangle> triangles_;
  const Topology* topology_;
  FaceOffsettingOptions options_;
  unsigned threads_;
  std::vector<Vec3> normals_;  ///< of the moved planes, with the length of twice the old area
  std::vector<Vec3> anchors_;  ///< a point of each moved plane
  std::vector<Vec3> own_;      ///< own motion of each vertex
  std::vector<Vec3> moves_;
};

}  // namespace isorelax
