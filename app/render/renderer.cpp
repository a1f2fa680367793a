#include "render/renderer.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "mesh/error.h"
#include "render/embedded.h"
#include "render/frame.h"
#include "render/mesh_buffers.h"
#include "render/overlay.h"
#include "render/picking.h"
#include "render/shader_program.h"

namespace isorelax::render {
namespace {

/// What the overlays were made from.
struct OverlayKey {
  std::optional<Legend> legend;
  std::vector<Swatch> key;
  std::string caption;
  double caption_lift = 0;
  double legend_top = 0;
  std::vector<std::string> notes;
  Background background;
  bool transparent = false;
  double pixels_per_point = 0;
  PictureSize size{0, 0};

  friend bool operator==(const OverlayKey&, const OverlayKey&) = default;
};

/// With four samples of colour and depth this takes two gigabytes.
constexpr std::int64_t kMostPixels = std::int64_t{8192} * 8192;

/// How strongly shading darkens: less where colours are to be read.
constexpr float kPlainRelief = 1;
constexpr float kColoredRelief = 0.6F;

bool has_lines(const SceneMesh& mesh) {
  return mesh.wire.shown || (mesh.marked_edges.shown && !mesh.edge_marks.empty()) ||
         !mesh.highlighted_faces.empty();
}

/// Whether the camera is on the side of a planar mesh to which most of its triangles show their backs.
bool is_seen_from_behind(const SceneMesh& mesh, const Camera& camera) {
  if (!mesh.plane_normal || mesh.positions.empty()) return false;
  Vec3 toward_eye = axes_of(camera).toward_eye;
  if (camera.projection == Projection::perspective)
    toward_eye = camera.target + eye_distance(camera) * toward_eye - mesh.positions.front();
  return mesh.plane_normal->dot(toward_eye) < 0;
}

struct OverlayTexture {
  GlTexture texture;
  PictureSize size;
  int left = 0;
  int top = 0;
};

/// Reads a shader's text by its file name.
using ShaderReader = ShaderSource (*)(const std::filesystem::path& folder, const std::string& name);

ShaderSource built_in_shader(const std::filesystem::path& /*folder*/, const std::string& name) {
  return {name, std::string(embedded_file(name))};
}

ShaderSource shader_from_file(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path = folder / name;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "", "cannot be read");
  return {path.string(), {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}};
}

/// The same shader with a macro defined.
ShaderSource defining(ShaderSource source, const std::string& macro) {
  // Behind the first line, which must be #version.
  source.text.insert(source.text.find('\n') + 1, "#define " + macro + "\n");
  return source;
}

struct Programs {
  ShaderProgram background;
  ShaderProgram faces;
  ShaderProgram faces_and_lines;
  ShaderProgram pick;
  ShaderProgram marker;
  ShaderProgram arrow;
  ShaderProgram overlay;

  Programs(ShaderReader read, const std::filesystem::path& folder)
      : background(read(folder, "background.vert"), read(folder, "background.frag")),
        faces(read(folder, "mesh.vert"), read(folder, "mesh.frag")),
        faces_and_lines(read(folder, "mesh.vert"), defining(read(folder, "mesh.frag"), "LINES")),
        pick(read(folder, "mesh.vert"), read(folder, "pick.frag")),
        marker(read(folder, "marker.vert"), read(folder, "marker.frag")),
        arrow(read(folder, "arrow.vert"), read(folder, "arrow.frag")),
        overlay(read(folder, "overlay.vert"), read(folder, "overlay.frag")) {}
};

/// What a host (Dear ImGui, say) may have left switched on and no picture wants.
void reset_state() {
  for (const GLenum off : {GL_BLEND, GL_SCISSOR_TEST, GL_CULL_FACE, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB,
                           GL_PRIMITIVE_RESTART, GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP})
    glDisable(off);
  glEnable(GL_MULTISAMPLE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glDepthRange(0, 1);
  glFrontFace(GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  // Texels are fetched by number: a sampler object left by the host must not get in between.
  for (GLuint unit = 0; unit < 4; ++unit) glBindSampler(unit, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace

struct Renderer::Impl {
  explicit Impl(GlLoader loader) : version_loaded((load_gl(loader), true)) {}

  void update_meshes(const Scene& scene);
  void update_overlays(const Scene& scene, PictureSize size);
  void draw_background(const Background& background) const;
  void draw_meshes(const Scene& scene, const Camera& camera, PictureSize size, double points) const;
  void draw_markers(const Scene& scene, const Camera& camera, PictureSize size, double points);
  void draw_arrows(const Arrows& wanted, const Camera& camera, PictureSize size, double points);
  void draw_overlays(PictureSize size) const;
  void require_size(PictureSize size) const;
  [[nodiscard]] Bounds scene_bounds() const;

  bool version_loaded;  // first: everything below calls OpenGL
  Programs programs{built_in_shader, {}};
  GlVertexArray no_attributes;
  Frame frame;
  PickFrame pick_frame;
  TextureBuffer markers{GL_RGBA32F};
  TextureBuffer arrows{GL_RGBA32F};
  std::vector<MeshBuffers> meshes;
  OverlayKey overlay_key;
  std::vector<OverlayTexture> overlays;
};

void Renderer::Impl::require_size(PictureSize size) const {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  const bool fits = size.width >= 1 && size.height >= 1 && size.width <= most && size.height <= most &&
                    std::int64_t{size.width} * size.height <= kMostPixels;
  if (!fits)
    throw UsageError("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     " pixels cannot be drawn: sides must be 1 to " + std::to_string(most) +
                     ", with no more pixels than 8192x8192");
}

Bounds Renderer::Impl::scene_bounds() const {
  Bounds all = meshes.empty() ? Bounds() : meshes[0].bounds();
  for (const MeshBuffers& mesh : meshes) {
    all.low = all.low.cwiseMin(mesh.bounds().low);
    all.high = all.high.cwiseMax(mesh.bounds().high);
  }
  return all;
}

void Renderer::Impl::update_meshes(const Scene& scene) {
  meshes.resize(std::min(meshes.size(), scene.meshes.size()));
  while (meshes.size() < scene.meshes.size()) meshes.emplace_back();
  for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i].update(scene.meshes[i]);
}

void Renderer::Impl::draw_background(const Background& background) const {
  glDisable(GL_DEPTH_TEST);
  programs.background.use();
  programs.background.set("top", background.top);
  programs.background.set("bottom", background.bottom);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::Impl::draw_meshes(const Scene& scene, const Camera& camera, PictureSize size,
                                 double points) const {
  const auto half_pixels = [&](double width) {
    return static_cast<float>(std::max(0.5, 0.5 * width * points));
  };
  const Bounds bounds = scene_bounds();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SceneMesh& mesh = scene.meshes[i];
    const ShaderProgram& program = has_lines(mesh) ? programs.faces_and_lines : programs.faces;
    const glm::vec4 wire(mesh.wire.color.red / 255.0F, mesh.wire.color.green / 255.0F,
                         mesh.wire.color.blue / 255.0F, static_cast<float>(mesh.wire.opacity));
    program.use();
    program.set("view_rotation", view_rotation(camera));
    program.set("view_projection", view_projection(camera, size, meshes[i].frame(), bounds));
    program.set("relief", mesh.face_values.empty() ? kPlainRelief : kColoredRelief);
    program.set("faces_shown", mesh.faces_shown ? 1 : 0);
    program.set("backs_marked", mesh.backs_marked ? 1 : 0);
    program.set("faces_inward", mesh.faces_inward != is_seen_from_behind(mesh, camera) ? 1 : 0);
    program.set("wire_shown", mesh.wire.shown ? 1 : 0);
    program.set("wire_color", wire);
    program.set("wire_half_width", half_pixels(mesh.wire.width));
    program.set("marks_shown", mesh.marked_edges.shown ? 1 : 0);
    program.set("marks_color", mesh.marked_edges.color);
    program.set("crease_color", mesh.crease_color);
    program.set("marks_half_width", half_pixels(mesh.marked_edges.width));
    program.set("highlight_color", mesh.highlight_color);
    meshes[i].draw(program, mesh);
  }
}

void Renderer::Impl::draw_markers(const Scene& scene, const Camera& camera, PictureSize size, double points) {
  if (scene.markers.empty()) return;
  Bounds bounds = scene_bounds();
  const MeshFrame frame_of_markers{camera.target, camera.extent};
  std::vector<float> texels;
  for (const Marker& marker : scene.markers) {
    const Vec3 local = (marker.position - frame_of_markers.origin) / frame_of_markers.scale;
    for (int k = 0; k < 3; ++k) texels.push_back(static_cast<float>(local[k]));
    texels.push_back(static_cast<float>(std::max(3.0, marker.diameter * points)));
    for (const std::uint8_t c : {marker.color.red, marker.color.green, marker.color.blue})
      texels.push_back(c / 255.0F);
    texels.push_back(1);
  }
  markers.upload(texels.data(), texels.size() * sizeof(float));
  const ShaderProgram& program = programs.marker;
  program.use();
  markers.bind(program, "markers", 0);
  program.set("view_projection", view_projection(camera, size, frame_of_markers, bounds));
  program.set("picture_size", glm::vec2(size.width, size.height));
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(scene.markers.size()));
  glDisable(GL_BLEND);
}

void Renderer::Impl::draw_arrows(const Arrows& wanted, const Camera& camera, PictureSize size,
                                 double points) {
  if (wanted.items.empty()) return;
  const MeshFrame frame_of_arrows{camera.target, camera.extent};
  std::vector<float> texels;
  texels.reserve(8 * wanted.items.size());
  for (const Arrow& arrow : wanted.items)
    for (const Vec3& end : {arrow.from, arrow.to}) {
      const Vec3 local = (end - frame_of_arrows.origin) / frame_of_arrows.scale;
      for (int k = 0; k < 3; ++k) texels.push_back(static_cast<float>(local[k]));
      texels.push_back(1);
    }
  arrows.upload(texels.data(), texels.size() * sizeof(float));
  const ShaderProgram& program = programs.arrow;
  program.use();
  arrows.bind(program, "arrows", 0);
  program.set("view_projection", view_projection(camera, size, frame_of_arrows, scene_bounds()));
  program.set("picture_size", glm::vec2(size.width, size.height));
  program.set("half_width", static_cast<float>(std::max(0.5, 0.5 * wanted.width * points)));
  program.set("color", wanted.color);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 9, static_cast<GLsizei>(wanted.items.size()));
}

void Renderer::Impl::update_overlays(const Scene& scene, PictureSize size) {
  const OverlayKey key{scene.legend,           scene.key,   scene.caption,    scene.caption_lift,
                       scene.legend_top,       scene.notes, scene.background, scene.transparent,
                       scene.pixels_per_point, size};
  if (key == overlay_key) return;
  overlays.clear();
  for (const Overlay& overlay : make_overlays(scene, size)) {
    OverlayTexture& made = overlays.emplace_back();
    made.size = {overlay.bitmap.width, overlay.bitmap.height};
    made.left = overlay.left;
    made.top = overlay.top;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, made.texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, made.size.width, made.size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 overlay.bitmap.pixels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  overlay_key = key;
}

void Renderer::Impl::draw_overlays(PictureSize size) const {
  const ShaderProgram& program = programs.overlay;
  program.use();
  program.set("bitmap", 0);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glActiveTexture(GL_TEXTURE0);
  for (const OverlayTexture& overlay : overlays) {
    const int bottom = size.height - overlay.top - overlay.size.height;
    const auto clip_x = [&](int x) {
      return 2.0F * static_cast<float>(x) / static_cast<float>(size.width) - 1.0F;
    };
    const auto clip_y = [&](int y) {
      return 2.0F * static_cast<float>(y) / static_cast<float>(size.height) - 1.0F;
    };
    glBindTexture(GL_TEXTURE_2D, overlay.texture.name());
    program.set("lower_left", glm::ivec2(overlay.left, bottom));
    program.set("rectangle",
                glm::vec4(clip_x(overlay.left), clip_y(bottom), clip_x(overlay.left + overlay.size.width),
                          clip_y(bottom + overlay.size.height)));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDisable(GL_BLEND);
}

Renderer::Renderer(GlLoader loader) : impl_(std::make_unique<Impl>(loader)) {}
Renderer::~Renderer() = default;

void Renderer::draw(const Scene& scene, const Camera& camera, PictureSize size) {
  impl_->require_size(size);
  const FramebufferGuard guard;
  reset_state();
  glBindVertexArray(impl_->no_attributes.name());
  const double points = pixels_per_point(scene, size);
  impl_->update_meshes(scene);
  impl_->update_overlays(scene, size);
  impl_->frame.resize(size);
  impl_->frame.bind_samples();
  const GLfloat furthest = 1;
  glClearBufferfv(GL_DEPTH, 0, &furthest);
  if (scene.transparent) {
    const GLfloat nothing[] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, nothing);
  } else {
    impl_->draw_background(scene.background);
  }
  glEnable(GL_DEPTH_TEST);
  impl_->draw_meshes(scene, camera, size, points);
  impl_->draw_arrows(scene.arrows, camera, size, points);
  impl_->draw_markers(scene, camera, size, points);
  impl_->frame.resolve();
  impl_->draw_overlays(size);
  glBindVertexArray(0);
}

unsigned Renderer::color_texture() const {
  return impl_->frame.texture();
}

Image Renderer::read_back() const {
  const FramebufferGuard guard;
  return impl_->frame.read_back();
}

std::optional<Pick> Renderer::pick(const Scene& scene, const Camera& camera, PictureSize size, int x, int y) {
  impl_->require_size(size);
  const FramebufferGuard guard;
  reset_state();
  glBindVertexArray(impl_->no_attributes.name());
  impl_->update_meshes(scene);
  impl_->pick_frame.bind(size, x, y);
  glEnable(GL_DEPTH_TEST);
  const ShaderProgram& program = impl_->programs.pick;
  program.use();
  program.set("view_rotation", view_rotation(camera));
  const Bounds bounds = impl_->scene_bounds();
  for (std::size_t i = 0; i < impl_->meshes.size(); ++i) {
    program.set("mesh", static_cast<unsigned>(i));
    program.set("view_projection", view_projection(camera, size, impl_->meshes[i].frame(), bounds));
    impl_->meshes[i].draw(program, scene.meshes[i]);
  }
  GLuint ids[2] = {0, 0};
  impl_->pick_frame.read(ids);
  glBindVertexArray(0);
  if (ids[0] == 0) return {};
  const SceneMesh& mesh = scene.meshes[ids[0] - 1];
  const Triangle& t = mesh.triangles[ids[1]];
  const Vec3& a = mesh.positions[t[0]];
  const Vec3& b = mesh.positions[t[1]];
  const Vec3& c = mesh.positions[t[2]];
  return Pick{ids[0] - 1, ids[1], t[nearest_corner(camera, size, x, y, a, b, c)],
              point_on_plane(ray_through(camera, size, x, y), a, b, c)};
}

int Renderer::max_size() const {
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  return most;
}

void Renderer::reload_shaders(const std::filesystem::path& folder) {
  impl_->programs = Programs(shader_from_file, folder);
}

}  // namespace isorelax::render
