#pragma once

#include <optional>
#include <span>
#include <string>

#include "mesh/triangle_mesh.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/offscreen.h"
#include "render/quantity.h"
#include "render/scene.h"

namespace isorelax::render {

/// What faces are coloured by: one number per triangle.
struct FaceColors {
  Quantity quantity = Quantity::min_angle;
  std::span<const double> values;
};

struct PictureOptions {
  PictureSize size;
  std::optional<ColorMap> color_map;  ///< empty: the quantity's own
  bool reversed = false;              ///< the map runs the other way than the quantity's own
  std::optional<Range> range;         ///< empty: the quantity's own
  std::string camera = "fit";         ///< see parse_camera
  Shading shading = Shading::flat;
  bool wire = false;
  bool legend = true;
  Background background = kDarkBackground;
  std::string caption;
  ContextKind context = ContextKind::osmesa;
};

/// One picture of one mesh, without a display. `colors` empty: a plain mesh without a legend.
/// Throws UsageError (camera, size, range), MeshError (too large), Error (no OpenGL).
Image render_picture(const TriangleMesh& mesh, const std::optional<FaceColors>& colors,
                     const PictureOptions& options = {});

/// "1280x720". Throws UsageError.
PictureSize parse_size(std::string_view text);
/// "LO:HI" with LO < HI. Throws UsageError.
Range parse_range(std::string_view text);

}  // namespace isorelax::render
