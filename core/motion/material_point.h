#pragma once

#include <span>

#include "mesh/topology.h"
#include "surface/sectors.h"

namespace isorelax {

/// A point of a triangulated surface by its triangle and the weights of its corners (none negative, sum 1).
struct MaterialPoint {
  Index triangle = kNone;
  Vec3 weights = Vec3::Zero();
};

/// The surface a moving mesh started from, flat triangle by flat triangle: the parameter plane of everything
/// that is known about its motion. Points walk on it; they never cross a wall (a crease or a border).
class MaterialSurface {
 public:
  MaterialSurface(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                  const Topology& topology, const EdgeWalls& walls);

  [[nodiscard]] Index triangle_count() const { return static_cast<Index>(triangles_.size()); }
  [[nodiscard]] std::span<const Vec3> positions() const { return x_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] bool is_wall(Corner corner) const { return opposite_[corner] == kNone; }

  [[nodiscard]] Vec3 point(const MaterialPoint& m) const;
  /// Two orthonormal vectors that span the triangle.
  [[nodiscard]] const std::array<Vec3, 2>& frame(Index triangle) const { return frames_[triangle]; }
  /// Derivatives of the three weights along the two vectors of the frame.
  [[nodiscard]] const Eigen::Matrix<double, 3, 2>& gradient(Index triangle) const {
    return gradients_[triangle];
  }

  /// Walks from `from` by `move` (in the frame of its triangle), straight on over edges as if the triangles
  /// beyond were unfolded; ends at a wall or where a triangle has no area.
  [[nodiscard]] MaterialPoint walk(const MaterialPoint& from, const Eigen::Vector2d& move) const;

 private:
  std::vector<Vec3> x_;
  std::vector<Triangle> triangles_;
  std::vector<Corner> opposite_;  ///< kNone at walls
  std::vector<std::array<Vec3, 2>> frames_;
  std::vector<Eigen::Matrix<double, 3, 2>> gradients_;
};

}  // namespace isorelax
