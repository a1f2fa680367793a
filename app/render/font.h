#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isorelax::render {

/// Coverage of one glyph, one byte per pixel, first row at the top.
struct Glyph {
  int left = 0;  ///< of the bitmap from the pen, pixels
  int top = 0;   ///< of the bitmap above the baseline, pixels
  int width = 0;
  int height = 0;
  std::vector<unsigned char> coverage;
  double advance = 0;  ///< pixels to the next pen position; the same for all digits
};

/// The built-in typeface at one size. Rasterised without hinting: the same outlines at every size.
class Font {
 public:
  /// `pixels`: height of the em square. Throws Error when the built-in font cannot be read.
  explicit Font(double pixels);
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font();

  /// Glyph of a Unicode character; the font's own "missing" box where it has none.
  [[nodiscard]] const Glyph& glyph(char32_t character);

  /// Width of a UTF-8 text in pixels.
  [[nodiscard]] double width(std::string_view text);
  /// The text, or as much of it as fits into a width with an ellipsis behind.
  [[nodiscard]] std::string fitted(std::string_view text, double room);
  /// Height of the capital H in pixels.
  [[nodiscard]] double cap_height() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Code points of a UTF-8 text; U+FFFD for every byte that belongs to none.
std::u32string decode_utf8(std::string_view text);

}  // namespace isorelax::render
