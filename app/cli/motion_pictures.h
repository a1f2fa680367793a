#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "render/image.h"

namespace isorelax::cli {

/// Pictures of a moving surface that can be laid side by side: one camera that sees all of them, triangles
/// coloured by area, relative to the mean area of the first mesh, on one range.
class MotionPictures {
 public:
  /// `camera`: see render::parse_camera. Throws UsageError for what is none.
  MotionPictures(std::string camera, int width, int height);

  /// Looks at a mesh that will be drawn: all of them come here before the first picture.
  void look_at(const TriangleMesh& mesh);
  [[nodiscard]] render::Image draw(const TriangleMesh& mesh, const std::string& caption) const;

 private:
  std::string camera_;
  int width_, height_;
  double mean_area_ = 0;
  double low_ = 1, high_ = 1;
  /// What the camera must see: the farthest point of all meshes in each of many directions.
  std::vector<Vec3> farthest_;
};

/// Pictures in rows of `columns`, all of one size.
[[nodiscard]] render::Image tile(std::span<const render::Image> images, std::size_t columns);

}  // namespace isorelax::cli
