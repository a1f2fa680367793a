#include "render/image.h"

#include <algorithm>
#include <array>

namespace isorelax::render {

void unmultiply(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    const unsigned alpha = image.pixels[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t k = 0; k < 3; ++k)
      image.pixels[i + k] =
          static_cast<std::uint8_t>(std::min(255U, (255U * image.pixels[i + k] + alpha / 2) / alpha));
  }
}

Image shrunk(const Image& image, int factor) {
  if (factor == 1) return image;
  Image small(image.width / factor, image.height / factor);
  const auto count = static_cast<unsigned>(factor * factor);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      std::array<unsigned, 3> color{};
      unsigned alpha = 0;
      for (int dy = 0; dy < factor; ++dy)
        for (int dx = 0; dx < factor; ++dx) {
          const auto pixel = image.at(factor * x + dx, factor * y + dy);
          alpha += pixel[3];
          for (std::size_t k = 0; k < 3; ++k) color[k] += unsigned{pixel[k]} * pixel[3];
        }
      const auto out = small.at(x, y);
      for (std::size_t k = 0; k < 3; ++k)
        out[k] = alpha == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>((color[k] + alpha / 2) / alpha);
      out[3] = static_cast<std::uint8_t>((alpha + count / 2) / count);
    }
  return small;
}

}  // namespace isorelax::render
