#pragma once

#include <vector>

#include "render/camera.h"
#include "render/gl_object.h"
#include "render/scene.h"
#include "render/shader_program.h"

namespace isorelax::render {

/// A buffer that shaders read element by element.
class TextureBuffer {
 public:
  /// `format`: GL_RGBA32F, GL_RGBA32UI, GL_RGBA8.
  explicit TextureBuffer(GLenum format);

  void upload(const void* data, std::size_t bytes);
  void bind(const ShaderProgram& program, const char* sampler, int unit) const;

 private:
  GlBuffer buffer_;
  GlTexture texture_;
};

/// One mesh of a scene on the graphics side; takes over only what changed.
class MeshBuffers {
 public:
  MeshBuffers();

  /// Throws MeshError when the mesh does not fit or spans disagree in length.
  void update(const SceneMesh& mesh);
  /// Binds the buffers and sets the uniforms that depend on the mesh; draws its triangles.
  void draw(const ShaderProgram& program, const SceneMesh& mesh) const;

  [[nodiscard]] const MeshFrame& frame() const { return frame_; }
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

 private:
  void upload_positions(const SceneMesh& mesh);
  void upload_normals(const SceneMesh& mesh);
  void upload_triangles(const SceneMesh& mesh);
  void upload_colors(const SceneMesh& mesh);

  /// What the colours were made from.
  struct ColorKey {
    Revision values = kUnknownRevision;
    bool has_values = false;
    std::size_t count = 0;
    Coloring coloring;
    Color plain;
    Color highlight;
    std::vector<Index> highlighted;

    friend bool operator==(const ColorKey&, const ColorKey&) = default;
  };

  TextureBuffer positions_;
  TextureBuffer triangles_;
  TextureBuffer normals_;
  TextureBuffer colors_;
  MeshFrame frame_;
  Bounds bounds_;
  Revision positions_revision_ = kUnknownRevision;
  Revision triangles_revision_ = kUnknownRevision;
  bool has_normals_ = false;
  ColorKey color_key_;
  std::vector<float> floats_;
  std::vector<std::uint32_t> words_;
};

}  // namespace isorelax::render
