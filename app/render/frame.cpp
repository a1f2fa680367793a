#include "render/frame.h"

#include <algorithm>
#include <string>

#include "mesh/error.h"

namespace isorelax::render {
namespace {

/// Mesa's software renderer has four, and every context has at least four.
constexpr GLsizei kSamples = 4;

void require_complete(PictureSize size) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("OpenGL cannot draw a picture of " + std::to_string(size.width) + "x" +
                std::to_string(size.height) + " pixels");
}

}  // namespace

void Frame::resize(PictureSize size) {
  if (size == size_) return;
  glBindRenderbuffer(GL_RENDERBUFFER, sampled_color_.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_RGBA8, size.width, size.height);
  glBindRenderbuffer(GL_RENDERBUFFER, sampled_depth_.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_DEPTH_COMPONENT24, size.width, size.height);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, sampled_color_.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, sampled_depth_.name());
  require_complete(size);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  require_complete(size);
  size_ = size;
}

void Frame::bind_samples() const {
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.name());
  glViewport(0, 0, size_.width, size_.height);
}

void Frame::resolve() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
}

Image Frame::read_back() const {
  Image image(size_.width, size_.height);
  if (image.pixels.empty()) return image;
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  // OpenGL's first row is the lowest.
  const std::ptrdiff_t row = 4 * std::ptrdiff_t{size_.width};
  auto top = image.pixels.begin();
  auto bottom = image.pixels.end() - row;
  for (; top < bottom; top += row, bottom -= row) std::swap_ranges(top, top + row, bottom);
  return image;
}

PickFrame::PickFrame() {
  glBindRenderbuffer(GL_RENDERBUFFER, ids_.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RG32UI, 1, 1);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 1, 1);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, ids_.name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
  require_complete({1, 1});
}

void PickFrame::bind(PictureSize size, int x, int y) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(-x, y + 1 - size.height, size.width, size.height);
  const GLuint nothing[4] = {0, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 0, nothing);
  const GLfloat furthest = 1;
  glClearBufferfv(GL_DEPTH, 0, &furthest);
}

void PickFrame::read(GLuint (&ids)[2]) const {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(0, 0, 1, 1, GL_RG_INTEGER, GL_UNSIGNED_INT, ids);
}

FramebufferGuard::FramebufferGuard() {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  glGetIntegerv(GL_VIEWPORT, viewport_);
}

FramebufferGuard::~FramebufferGuard() {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

}  // namespace isorelax::render
