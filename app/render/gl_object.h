#pragma once

#include <glad/gl.h>

#include <utility>

namespace isorelax::render {

/// Owns one OpenGL object by its name. `Kind` says how it is made and deleted.
template <class Kind>
class GlObject {
 public:
  GlObject() { Kind::create(&name_); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (name_ != 0) Kind::destroy(&name_);
  }

  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct BufferKind {
  static void create(GLuint* name) { glGenBuffers(1, name); }
  static void destroy(const GLuint* name) { glDeleteBuffers(1, name); }
};
struct TextureKind {
  static void create(GLuint* name) { glGenTextures(1, name); }
  static void destroy(const GLuint* name) { glDeleteTextures(1, name); }
};
struct FramebufferKind {
  static void create(GLuint* name) { glGenFramebuffers(1, name); }
  static void destroy(const GLuint* name) { glDeleteFramebuffers(1, name); }
};
struct RenderbufferKind {
  static void create(GLuint* name) { glGenRenderbuffers(1, name); }
  static void destroy(const GLuint* name) { glDeleteRenderbuffers(1, name); }
};
struct VertexArrayKind {
  static void create(GLuint* name) { glGenVertexArrays(1, name); }
  static void destroy(const GLuint* name) { glDeleteVertexArrays(1, name); }
};

using GlBuffer = GlObject<BufferKind>;
using GlTexture = GlObject<TextureKind>;
using GlFramebuffer = GlObject<FramebufferKind>;
using GlRenderbuffer = GlObject<RenderbufferKind>;
using GlVertexArray = GlObject<VertexArrayKind>;

}  // namespace isorelax::render
