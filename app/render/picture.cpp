#include "render/picture.h"

#include <charconv>
#include <cmath>

#include "mesh/error.h"
#include "render/overlay.h"
#include "render/renderer.h"

namespace isorelax::render {
namespace {

/// What OpenGL implementations, OSMesa among them, can still draw into.
constexpr int kLargestSide = 16384;

Scene make_scene(const TriangleMesh& mesh, const std::optional<FaceColors>& colors,
                 const PictureOptions& options) {
  Scene scene;
  SceneMesh& shown = scene.meshes.emplace_back();
  shown.positions = mesh.positions;
  shown.triangles = mesh.triangles;
  shown.shading = options.shading;
  shown.wire.shown = options.wire;
  scene.background = options.background;
  scene.caption = options.caption;
  if (!colors) return scene;
  shown.face_values = colors->values;
  shown.coloring = default_coloring(colors->quantity, colors->values);
  if (options.color_map) shown.coloring.map = *options.color_map;
  if (options.reversed) shown.coloring.direction = opposite(shown.coloring.direction);
  if (options.range) {
    shown.coloring.range = *options.range;
    if (options.range->low <= 0) shown.coloring.scale = ValueScale::linear;
  }
  if (options.legend) scene.legend = make_legend(colors->quantity, shown.coloring, colors->values);
  return scene;
}

template <class Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size();
}

}  // namespace

Image render_picture(const TriangleMesh& mesh, const std::optional<FaceColors>& colors,
                     const PictureOptions& options) {
  const Scene scene = make_scene(mesh, colors, options);
  FitOptions fitting;
  fitting.right = legend_share(scene, options.size);
  const Camera camera = parse_camera(options.camera, mesh.positions, options.size, fitting);
  const auto context = OffscreenContext::create(options.context);
  Renderer renderer(context->loader());
  renderer.draw(scene, camera, options.size);
  return renderer.read_back();
}

PictureSize parse_size(std::string_view text) {
  PictureSize size;
  const std::size_t by = text.find('x');
  if (by == std::string_view::npos || !parse_number(text.substr(0, by), size.width) ||
      !parse_number(text.substr(by + 1), size.height) || size.width < 1 || size.height < 1)
    throw UsageError("picture size '" + std::string(text) +
                     "' is not WIDTHxHEIGHT in pixels, such as 1280x720");
  if (size.width > kLargestSide || size.height > kLargestSide)
    throw UsageError("picture size '" + std::string(text) + "': no side may be longer than " +
                     std::to_string(kLargestSide) + " pixels");
  return size;
}

Range parse_range(std::string_view text) {
  Range range;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || !parse_number(text.substr(0, colon), range.low) ||
      !parse_number(text.substr(colon + 1), range.high) || !std::isfinite(range.low) ||
      !std::isfinite(range.high) || !(range.low < range.high))
    throw UsageError("range '" + std::string(text) + "' is not LO:HI with LO below HI, such as 0:60");
  return range;
}

}  // namespace isorelax::render
