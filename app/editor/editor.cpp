#include "editor/editor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "editor/embedded.h"
#include "mesh/error.h"
#include "render/embedded.h"
#include "render/overlay.h"

namespace isorelax::editor {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kFlightSeconds = 0.3;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ui::FontFiles font_files() {
  const std::string_view regular = render::embedded_file("Inter-Regular.otf");
  const std::string_view semibold = embedded_file("Inter-SemiBold.otf");
  return {{regular.data(), regular.size()}, {semibold.data(), semibold.size()}};
}

render::Camera between(const render::Camera& a, const render::Camera& b, double t) {
  render::Camera camera = b;
  camera.target = a.target + t * (b.target - a.target);
  const double turn = std::remainder(b.azimuth_deg - a.azimuth_deg, 360.0);
  camera.azimuth_deg = a.azimuth_deg + t * turn;
  camera.elevation_deg = a.elevation_deg + t * (b.elevation_deg - a.elevation_deg);
  camera.extent = a.extent * std::pow(b.extent / a.extent, t);
  return camera;
}

}  // namespace

Editor::Editor(render::GlLoader loader, Motion motion)
    : interface_(font_files()), renderer_(loader), painter_(loader), motion_(motion) {}

void Editor::frame(const FrameOptions& options) {
  const auto start = Clock::now();
  double drawing = 0;
  const double elapsed = std::clamp(options.time - time_, 1e-3, 0.25);
  time_ = options.time;
  scale_ = options.scale;
  acted_ = false;
  model::execute(session_, model::Collect{});
  const ImVec2 display{static_cast<float>(options.size.width), static_cast<float>(options.size.height)};
  const ui::Layout layout = ui::make_layout(interface_.state(), display, scale_);
  viewport_ = {std::max(1, static_cast<int>(layout.viewport.width())),
               std::max(1, static_cast<int>(layout.viewport.height()))};
  follow_document();
  move_camera(options.time);
  const auto before_mesh = Clock::now();
  draw_mesh();
  drawing += seconds_since(before_mesh);

  ui::ViewportImage image;
  if (has_picture_) image.texture = texture_id(renderer_.color_texture());
  carry_out(interface_.frame(
      session_,
      {.display = display, .scale = scale_, .seconds = static_cast<float>(elapsed), .viewport = image}));
  const auto before_paint = Clock::now();
  painter_.paint(interface_, options.size);
  drawing += seconds_since(before_paint);
  times_ = {seconds_since(start) - drawing, drawing};
}

// Another file gets a camera of its own; the same file read again keeps the one there is.
void Editor::follow_document() {
  if (shown_document_ == session_.document || !session_.document) return;
  const bool same_file = shown_document_ && shown_document_->path == session_.document->path;
  shown_document_ = session_.document;
  if (same_file) return;
  camera_ = render::default_camera(session_.document->mesh().positions, viewport_, fit_options());
  flight_.reset();
}

// Keeps the mesh clear of the legend.
render::FitOptions Editor::fit_options() {
  return {.margin = 0.07, .right = render::legend_share(scene_.make(session_, scale_), viewport_)};
}

void Editor::move_camera(double time) {
  if (!flight_) return;
  const double t = std::clamp((time - flight_->start) / kFlightSeconds, 0.0, 1.0);
  camera_ = between(flight_->from, flight_->to, t * t * (3 - 2 * t));
  if (t >= 1) flight_.reset();
}

void Editor::fly_to(const render::Camera& to) {
  if (motion_ == Motion::instant)
    camera_ = to;
  else
    flight_ = Flight{camera_, to, time_};
}

void Editor::draw_mesh() {
  if (!session_.current) {
    has_picture_ = false;
    return;
  }
  const PictureKey key{session_.current->geometry.get(),
                       session_.current->energy.get(),
                       session_.view,
                       session_.color_range(),
                       camera_,
                       viewport_,
                       session_.selected_triangle,
                       scale_};
  if (has_picture_ && key == drawn_) return;
  try {
    renderer_.draw(scene_.make(session_, scale_), camera_, viewport_);
    has_picture_ = true;
  } catch (const Error& error) {
    model::execute(session_, model::Say{{model::MessageKind::error, error.what()}});
  }
  drawn_ = key;
}

void Editor::carry_out(const ui::Output& output) {
  for (const model::Command& command : output.commands) model::execute(session_, command);
  for (const ui::Request& request : output.requests) carry_out_request(request);
  acted_ = !output.commands.empty() || !output.requests.empty();
}

void Editor::carry_out_request(const ui::Request& request) {
  if (const auto* orbit = std::get_if<ui::OrbitView>(&request)) {
    flight_.reset();
    camera_ = render::orbit(camera_, orbit->dx, orbit->dy, viewport_);
  } else if (const auto* pan = std::get_if<ui::PanView>(&request)) {
    flight_.reset();
    camera_ = render::pan(camera_, pan->dx, pan->dy, viewport_);
  } else if (const auto* zoom = std::get_if<ui::ZoomView>(&request)) {
    flight_.reset();
    camera_ = render::zoom_to(camera_, zoom->factor, zoom->x, zoom->y, viewport_);
  } else if (std::holds_alternative<ui::FrameView>(request)) {
    if (session_.current)
      fly_to(render::fit(camera_, session_.current->positions(), viewport_, fit_options()));
  } else if (std::holds_alternative<ui::FlyToSelection>(request)) {
    if (session_.current && session_.selected_triangle)
      fly_to(look_at_triangle(camera_, session_, *session_.selected_triangle));
  } else if (const auto* picture = std::get_if<ui::SavePicture>(&request)) {
    save_picture(picture->path);
  } else {
    quit_ = true;
  }
}

void Editor::save_picture(const std::filesystem::path& path) {
  if (!session_.current) return;
  try {
    renderer_.draw(scene_.make(session_, scale_), camera_, viewport_);
    render::write_png(path, renderer_.read_back());
    model::execute(session_, model::Say{{model::MessageKind::info, "Saved " + path.string()}});
  } catch (const Error& error) {
    model::execute(session_, model::Say{{model::MessageKind::error, error.what()}});
  }
}

bool Editor::is_restless() const {
  return acted_ || flight_.has_value() || interface_.is_restless();
}

}  // namespace isorelax::editor
