#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "mesh/error.h"
#include "render/camera.h"

namespace isorelax::render {
namespace {

constexpr std::string_view kViews[] = {"front", "back", "left", "right", "top", "bottom", "iso"};

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

[[noreturn]] void fail(std::string_view whole, const std::string& reason) {
  throw UsageError("camera '" + std::string(whole) + "': " + reason);
}

std::string quoted(std::string_view text) {
  std::string result(1, '\'');
  result.append(text).append(1, '\'');
  return result;
}

/// Turns `camera` as the part before the first colon says.
Camera parse_view(const Camera& camera, std::string_view view, std::string_view whole) {
  if (view == "fit") return camera;
  for (std::size_t i = 0; i < std::size(kViews); ++i)
    if (view == kViews[i]) return look_from(camera, static_cast<NamedView>(i));
  const std::size_t comma = view.find(',');
  const auto azimuth = parse_number(view.substr(0, comma));
  const auto elevation =
      comma == std::string_view::npos ? std::optional<double>() : parse_number(view.substr(comma + 1));
  if (!azimuth || !elevation)
    fail(whole, quoted(view) +
                    " is no view: give fit, front, back, left, right, top, bottom, iso or AZIMUTH,ELEVATION");
  if (std::abs(*elevation) > 90) fail(whole, "the elevation must lie between -90 and 90");
  Camera turned = camera;
  turned.azimuth_deg = *azimuth;
  turned.elevation_deg = *elevation;
  return turned;
}

/// Reads one option into the camera; a zoom into `zoom`.
void parse_option(std::string_view option, std::string_view whole, Camera& camera, double& zoom) {
  if (option == "perspective") {
    camera.projection = Projection::perspective;
  } else if (option == "orthographic") {
    camera.projection = Projection::orthographic;
  } else if (option == "y-up") {
    camera.up = UpAxis::y;
  } else if (option == "z-up") {
    camera.up = UpAxis::z;
  } else if (option.starts_with("zoom=")) {
    const auto factor = parse_number(option.substr(5));
    if (!factor || *factor < 1e-6 || *factor > 1e6) fail(whole, "the zoom must be a number from 1e-6 to 1e6");
    zoom = *factor;
  } else {
    fail(whole, quoted(option) + " is no option: give perspective, orthographic, y-up, z-up or zoom=FACTOR");
  }
}

}  // namespace

Camera parse_camera(std::string_view text, std::span<const Vec3> positions, PictureSize size,
                    const FitOptions& options) {
  const std::size_t colon = text.find(':');
  Camera camera = parse_view(default_camera(positions, size, options), text.substr(0, colon), text);
  double zoom = 1;
  std::string_view rest = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  while (colon != std::string_view::npos) {
    const std::size_t end = rest.find(':');
    parse_option(rest.substr(0, end), text, camera, zoom);
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  camera = fit(camera, positions, size, options);
  camera.extent /= zoom;
  return camera;
}

}  // namespace isorelax::render
