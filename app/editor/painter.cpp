#include "editor/painter.h"

#include <glad/gl.h>
#include <imgui.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "editor/embedded.h"
#include "mesh/error.h"

namespace isorelax::editor {
namespace {

GLuint compile(GLenum kind, std::string_view source, const char* name) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok != 0) return shader;
  char log[512] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw Error(std::string(name) + ": " + log);
}

const void* offset(std::size_t bytes) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the interface of OpenGL
  return reinterpret_cast<const void*>(bytes);
}

// Textures travel through Dear ImGui as pointers.
GLuint texture_of(ImTextureID id) {
  return static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(id));
}

}  // namespace

Painter::Painter(render::GlLoader loader) {
  render::load_gl(loader);
  make_program();
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  constexpr GLsizei kStride = sizeof(ImDrawVert);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glEnableVertexAttribArray(2);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(ImDrawVert, pos)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(ImDrawVert, uv)));
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(offsetof(ImDrawVert, col)));
  glBindVertexArray(0);
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &color_);
  glGenTextures(1, &atlas_);
}

Painter::~Painter() {
  glDeleteProgram(program_);
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &color_);
  glDeleteTextures(1, &atlas_);
}

void Painter::make_program() {
  const GLuint vertex = compile(GL_VERTEX_SHADER, embedded_file("ui.vert"), "ui.vert");
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, embedded_file("ui.frag"), "ui.frag");
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint ok = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &ok);
  if (ok == 0) throw Error("ui.vert, ui.frag: the shaders do not link");
  glUseProgram(program_);
  glUniform1i(glGetUniformLocation(program_, "picture"), 0);
  display_location_ = glGetUniformLocation(program_, "display");
  glUseProgram(0);
}

void Painter::resize(render::PictureSize size) {
  if (size == size_) return;
  size_ = size;
  glBindTexture(GL_TEXTURE_2D, color_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error("OpenGL refuses a framebuffer of " + std::to_string(size.width) + "x" +
                std::to_string(size.height));
}

void Painter::upload_atlas(ui::Interface& interface) {
  const auto atlas = interface.atlas();
  interface.set_atlas_texture(texture_id(atlas_));
  if (atlas.revision == atlas_revision_) return;
  atlas_revision_ = atlas.revision;
  glBindTexture(GL_TEXTURE_2D, atlas_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE, atlas.pixels);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  // Coverage becomes the opacity of white, so that one shader serves text and pictures.
  const GLint swizzle[4] = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
  glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void Painter::paint(ui::Interface& interface, render::PictureSize size) {
  paint(interface, interface.draw_data(), size);
}

void Painter::paint(ui::Interface& interface, const ImDrawData& data, render::PictureSize size) {
  upload_atlas(interface);
  resize(size);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size.width, size.height);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(20 / 255.0F, 22 / 255.0F, 26 / 255.0F, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  glUseProgram(program_);
  glUniform2f(display_location_, static_cast<float>(size.width), static_cast<float>(size.height));
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  draw(data);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  // Where no window takes the picture, nothing else has the driver do what is in its queue: it would keep the
  // triangles of thousands of frames.
  glFlush();
}

void Painter::draw(const ImDrawData& data) const {
  constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.VtxBuffer.size_in_bytes()),
                 list.VtxBuffer.Data, GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.IdxBuffer.size_in_bytes()),
                 list.IdxBuffer.Data, GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      if (command.UserCallback != nullptr || clip.z <= clip.x || clip.w <= clip.y) continue;
      glScissor(static_cast<GLint>(clip.x), size_.height - static_cast<GLint>(clip.w),
                static_cast<GLsizei>(clip.z - clip.x), static_cast<GLsizei>(clip.w - clip.y));
      glBindTexture(GL_TEXTURE_2D, texture_of(command.GetTexID()));
      glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                               offset(command.IdxOffset * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
    }
  }
}

void Painter::show(render::PictureSize window) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, window.width, window.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

render::Image Painter::read_back() const {
  render::Image flipped(size_.width, size_.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, flipped.pixels.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  render::Image image(size_.width, size_.height);
  const std::size_t row = 4 * static_cast<std::size_t>(size_.width);
  for (int y = 0; y < size_.height; ++y)
    std::memcpy(&image.pixels[static_cast<std::size_t>(y) * row],
                &flipped.pixels[static_cast<std::size_t>(size_.height - 1 - y) * row], row);
  // The picture is opaque, whatever blending left in its alpha.
  for (std::size_t k = 3; k < image.pixels.size(); k += 4) image.pixels[k] = 255;
  return image;
}

}  // namespace isorelax::editor
