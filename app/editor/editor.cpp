#include "editor/editor.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "editor/embedded.h"
#include "editor/session_view.h"
#include "editor/step_overlay.h"
#include "mesh/error.h"
#include "render/embedded.h"
#include "render/overlay.h"

namespace isorelax::editor {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double mean_area(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  double area = 0;
  for (const Triangle& t : triangles) area += 0.5 * area_vector(x[t[0]], x[t[1]], x[t[2]]).norm();
  return area / static_cast<double>(std::max<std::size_t>(1, triangles.size()));
}

ui::FontFiles font_files() {
  const std::string_view regular = render::embedded_file("Inter-Regular.otf");
  const std::string_view semibold = embedded_file("Inter-SemiBold.otf");
  return {{regular.data(), regular.size()}, {semibold.data(), semibold.size()}};
}

}  // namespace

Editor::Editor(render::GlLoader loader, Motion motion, PlanReader read_plan)
    : interface_(font_files()),
      current_(loader),
      before_(loader),
      loader_(loader),
      painter_(loader),
      motion_(motion) {
  session_.engine.set_plan_reader(std::move(read_plan));
}

void Editor::frame(const FrameOptions& options) {
  const auto start = Clock::now();
  double drawing = 0;
  const double elapsed = std::clamp(options.time - time_, 1e-3, 0.25);
  time_ = options.time;
  display_ = options.size;
  scale_ = options.scale;
  acted_ = false;
  model::execute(session_, model::Collect{});
  log_.follow(session_);
  const ImVec2 display{static_cast<float>(options.size.width), static_cast<float>(options.size.height)};
  interface_.state().has_mesh =
      session_.current != nullptr;  // the timeline takes its room from the first frame on
  const ui::Layout layout = ui::make_layout(interface_.state(), display, scale_);
  viewport_ = {std::max(1, static_cast<int>(layout.viewport.width())),
               std::max(1, static_cast<int>(layout.viewport.height()))};
  if (session_.current) partner_.follow(session_, interface_.state().comparison);
  follow_document();
  move_camera(options.time);
  follow_motion();
  follow_panes();
  tell_camera();
  const auto before_mesh = Clock::now();
  draw_pictures();
  drawing += seconds_since(before_mesh);

  carry_out(interface_.frame(session_, {.display = display,
                                        .scale = scale_,
                                        .seconds = static_cast<float>(elapsed),
                                        .viewport = viewport_image()}));
  const auto before_paint = Clock::now();
  painter_.paint(interface_, options.size);
  drawing += seconds_since(before_paint);
  times_ = {seconds_since(start) - drawing, drawing};
}

// What the interface says and draws of how the viewport looks at the mesh.
void Editor::tell_camera() {
  ui::Looking& looking = interface_.state().looking;
  const render::CameraAxes axes = render::axes_of(camera_);
  looking.up = axes.up;
  looking.toward_eye = axes.toward_eye;
  if (!session_.current) return;
  if (measured_ != session_.current->geometry) {
    measured_ = session_.current->geometry;
    triangle_side_ = std::sqrt(mean_area(session_.current->positions(), session_.document->mesh().triangles));
  }
  looking.triangle_pixels = triangle_side_ * std::min(pane().width, pane().height) / camera_.extent;
}

ui::ViewportImage Editor::viewport_image() const {
  ui::ViewportImage image;
  if (current_.drawn) image.texture = texture_id(current_.renderer.color_texture());
  if (before_.drawn) image.before = texture_id(before_.renderer.color_texture());
  for (const auto& other : others_) image.others.push_back(texture_id(other->renderer.color_texture()));
  if (legend_) image.legend = texture_id(legend_->renderer.color_texture());
  return image;
}

view::View Editor::present_view() const {
  const ui::Comparison& comparison = interface_.state().comparison;
  view::View view = view_of(session_, base_, camera_, pane(), scale_);
  // One for all of them stands beside them.
  if (panes() > 1) view.legend = false;
  if (comparison.mode != ui::CompareMode::change || session_.view.coloring == model::Coloring::none)
    return view;
  view.difference = true;
  const bool of_file = comparison.with == ui::CompareWith::file;
  view.against = (of_file ? partner_.shown(session_, comparison).document : session_.document)->path.string();
  // A typed one is that of the quantity itself, and 0 would not be in its middle.
  view.range = {};
  return view;
}

bool Editor::shows_before() const {
  const ui::CompareMode mode = interface_.state().comparison.mode;
  return mode != ui::CompareMode::off && mode != ui::CompareMode::change;
}

// The present state; inside a step the mesh before it.
Shown Editor::shown_now() const {
  const auto& step = session_.inspection.step;
  const model::Cursor& cursor = session_.timeline.cursor;
  const bool inside = cursor.stage && step && step->before_state && !session_.is_running() &&
                      step->at.branch == cursor.branch && step->at.iteration == cursor.iteration;
  return {session_.document, inside ? step->before_state : session_.current, session_.original};
}

// Runs beside the present one: while nothing else is compared.
bool Editor::shows_others() const {
  return !session_.other_states.empty() && interface_.state().comparison.mode == ui::CompareMode::off;
}

// Pictures side by side.
std::size_t Editor::panes() const {
  if (shows_others()) return 1 + session_.other_states.size();
  const ui::Comparison& comparison = interface_.state().comparison;
  const bool pair = comparison.mode == ui::CompareMode::side_by_side && session_.current &&
                    partner_.shown(session_, comparison).state;
  return pair ? 2 : 1;
}

// Pixels at the right of several pictures for the legend of all.
int Editor::legend_strip() const {
  const bool wanted = panes() > 1 && session_.view.legend && session_.view.coloring != model::Coloring::none;
  return wanted ? static_cast<int>(std::floor(ui::kLegendStrip * scale_)) : 0;
}

// What one picture of the viewport has: its part where several stand side by side.
render::PictureSize Editor::pane() const {
  const std::size_t count = panes();
  if (count == 1) return viewport_;
  const int width = viewport_.width - legend_strip();
  const int height = panes_room().height;
  const ui::Grid grid = shows_others()
                            ? ui::grid_of(count, static_cast<float>(width), static_cast<float>(height))
                            : ui::Grid{2, 1};
  return {std::max(1, width / grid.columns), std::max(1, height / grid.rows)};
}

// What is written into a picture stands clear of what the interface lays over it.
void Editor::clear_overlays(render::Scene& scene) const {
  if (saving_) return;
  const bool names = shows_names();
  const bool selection = ui::tells_selection(interface_.state(), session_);
  if (names || selection) scene.caption_lift = ui::kNameStrip;
  if (names && selection) scene.caption_lift += ui::kSelectionStrip;
  scene.legend_top = top_covered() / scale_;
}

void Editor::draw(KeptPicture& picture, const Shown& shown, const view::View& view) {
  const bool lines_only =
      &picture == &before_ && interface_.state().comparison.mode == ui::CompareMode::ghost;
  PictureKey key;
  key.geometry = shown.state->geometry.get();
  key.energy = shown.state->energy.get();
  key.against = shown.against.get();
  key.view = view;
  key.lines_only = lines_only;
  render::Scene room;
  clear_overlays(room);
  key.caption_lift = room.caption_lift;
  key.legend_top = room.legend_top;
  if (&picture == &current_) {
    const auto& step = session_.inspection.step;
    key.step = step && !session_.is_running() ? step->record.get() : nullptr;
    key.stage = session_.timeline.cursor.stage;
    key.vertex = session_.selected_vertex;
    key.limit = session_.selected_limit;
    key.reasons = session_.view.reasons;
    key.pinned = session_.smoothing.pinned;
  }
  // Of a split the left part is the other picture's.
  if (&picture == &before_ && interface_.state().comparison.mode == ui::CompareMode::split) key.dots = dots_;
  if (picture.drawn && key == picture.key) return;
  render::Scene scene = picture.scene.make(shown, view);
  clear_overlays(scene);
  // One legend serves both.
  if (lines_only) scene.legend.reset();
  scene.key = key.dots;
  if (&picture == &current_) {
    add_step(session_, shown.state->positions(), scene);
    dots_ = scene.key;
  }
  if (lines_only) {
    scene.transparent = true;
    scene.notes.clear();
    scene.meshes[0].faces_shown = false;
    scene.meshes[0].wire = {.shown = true, .color = {255, 122, 61}, .opacity = 0.85, .width = 1.3};
  }
  try {
    picture.renderer.draw(scene, camera_, view.size);
    picture.drawn = true;
  } catch (const Error& error) {
    say(model::MessageKind::error, error.what());
  }
  picture.key = std::move(key);
}

void Editor::draw_pictures() {
  ui::Comparison& comparison = interface_.state().comparison;
  if (const auto news = partner_.take_over(comparison)) model::execute(session_, model::Say{*news});
  if (!session_.current) {
    current_.drawn = before_.drawn = false;
    others_.clear();
    return;
  }
  if (const auto refusal = partner_.require_change(session_, comparison))
    model::execute(session_, model::Say{*refusal});
  Shown before = partner_.shown(session_, comparison);
  Shown now = shown_now();
  // Arrows from what has other triangles would mean nothing.
  if (partner_.is_comparable(session_, comparison)) now.against = before.state;
  draw(current_, now, present_view());
  draw_others();
  draw_legend();
  if (!shows_before() || !before.state) {
    before_.drawn = false;
    return;
  }
  if (before.document == session_.document) before.against = session_.original;
  view::View view = present_view();
  view.arrows = false;
  view.selected.reset();
  draw(before_, before, view);
}

void Editor::draw_others() {
  const std::size_t count = shows_others() ? session_.other_states.size() : 0;
  others_.resize(std::min(others_.size(), count));
  while (others_.size() < count) others_.push_back(std::make_unique<KeptPicture>(loader_));
  view::View view = present_view();
  view.legend = false;
  view.arrows = false;
  for (std::size_t k = 0; k < count; ++k)
    draw(*others_[k], {session_.document, session_.other_states[k], session_.original}, view);
}

void Editor::draw_legend() {
  if (legend_strip() == 0) {
    legend_.reset();
    return;
  }
  if (!legend_) legend_ = std::make_unique<KeptPicture>(loader_);
  view::View view = present_view();
  view.legend = true;
  view.size = {legend_strip(), panes_room().height};
  // The text is as large as in the pictures.
  view.points = scale_;
  render::Scene scene = legend_->scene.make(shown_now(), view);
  clear_overlays(scene);
  scene.meshes.clear();
  scene.notes.clear();
  try {
    legend_->renderer.draw(scene, camera_, view.size);
  } catch (const Error& error) {
    say(model::MessageKind::error, error.what());
  }
}

// Where a point of the viewport is in the picture that it is over.
std::array<float, 2> Editor::in_pane(float x, float y) const {
  const auto width = static_cast<float>(pane().width);
  const auto height = static_cast<float>(pane().height);
  const float below = std::max(0.0F, y - static_cast<float>(panes_top()));
  return {x - width * std::floor(x / width), below - height * std::floor(below / height)};
}

// What is under a pixel of a picture as it is drawn, but with all triangles: their numbers are asked for.
std::optional<render::Pick> Editor::pick_at(const Shown& shown, int x, int y) {
  view::View view = present_view();
  view.only_worse_than.reset();
  current_.drawn = false;
  return current_.renderer.pick(current_.scene.make(shown, view), camera_, pane(), x, y);
}

void Editor::pick(float x, float y) {
  if (!session_.current || !current_.drawn || x >= static_cast<float>(viewport_.width - legend_strip()) ||
      y < static_cast<float>(panes_top()))
    return;
  const auto [at_x, at_y] = in_pane(x, y);
  const Shown shown = shown_now();
  const auto found = pick_at(shown, static_cast<int>(at_x), static_cast<int>(at_y));
  if (!found) {
    act(model::ClearSelection{});
    return;
  }
  const Triangle& t = session_.document->mesh().triangles[found->triangle];
  const auto positions = shown.state->positions();
  unsigned nearest = 0;
  while (t[nearest] != found->vertex) ++nearest;
  if (means_vertex(found->point, {positions[t[0]], positions[t[1]], positions[t[2]]}, nearest))
    act(model::SelectVertex{found->vertex});
  else
    act(model::SelectTriangle{found->triangle});
  base_.selected.reset();
  interface_.state().tab = ui::SideTab::inspect;
}

void Editor::act(const model::Command& command) {
  log_.note(command, session_, camera_, interface_.state());
  model::execute(session_, command);
}

void Editor::look(const std::string& spec) {
  if (session_.current)
    camera_ = render::parse_camera(spec, session_.current->positions(), pane(), fit_options());
}

void Editor::say(model::MessageKind kind, const std::string& text, model::Topic topic) {
  model::execute(session_, model::Say{{kind, text, topic}});
}

void Editor::carry_out(const ui::Output& output) {
  for (const model::Command& command : output.commands) {
    act(command);
    // A triangle that came with a pasted view stays marked until another is.
    if (std::holds_alternative<model::SelectNextWorst>(command) ||
        std::holds_alternative<model::SelectVertex>(command) ||
        std::holds_alternative<model::SelectTriangle>(command) ||
        std::holds_alternative<model::ClearSelection>(command))
      base_.selected.reset();
  }
  for (const ui::Request& request : output.requests) carry_out_request(request);
  acted_ = !output.commands.empty() || !output.requests.empty();
}

void Editor::carry_out_request(const ui::Request& request) {
  if (const auto* orbit = std::get_if<ui::OrbitView>(&request)) {
    flight_.reset();
    camera_ = render::orbit(camera_, orbit->dx, orbit->dy, pane());
  } else if (const auto* pan = std::get_if<ui::PanView>(&request)) {
    flight_.reset();
    camera_ = render::pan(camera_, pan->dx, pan->dy, pane());
  } else if (const auto* zoom = std::get_if<ui::ZoomView>(&request)) {
    flight_.reset();
    const auto [x, y] = in_pane(zoom->x, zoom->y);
    camera_ = render::zoom_to(camera_, zoom->factor, x, y, pane());
  } else if (std::holds_alternative<ui::FrameView>(request)) {
    if (session_.current) fly_to(framed_ = framed(camera_));
  } else if (const auto* from = std::get_if<ui::LookFrom>(&request)) {
    if (session_.current)
      fly_to(framed_ = framed(
                 render::parse_camera(from->view, session_.current->positions(), pane(), fit_options())));
  } else if (std::holds_alternative<ui::FlyToSelection>(request)) {
    if (session_.current && session_.selected_triangle)
      fly_to(beside_divider(look_at_triangle(camera_, session_, *session_.selected_triangle)));
    else if (session_.current && session_.selected_vertex)
      fly_to(beside_divider(look_at_vertex(camera_, session_, *session_.selected_vertex)));
  } else if (const auto* at = std::get_if<ui::PickAt>(&request)) {
    pick(at->x, at->y);
  } else if (const auto* picture = std::get_if<ui::SavePicture>(&request)) {
    save_picture(picture->path);
  } else if (const auto* file = std::get_if<ui::SaveScript>(&request)) {
    save_script(file->path);
  } else if (std::holds_alternative<ui::CopyView>(request)) {
    copy_view();
  } else if (const auto* paste = std::get_if<ui::PasteView>(&request)) {
    paste_view(paste->text);
  } else if (std::holds_alternative<ui::RememberState>(request)) {
    if (session_.current) partner_.remember(session_, interface_.state().comparison);
  } else if (const auto* other = std::get_if<ui::CompareWithFile>(&request)) {
    partner_.read(other->path);
  } else {
    quit_ = true;
  }
}

bool Editor::has_settled() const {
  return !acted_ && !flight_.has_value() && !partner_.is_reading() && interface_.has_settled();
}

}  // namespace isorelax::editor
