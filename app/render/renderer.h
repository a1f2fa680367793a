#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "mesh/triangle_mesh.h"
#include "render/camera.h"
#include "render/gl_loader.h"
#include "render/image.h"
#include "render/scene.h"

namespace isorelax::render {

/// What lies under a pixel.
struct Pick {
  std::size_t mesh = 0;  ///< in Scene::meshes
  Index triangle = 0;
  Index vertex = 0;  ///< the triangle's corner nearest to the pixel in the picture
  Vec3 point;        ///< where the line of sight meets the triangle's plane
};

/// Draws scenes into a framebuffer of its own with OpenGL 3.3 core: the same pixels in a window, in a
/// screenshot and in a test. Knows no window. All members but the constructor need the context that was
/// current at construction to be current again; the framebuffer binding 0 and viewport are left as they were.
class Renderer {
 public:
  /// Needs a current context. Throws Error: no OpenGL 3.3, a shader that does not compile.
  explicit Renderer(GlLoader loader);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  ~Renderer();

  /// Draws. Throws MeshError when a mesh is larger than the context's texture buffers, UsageError when the
  /// sides are not 1..max_size() or there are more pixels than in 8192 x 8192.
  void draw(const Scene& scene, const Camera& camera, PictureSize size);

  /// The texture that holds the last picture (GL_TEXTURE_2D, RGBA8, first row at the bottom as OpenGL has
  /// it): good until the next draw.
  [[nodiscard]] unsigned color_texture() const;
  /// The last picture. That of a transparent scene has its colours multiplied by alpha (see unmultiply).
  [[nodiscard]] Image read_back() const;

  /// The front-most triangle under pixel (x, y), y downwards, of the scene as it would be drawn.
  [[nodiscard]] std::optional<Pick> pick(const Scene& scene, const Camera& camera, PictureSize size, int x,
                                         int y);

  /// Largest side of a picture in pixels.
  [[nodiscard]] int max_size() const;

  /// Takes the shaders from files in a folder instead of those built in. Keeps the old ones when one does
  /// not compile. Throws Error naming the file and the compiler's first complaint.
  void reload_shaders(const std::filesystem::path& folder);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isorelax::render
