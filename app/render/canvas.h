#pragma once

#include <string_view>

#include "render/color.h"
#include "render/font.h"
#include "render/image.h"

namespace isorelax::render {

enum class Align { left, center, right };

/// Draws flat shapes and text into an image whose colours are multiplied by alpha. Lengths in pixels from the
/// upper left corner; what lies outside is cut off.
class Canvas {
 public:
  Canvas(int width, int height) : image_(width, height) {}

  /// Covers [x0, x1) x [y0, y1), anti-aliased where the sides fall between pixels.
  void fill(double x0, double y0, double x1, double y1, Color color, double opacity = 1);

  /// Text whose baseline is at y and whose left end, middle or right end is at x.
  void text(Font& font, std::string_view utf8, double x, double y, Align align, Color color);

  [[nodiscard]] const Image& image() const { return image_; }

 private:
  void blend(int x, int y, Color color, double alpha);

  Image image_;
};

}  // namespace isorelax::render
