#include "view/panels.h"

#include <algorithm>

#include "render/overlay.h"

namespace isorelax::view {
namespace {

/// `source` is multiplied by alpha, `target` is not.
void blend(std::span<const std::uint8_t, 4> source, std::span<std::uint8_t, 4> target) {
  const unsigned over = source[3];
  if (over == 0) return;
  const unsigned below = (target[3] * (255U - over) + 127) / 255;
  const unsigned alpha = over + below;
  for (std::size_t k = 0; k < 3; ++k) {
    const unsigned sum = 255U * source[k] + unsigned{target[k]} * below;
    target[k] = static_cast<std::uint8_t>(std::min(255U, (sum + alpha / 2) / alpha));
  }
  target[3] = static_cast<std::uint8_t>(alpha);
}

}  // namespace

Panels arrange(render::PictureSize size, std::size_t count, int legend_width) {
  if (count <= 1) return {1, 1, size, 0};
  const int cells = static_cast<int>(count);
  const int strip = std::min(legend_width, size.width / 2);
  Panels best;
  for (int rows = 1; rows <= cells; ++rows) {
    const int columns = (cells + rows - 1) / rows;
    const render::PictureSize cell{std::max(1, (size.width - strip) / columns),
                                   std::max(1, size.height / rows)};
    const bool first = rows == 1;
    if (first || std::min(cell.width, cell.height) > std::min(best.cell.width, best.cell.height))
      best = {columns, rows, cell, strip};
  }
  // What division leaves goes to the legend.
  best.strip = size.width - best.columns * best.cell.width;
  return best;
}

void place(const render::Image& part, int left, int top, render::Image& whole) {
  for (int y = 0; y < part.height && top + y < whole.height; ++y)
    for (int x = 0; x < part.width && left + x < whole.width; ++x)
      std::ranges::copy(part.at(x, y), whole.at(left + x, top + y).begin());
}

void overlay(const render::Scene& scene, render::Image& picture) {
  for (const render::Overlay& made : render::make_overlays(scene, {picture.width, picture.height}))
    for (int y = 0; y < made.bitmap.height; ++y)
      for (int x = 0; x < made.bitmap.width; ++x) {
        const int to_x = made.left + x;
        const int to_y = made.top + y;
        if (to_x >= 0 && to_y >= 0 && to_x < picture.width && to_y < picture.height)
          blend(made.bitmap.at(x, y), picture.at(to_x, to_y));
      }
}

}  // namespace isorelax::view
