#pragma once

#include "render/camera.h"
#include "render/image.h"
#include "render/scene.h"

namespace isorelax::view {

/// How several meshes share one picture: equal cells in rows, the legend in a strip at the right.
struct Panels {
  int columns = 1;
  int rows = 1;
  render::PictureSize cell;
  int strip = 0;  ///< width of the legend's strip; 0: no strip, a single mesh has its legend inside its cell
};

/// As many rows as make the shorter side of the cells longest. `legend_width`: pixels.
[[nodiscard]] Panels arrange(render::PictureSize size, std::size_t count, int legend_width);

/// Copies a picture into another at (left, top); what does not fit is left out.
void place(const render::Image& part, int left, int top, render::Image& whole);

/// Lays legend, caption and notes of a scene over a picture, as the renderer does.
void overlay(const render::Scene& scene, render::Image& picture);

}  // namespace isorelax::view
