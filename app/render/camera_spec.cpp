#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "io/text_in.h"
#include "mesh/error.h"
#include "render/camera.h"

namespace isorelax::render {
namespace {

constexpr std::string_view kViews[] = {"front", "back", "left", "right", "top", "bottom", "iso"};

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  if (!read_number(text, value) || !std::isfinite(value)) return {};
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

double parse_zoom(std::string_view text, std::string_view whole) {
  const auto factor = parse_number(text);
  if (!factor || *factor < 1e-6 || *factor > 1e6) fail(whole, "the zoom must be a number from 1e-6 to 1e6");
  return *factor;
}

/// Turns the camera as the part before the first colon says; a third number goes into `zoom`.
void parse_view(std::string_view view, std::string_view whole, Camera& camera, double& zoom) {
  if (view == "fit") return;
  for (std::size_t i = 0; i < std::size(kViews); ++i)
    if (view == kViews[i]) {
      camera = look_from(camera, static_cast<NamedView>(i));
      return;
    }
  std::optional<double> angles[2];
  std::string_view rest = view;
  for (auto& angle : angles) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    angle = parse_number(rest.substr(0, comma));
    rest.remove_prefix(comma == rest.size() || &angle == &angles[1] ? comma : comma + 1);
  }
  if (!angles[0] || !angles[1])
    fail(whole,
         quoted(view) +
             " is no view: give fit, front, back, left, right, top, bottom, iso or AZIMUTH,ELEVATION[,ZOOM]");
  if (std::abs(*angles[1]) > 90) fail(whole, "the elevation must lie between -90 and 90");
  if (!rest.empty()) zoom = parse_zoom(rest.substr(1), whole);
  camera.azimuth_deg = *angles[0];
  camera.elevation_deg = *angles[1];
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
    zoom = parse_zoom(option.substr(5), whole);
  } else {
    fail(whole, quoted(option) + " is no option: give perspective, orthographic, y-up, z-up or zoom=FACTOR");
  }
}

}  // namespace

Camera parse_camera(std::string_view text, std::span<const Vec3> positions, PictureSize size,
                    const FitOptions& options) {
  const std::size_t colon = text.find(':');
  Camera camera = default_camera(positions, size, options);
  double zoom = 1;
  parse_view(text.substr(0, colon), text, camera, zoom);
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
