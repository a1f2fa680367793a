#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "render/image.h"
#include "render/offscreen.h"
#include "render/renderer.h"
#include "view/scene.h"

namespace isorelax::view {

/// Meshes that a picture shows, left to right, and the one that differences and arrows start from.
struct Exhibits {
  std::vector<const TriangleMesh*> meshes;
  const TriangleMesh* against = nullptr;
};

/// A picture with the view that makes it again: camera and range as numbers.
struct Picture {
  render::Image image;
  View view;
};

/// Who shares a picture with whom: that decides how much room the camera is fitted to.
enum class Arrangement : std::uint8_t { side_by_side, one_by_one };

/// The view with its camera and its range as numbers, fitted to these meshes: all in one picture, or one
/// after the other in pictures of their own (the frames of a sequence). Throws UsageError (camera, a
/// difference or arrows without a mesh to start from), MeshError (that mesh has other triangles), InputError
/// (the energy's reference).
[[nodiscard]] View resolve(const View& view, const Exhibits& exhibits,
                           Arrangement arrangement = Arrangement::side_by_side);

/// Makes pictures of views without a display. Keeps one OpenGL context for all of them.
class Studio {
 public:
  /// Throws Error: no OpenGL.
  explicit Studio(render::ContextKind context = render::ContextKind::osmesa);
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;
  ~Studio();

  /// One picture of all meshes, with one camera and one range. Throws as resolve; UsageError (size),
  /// MeshError (too large for OpenGL).
  [[nodiscard]] Picture draw(const View& view, const Exhibits& exhibits);

 private:
  [[nodiscard]] render::Image draw_scene(const render::Scene& scene, const render::Camera& camera,
                                         render::PictureSize size, int supersampling);

  std::unique_ptr<render::OffscreenContext> context_;
  render::Renderer renderer_;
};

/// The texts that a PNG of this view carries.
[[nodiscard]] render::PictureTexts texts_of(const View& view);
/// Writes a PNG that carries its view, so that `render --like` makes it again. Throws OutputError.
void write_picture(const std::filesystem::path& path, const Picture& picture);
/// Reads a view from a JSON file, or from a PNG written so. Throws InputError.
[[nodiscard]] View read_view(const std::filesystem::path& path);

}  // namespace isorelax::view
