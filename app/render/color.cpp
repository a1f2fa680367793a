#include "render/color.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "mesh/error.h"

namespace isorelax::render {
namespace {

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
}

std::optional<int> parse_channel(std::string_view text, int base) {
  int value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (status != std::errc() || end != text.data() + text.size() || value < 0 || value > 255) return {};
  return value;
}

std::optional<Color> parse_hex(std::string_view digits) {
  if (digits.size() != 3 && digits.size() != 6) return {};
  const std::size_t width = digits.size() / 3;
  std::uint8_t channels[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = parse_channel(digits.substr(k * width, width), 16);
    if (!value) return {};
    channels[k] = static_cast<std::uint8_t>(width == 1 ? 17 * *value : *value);
  }
  return Color{channels[0], channels[1], channels[2]};
}

std::optional<Color> parse_decimal(std::string_view text) {
  std::uint8_t channels[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return {};
    const auto value = parse_channel(text.substr(0, comma), 10);
    if (!value) return {};
    channels[k] = static_cast<std::uint8_t>(*value);
    text.remove_prefix(k == 2 ? text.size() : comma + 1);
  }
  return Color{channels[0], channels[1], channels[2]};
}

}  // namespace

double luminance(Color color) {
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

Color mix(Color a, Color b, double t) {
  return {mix(a.red, b.red, t), mix(a.green, b.green, t), mix(a.blue, b.blue, t)};
}

Background parse_background(std::string_view text) {
  if (text == "dark") return kDarkBackground;
  if (text == "light") return kLightBackground;
  if (text == "white") return kWhiteBackground;
  if (text == "black") return {};
  const auto color = text.starts_with('#') ? parse_hex(text.substr(1)) : parse_decimal(text);
  if (!color)
    throw UsageError("background '" + std::string(text) +
                     "' is not a colour: give dark, light, white, black, #rrggbb or r,g,b");
  return {*color, *color};
}

}  // namespace isorelax::render
