#pragma once

#include "render/camera.h"
#include "render/gl_object.h"
#include "render/image.h"

namespace isorelax::render {

/// The framebuffer that pictures are drawn into: four samples per pixel, then one texture.
class Frame {
 public:
  /// Makes room for pictures of a size. Throws Error when OpenGL refuses.
  void resize(PictureSize size);

  /// Binds the multisampled part and sets the viewport.
  void bind_samples() const;
  /// Averages the samples into the texture and binds that.
  void resolve() const;

  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] Image read_back() const;

 private:
  GlFramebuffer sampled_;
  GlRenderbuffer sampled_color_;
  GlRenderbuffer sampled_depth_;
  GlFramebuffer resolved_;
  GlTexture texture_;
  PictureSize size_{0, 0};
};

/// One pixel that holds element numbers.
class PickFrame {
 public:
  PickFrame();
  /// Binds and clears it, with a viewport in which it is pixel (x, y) of a picture, y downwards.
  void bind(PictureSize size, int x, int y) const;
  /// The two numbers written: mesh + 1 (0: nothing) and triangle.
  void read(GLuint (&ids)[2]) const;

 private:
  GlFramebuffer framebuffer_;
  GlRenderbuffer ids_;
  GlRenderbuffer depth_;
};

/// Puts framebuffer binding and viewport back as they were.
class FramebufferGuard {
 public:
  FramebufferGuard();
  FramebufferGuard(const FramebufferGuard&) = delete;
  FramebufferGuard& operator=(const FramebufferGuard&) = delete;
  ~FramebufferGuard();

 private:
  GLint draw_framebuffer_ = 0;
  GLint read_framebuffer_ = 0;
  GLint viewport_[4] = {};
};

}  // namespace isorelax::render
