#pragma once

#include <cstdint>
#include <string_view>

namespace isorelax::render {

/// An opaque sRGB colour, 0..255 per channel, as it stands in a PNG.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// Relative luminance after WCAG 2.1, 0 (black) to 1 (white).
double luminance(Color color);

/// a + t (b - a) per channel, t in [0, 1].
Color mix(Color a, Color b, double t);

/// What stands behind the mesh: one colour, or a soft vertical gradient.
struct Background {
  Color top;
  Color bottom;

  friend bool operator==(const Background&, const Background&) = default;
};

/// Calm charcoal, the editor's default.
inline constexpr Background kDarkBackground{{46, 50, 57}, {27, 29, 34}};
/// For the screen in daylight.
inline constexpr Background kLightBackground{{246, 247, 249}, {222, 225, 230}};
/// For papers.
inline constexpr Background kWhiteBackground{{255, 255, 255}, {255, 255, 255}};

/// "dark", "light", "white", "black", "#rgb", "#rrggbb" or "r,g,b" (0..255).
/// Throws UsageError naming the text and what is accepted.
Background parse_background(std::string_view text);

}  // namespace isorelax::render
