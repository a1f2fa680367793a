#pragma once

#include <functional>

#include "motion/motion_measure.h"
#include "motion/velocity_field.h"

namespace isorelax {

/// Brings a point to the surface that a mesh was made from.
using SurfacePlacement = std::function<Vec3(const Vec3&)>;

/// The ground truth for a mesh that a field carries: a dense copy of its start, every vertex of which goes
/// with the flow and is never redistributed.
class DenseCopy {
 public:
  /// Cuts every triangle into four, `levels` times. New vertices stand where `place` puts the middles of
  /// edges; without it, on the smooth surface through the start's vertices (see FlowMap).
  DenseCopy(const TriangleMesh& start, unsigned levels, const SurfacePlacement& place, unsigned threads);

  /// One step of fourth order. Throws MotionError.
  void advance(const VelocityField& field, double t, double dt);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// Of the vertices of `positions` from the copy's triangles, and of the copy's vertices from the triangles
  /// of `positions`.
  [[nodiscard]] std::pair<Distances, Distances> distances(std::span<const Vec3> positions,
                                                          std::span<const Triangle> triangles) const;

 private:
  TriangleMesh mesh_;
  unsigned threads_;
};

}  // namespace isorelax
