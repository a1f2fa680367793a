#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
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

/// Colours that were multiplied by alpha, divided by it again: as PNG has them.
void unmultiply(Image& image);

/// A picture made smaller by a whole number: each pixel the mean of factor x factor, colours weighted by
/// alpha. Precondition: factor >= 1 divides both sides.
Image shrunk(const Image& image, int factor);

/// Texts that travel inside a picture, by keyword (1 to 79 characters of Latin-1; the texts are UTF-8).
using PictureTexts = std::map<std::string, std::string>;

/// The bytes of a PNG file: 8 bits per channel, without alpha where every pixel is opaque. The same image
/// and texts give the same bytes.
std::vector<std::uint8_t> encode_png(const Image& image, const PictureTexts& texts = {});

/// Throws UsageError unless a file is named .png: no other kind of picture is written.
void require_png_name(const std::filesystem::path& path);

/// Writes a PNG file whole or not at all. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image, const PictureTexts& texts = {});

/// The texts inside a PNG file (tEXt and uncompressed iTXt). Throws InputError when it cannot be read or is
/// no PNG file.
PictureTexts read_png_texts(const std::filesystem::path& path);

/// Pictures that follow one another.
struct Animation {
  std::vector<Image> frames;          ///< at least one, all of one size
  unsigned milliseconds = 100;        ///< that each is shown
  unsigned last_milliseconds = 1000;  ///< that the last one is shown
};

/// The bytes of an animated PNG that plays for ever; who knows no animation shows the first frame.
/// Precondition: all frames are opaque or none is.
std::vector<std::uint8_t> encode_animated_png(const Animation& animation, const PictureTexts& texts = {});

/// Reads a PNG file of any kind as RGBA. Throws InputError.
Image read_png(const std::filesystem::path& path);

}  // namespace isorelax::render
