#include <algorithm>
#include <array>
#include <cmath>

#include "editor/editor.h"
#include "render/overlay.h"

namespace isorelax::editor {
namespace {

constexpr double kFlightSeconds = 0.3;

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

// Another file gets a camera of its own; the same file read again keeps the one there is.
void Editor::follow_document() {
  if (shown_document_ == session_.document || !session_.document) return;
  const bool same_file = shown_document_ && shown_document_->path == session_.document->path;
  shown_document_ = session_.document;
  if (same_file) return;
  base_.selected.reset();
  camera_ = framed_ = render::default_camera(session_.document->mesh().positions, pane(), fit_options());
  framed_box_.setEmpty();
  framed_pane_ = panes() > 1 ? std::optional(pane()) : std::nullopt;
  framed_change_ = interface_.state().comparison.mode == ui::CompareMode::change;
  framed_alone_.reset();
  flight_.reset();
}

// A camera that shows the whole mesh; of a moving surface all moments, so that it serves every one of them.
render::Camera Editor::framed(const render::Camera& camera) {
  const model::Branch* branch = session_.moving();
  if (branch == nullptr || branch->box.isEmpty())
    return render::fit(camera, session_.current->positions(), pane(), fit_options());
  framed_box_ = branch->box;
  std::array<Vec3, 8> corners;
  for (int k = 0; k < 8; ++k)
    corners.at(static_cast<std::size_t>(k)) =
        branch->box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
  return render::fit(camera, corners, pane(), fit_options());
}

// A camera that nobody has turned since it framed the mesh goes on to frame it.
void Editor::follow_motion() {
  const model::Branch* branch = session_.moving();
  if (branch == nullptr || branch->box.isEmpty() || flight_ || !(camera_ == framed_)) return;
  if (!framed_box_.isEmpty() && framed_box_.contains(branch->box)) return;
  camera_ = framed_ = framed(camera_);
}

// Keeps the mesh clear of the legend, of the controls at the top and of the names at the bottom.
render::FitOptions Editor::fit_options() {
  ViewScene scene;
  const double height = pane().height;
  const double top = (bar_height() - static_cast<float>(panes_top())) / height;
  const double bottom = shows_names() ? ui::kNameStrip * scale_ / height : 0;
  // In low panes the mesh is worth more than being clear of everything.
  constexpr double kMostCovered = 0.4;
  const double share = std::min(1.0, kMostCovered / std::max(top + bottom, 1e-9));
  return {.margin = 0.07,
          .right = render::legend_share(scene.make(shown_now(), present_view()), pane()),
          .top = share * top,
          .bottom = share * bottom};
}

// Pixels that the controls of the comparison cover at the top.
float Editor::bar_height() const {
  return ui::compare_bar_height(interface_.state(), static_cast<float>(viewport_.width), scale_);
}

// Several pictures begin under them.
int Editor::panes_top() const {
  return panes() > 1 ? static_cast<int>(bar_height()) : 0;
}

// What all pictures of the viewport and their legend have together.
render::PictureSize Editor::panes_room() const {
  return {viewport_.width, std::max(1, viewport_.height - panes_top())};
}

// Pixels of the pictures that are covered at the top, by a notice as well where that reaches as far as a
// legend: its title stands under it. The camera stays for one.
float Editor::top_covered() const {
  const auto& rects = interface_.state().rects;
  const auto notice = rects.find("notice");
  const auto view = rects.find("viewport");
  float covered = bar_height();
  if (notice != rects.end() && view != rects.end() &&
      notice->second.high.x > view->second.high.x - ui::kLegendStrip * scale_)
    covered = std::max(covered, notice->second.high.y - view->second.low.y);
  return covered - static_cast<float>(panes_top());
}

// Names stand in pictures of which there are several.
bool Editor::shows_names() const {
  return panes() > 1 || shows_before();
}

// Pictures beside each other have less room than one, and what each has depends on the window; the legend of
// a change is wider. A camera that the user moved stays; one that was not is what it was when a single plain
// picture is left.
void Editor::follow_panes() {
  if (!session_.current) return;
  const std::optional<render::PictureSize> room = panes() > 1 ? std::optional(pane()) : std::nullopt;
  const bool change = interface_.state().comparison.mode == ui::CompareMode::change;
  if (room == framed_pane_ && change == framed_change_) return;
  const bool was_alone = !framed_pane_ && !framed_change_;
  framed_pane_ = room;
  framed_change_ = change;
  if (flight_ || !(camera_ == framed_)) return;
  if (was_alone) framed_alone_ = framed_;
  camera_ = framed_ = !room && !change && framed_alone_ ? *framed_alone_ : framed(camera_);
}

void Editor::move_camera(double time) {
  if (!flight_) return;
  const double t = std::clamp((time - flight_->start) / kFlightSeconds, 0.0, 1.0);
  camera_ = between(flight_->from, flight_->to, t * t * (3 - 2 * t));
  if (t < 1) return;
  camera_ = flight_->to;  // to the bit
  flight_.reset();
}

bool Editor::sees_selection() {
  if (!session_.current || !(session_.selected_vertex || session_.selected_triangle)) return false;
  const Shown shown = shown_now();
  const auto x = shown.state->positions();
  Vec3 point;
  if (session_.selected_vertex) {
    point = x[*session_.selected_vertex];
  } else {
    const Triangle& t = session_.document->mesh().triangles[*session_.selected_triangle];
    point = (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
  }
  const render::PictureSize size = pane();
  const render::MeshFrame frame{point, camera_.extent};
  const glm::vec4 clip =
      render::view_projection(camera_, size, frame, render::bounds_of(x)) * glm::vec4(0, 0, 0, 1);
  if (!(clip.w > 0)) return false;
  const auto column =
      static_cast<int>(std::floor((0.5F + 0.5F * clip.x / clip.w) * static_cast<float>(size.width)));
  const auto row =
      static_cast<int>(std::floor((0.5F - 0.5F * clip.y / clip.w) * static_cast<float>(size.height)));
  if (column < 0 || row < 0 || column >= size.width || row >= size.height) return false;
  const auto found = pick_at(shown, column, row);
  if (!found) return false;
  if (session_.selected_triangle) return found->triangle == *session_.selected_triangle;
  const Triangle& t = session_.document->mesh().triangles[found->triangle];
  return std::ranges::find(t, *session_.selected_vertex) != t.end();
}

// In a split what is looked at stands in the middle of the part that shows it as it is now.
render::Camera Editor::beside_divider(const render::Camera& camera) const {
  const ui::Comparison& comparison = interface_.state().comparison;
  if (comparison.mode != ui::CompareMode::split || !before_.drawn) return camera;
  return render::pan(camera, 0.5 * comparison.divider * pane().width, 0, pane());
}

void Editor::fly_to(const render::Camera& to) {
  if (motion_ == Motion::instant)
    camera_ = to;
  else
    flight_ = Flight{camera_, to, time_};
}

}  // namespace isorelax::editor
