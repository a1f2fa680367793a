#pragma once

#include <cstdint>

#include "render/camera.h"
#include "render/gl_loader.h"
#include "render/image.h"
#include "ui/interface.h"

namespace isorelax::editor {

/// How a texture travels through Dear ImGui.
inline ImTextureID texture_id(unsigned texture) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the interface of Dear ImGui
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

/// Draws the interface into a framebuffer of its own with OpenGL 3.3 core: the same pixels in a window and
/// without one. Needs the context that was current at construction.
class Painter {
 public:
  explicit Painter(render::GlLoader loader);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Draws the interface's last frame at this size.
  void paint(ui::Interface& interface, render::PictureSize size);
  /// Draws what the interface made.
  void paint(ui::Interface& interface, const ImDrawData& data, render::PictureSize size);
  /// Copies the last picture to the context's own framebuffer.
  void show(render::PictureSize window) const;
  /// The last picture.
  [[nodiscard]] render::Image read_back() const;

 private:
  void make_program();
  void resize(render::PictureSize size);
  void upload_atlas(ui::Interface& interface);
  void draw(const ImDrawData& data) const;

  render::PictureSize size_{0, 0};
  unsigned program_ = 0;
  int display_location_ = -1;
  unsigned vertex_array_ = 0, vertices_ = 0, indices_ = 0;
  unsigned framebuffer_ = 0, color_ = 0;
  unsigned atlas_ = 0, atlas_revision_ = 0;
};

}  // namespace isorelax::editor
