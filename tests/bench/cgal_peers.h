#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax::bench {

/// A mesh as CGAL's Polygon mesh processing sees it. Smoothing moves its vertices and keeps its connectivity.
class CgalMesh {
 public:
  /// `held`: one byte per vertex, not 0 where it may not move. Throws Error where CGAL cannot hold the mesh.
  CgalMesh(const TriangleMesh& mesh, std::span<const std::uint8_t> held);
  ~CgalMesh();
  CgalMesh(const CgalMesh&) = delete;
  CgalMesh& operator=(const CgalMesh&) = delete;

  /// angle_and_area_smoothing, the angles only: safety constraints on, projected to the input.
  void smooth_angles(unsigned iterations);
  /// The same with the areas too (Ceres), without flips.
  void smooth_angles_and_areas(unsigned iterations);
  void relax_tangentially(unsigned iterations);

  [[nodiscard]] std::vector<Vec3> positions() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isorelax::bench
