#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace isorelax::render {

/// A picture in memory: 4 bytes per pixel (red, green, blue, alpha), sRGB, top row first.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  Image() = default;
  Image(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        pixels(4 * static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height)) {}

  [[nodiscard]] std::span<const std::uint8_t, 4> at(int x, int y) const {
    return std::span<const std::uint8_t, 4>(pixels.data() + offset(x, y), 4);
  }
  [[nodiscard]] std::span<std::uint8_t, 4> at(int x, int y) {
    return std::span<std::uint8_t, 4>(pixels.data() + offset(x, y), 4);
  }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// The bytes of a PNG file: 8 bits per channel, without alpha where every pixel is opaque. The same image
/// gives the same bytes.
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes a PNG file whole or not at all. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads a PNG file of any kind as RGBA. Throws InputError.
Image read_png(const std::filesystem::path& path);

}  // namespace isorelax::render
