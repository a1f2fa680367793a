#include "render/mesh_buffers.h"

#include <algorithm>
#include <string>

#include "mesh/error.h"

namespace isorelax::render {
namespace {

/// Units of the four samplers of mesh.vert.
enum Unit : int { kPositionsUnit, kTrianglesUnit, kNormalsUnit, kColorsUnit };

bool is_current(Revision known, Revision wanted) {
  return wanted != kUnknownRevision && known == wanted;
}

void require_fits(const SceneMesh& mesh) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  const std::size_t largest = std::max(mesh.positions.size(), mesh.triangles.size());
  if (largest > static_cast<std::size_t>(most))
    throw MeshError("the mesh has " + std::to_string(largest) +
                    " vertices or triangles, this OpenGL draws at most " + std::to_string(most));
  if (!mesh.face_values.empty() && mesh.face_values.size() != mesh.triangles.size())
    throw MeshError("there are " + std::to_string(mesh.face_values.size()) + " values for " +
                    std::to_string(mesh.triangles.size()) + " triangles");
  if (!mesh.edge_marks.empty() && mesh.edge_marks.size() != mesh.triangles.size())
    throw MeshError("there are " + std::to_string(mesh.edge_marks.size()) + " edge marks for " +
                    std::to_string(mesh.triangles.size()) + " triangles");
}

std::uint32_t packed(Color color, std::uint32_t alpha) {
  // Bytes in memory: red, green, blue, alpha, on a little-endian machine.
  return color.red | (std::uint32_t{color.green} << 8U) | (std::uint32_t{color.blue} << 16U) | (alpha << 24U);
}

}  // namespace

TextureBuffer::TextureBuffer(GLenum format) {
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
  glBufferData(GL_TEXTURE_BUFFER, 16, nullptr, GL_DYNAMIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer_.name());
}

void TextureBuffer::upload(const void* data, std::size_t bytes) {
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_DRAW);
}

void TextureBuffer::bind(const ShaderProgram& program, const char* sampler, int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_BUFFER, texture_.name());
  program.set(sampler, unit);
}

MeshBuffers::MeshBuffers()
    : positions_(GL_RGBA32F), triangles_(GL_RGBA32UI), normals_(GL_RGBA32F), colors_(GL_RGBA8) {}

void MeshBuffers::update(const SceneMesh& mesh) {
  require_fits(mesh);
  const bool same_triangles = is_current(triangles_revision_, mesh.triangles_revision);
  const bool same_positions = is_current(positions_revision_, mesh.positions_revision);
  if (!same_triangles) upload_triangles(mesh);
  if (!same_positions) upload_positions(mesh);
  if (!same_triangles || !same_positions) has_normals_ = false;
  if (mesh.shading == Shading::smooth && !has_normals_) upload_normals(mesh);
  upload_colors(mesh);
}

void MeshBuffers::upload_positions(const SceneMesh& mesh) {
  bounds_ = bounds_of(mesh.positions);
  frame_.origin = bounds_.center();
  frame_.scale = bounds_.diagonal() > 0 ? bounds_.diagonal() : 1;
  const double inverse = 1 / frame_.scale;
  floats_.resize(4 * mesh.positions.size());
  float* out = floats_.data();
  for (const Vec3& p : mesh.positions) {
    for (int k = 0; k < 3; ++k) *out++ = static_cast<float>((p[k] - frame_.origin[k]) * inverse);
    *out++ = 1;
  }
  positions_.upload(floats_.data(), floats_.size() * sizeof(float));
  positions_revision_ = mesh.positions_revision;
}

void MeshBuffers::upload_normals(const SceneMesh& mesh) {
  // Sums of area vectors: large triangles count more, degenerate ones not at all.
  std::vector<Vec3> sums(mesh.positions.size(), Vec3::Zero());
  const double inverse = 1 / frame_.scale;
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3 area = ((mesh.positions[t[1]] - a) * inverse).cross((mesh.positions[t[2]] - a) * inverse);
    for (const Index v : t) sums[v] += area;
  }
  floats_.resize(4 * sums.size());
  float* out = floats_.data();
  for (const Vec3& sum : sums) {
    const Vec3 normal = sum.stableNormalized();
    for (int k = 0; k < 3; ++k) *out++ = static_cast<float>(normal[k]);
    *out++ = 0;
  }
  normals_.upload(floats_.data(), floats_.size() * sizeof(float));
  has_normals_ = true;
}

void MeshBuffers::upload_triangles(const SceneMesh& mesh) {
  words_.resize(4 * mesh.triangles.size());
  std::uint32_t* out = words_.data();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) *out++ = v;
    *out++ = mesh.edge_marks.empty() ? 0U : mesh.edge_marks[t];
  }
  triangles_.upload(words_.data(), words_.size() * sizeof(std::uint32_t));
  triangles_revision_ = mesh.triangles_revision;
}

void MeshBuffers::upload_colors(const SceneMesh& mesh) {
  const ColorKey key{mesh.values_revision, !mesh.face_values.empty(), mesh.triangles.size(), mesh.coloring,
                     mesh.plain_color,     mesh.highlight_color,      mesh.highlighted_faces};
  const bool plain_or_known = mesh.face_values.empty() || mesh.values_revision != kUnknownRevision;
  if (plain_or_known && key == color_key_) return;
  words_.assign(mesh.triangles.size(), packed(mesh.plain_color, 255));
  for (std::size_t t = 0; t < mesh.face_values.size(); ++t)
    words_[t] = packed(color_of(mesh.coloring, mesh.face_values[t]), 255);
  for (const Index t : mesh.highlighted_faces) {
    if (t >= words_.size()) continue;
    const Color own =
        mesh.face_values.empty() ? mesh.plain_color : color_of(mesh.coloring, mesh.face_values[t]);
    words_[t] = packed(mix(own, mesh.highlight_color, 0.35), 0);
  }
  colors_.upload(words_.data(), words_.size() * sizeof(std::uint32_t));
  color_key_ = key;
}

void MeshBuffers::draw(const ShaderProgram& program, const SceneMesh& mesh) const {
  const bool is_smooth = mesh.shading == Shading::smooth;
  positions_.bind(program, "positions", kPositionsUnit);
  triangles_.bind(program, "triangles", kTrianglesUnit);
  normals_.bind(program, "normals", kNormalsUnit);
  colors_.bind(program, "colors", kColorsUnit);
  program.set("smooth_shading", is_smooth ? 1 : 0);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * mesh.triangles.size()));
}

}  // namespace isorelax::render
