#include "render/canvas.h"

#include <algorithm>
#include <cmath>

namespace isorelax::render {
namespace {

/// Part of pixel [p, p+1) that lies in [from, to).
double overlap(int p, double from, double to) {
  return std::clamp(std::min(to, p + 1.0) - std::max(from, static_cast<double>(p)), 0.0, 1.0);
}

}  // namespace

void Canvas::blend(int x, int y, Color color, double alpha) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || alpha <= 0) return;
  const auto pixel = image_.at(x, y);
  const double source[] = {color.red * alpha, color.green * alpha, color.blue * alpha, 255 * alpha};
  for (std::size_t k = 0; k < 4; ++k)
    pixel[k] = static_cast<std::uint8_t>(std::lround(std::min(255.0, source[k] + (1 - alpha) * pixel[k])));
}

void Canvas::fill(double x0, double y0, double x1, double y1, Color color, double opacity) {
  for (int y = std::max(0, static_cast<int>(std::floor(y0))); y < std::min<double>(image_.height, y1); ++y)
    for (int x = std::max(0, static_cast<int>(std::floor(x0))); x < std::min<double>(image_.width, x1); ++x)
      blend(x, y, color, opacity * overlap(x, x0, x1) * overlap(y, y0, y1));
}

void Canvas::text(Font& font, std::string_view utf8, double x, double y, Align align, Color color) {
  if (align != Align::left) x -= font.width(utf8) * (align == Align::center ? 0.5 : 1.0);
  const int baseline = static_cast<int>(std::lround(y));
  for (const char32_t character : decode_utf8(utf8)) {
    const Glyph& glyph = font.glyph(character);
    const int left = static_cast<int>(std::lround(x)) + glyph.left;
    for (int row = 0; row < glyph.height; ++row)
      for (int column = 0; column < glyph.width; ++column)
        blend(left + column, baseline - glyph.top + row, color,
              glyph.coverage[static_cast<std::size_t>(row) * glyph.width + column] / 255.0);
    x += glyph.advance;
  }
}

}  // namespace isorelax::render
