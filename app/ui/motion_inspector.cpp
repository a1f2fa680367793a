#include <algorithm>
#include <cmath>

#include "ui/inspector_parts.h"
#include "ui/motion_panel.h"
#include "ui/panels.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

std::string moment_text(const model::Session& s) {
  const unsigned step = s.timeline.cursor.iteration - s.moving()->start;
  const std::string time = "t = " + number_text("%.4g", s.moment().time);
  if (step == 0) return "At the start of the motion, " + time;
  return "After step " + std::to_string(step) + ", " + time;
}

void draw_moving_title(const Ui& ui, const std::string& text) {
  ImGui::Dummy({0, ui.px(2)});
  text_in(ui.fonts.title, color::kText, text);
  mark_area(ui, "inspected", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ui.px(50));
  if (small_button(ui, "fly", "Fly", {.width = ui.px(50)})) ui.request(FlyToSelection{});
  tooltip(ui, "Take the camera there.");
  text_in(ui.fonts.small, color::kTextFaint, moment_text(ui.session));
}

bool is_waiting(const Ui& ui, bool known) {
  if (known) return false;
  const model::Session& s = ui.session;
  text_in(ui.fonts.text, color::kTextFaint, s.is_running() ? "Pause the run to look at its step." : "...");
  return true;
}

void position_row(const Ui& ui, std::string_view name, std::string_view label, const Vec3& x,
                  std::string_view tip) {
  value_row(
      ui, {name, label,
           number_text("%.4g", x.x()) + ", " + number_text("%.4g", x.y()) + ", " + number_text("%.4g", x.z()),
           exact_text(x.x()) + " " + exact_text(x.y()) + " " + exact_text(x.z()), tip});
}

// "It went 0.012 with the motion; redistribution then moved it by 0.003."
std::string way_sentence(const model::MovingVertex& v) {
  const double moved = v.by_motion.norm();
  const double rest = v.by_redistribution.norm();
  std::string text =
      moved > 0 ? "The motion took it " + number_text("%.3g", moved) : "The motion left it in place";
  if (rest <= 1e-12 * std::max(moved, 1e-300)) return text + ", and nothing else moved it.";
  return text + "; redistribution then moved it by " + number_text("%.3g", rest) + ".";
}

void draw_way(const Ui& ui) {
  const auto& path = ui.session.inspection.moving_path;
  const model::Branch& branch = *ui.session.moving();
  if (!path || path->vertex != ui.session.selected_vertex || path->distance.size() < 2 ||
      path->distance.size() > branch.moments.size())
    return;
  heading(ui, "ITS WAY");
  const auto line = [&](const std::vector<double>& values, const char* label, ImU32 ink) {
    Line made{label, ink, {}, {}};
    for (std::size_t k = 0; k < values.size(); ++k) {
      made.points.emplace_back(static_cast<float>(branch.moments[k].time), static_cast<float>(values[k]));
      made.new_start.push_back(k == 0);
    }
    return made;
  };
  const auto plot = [&](const char* name, const char* title, std::vector<Line> lines) {
    double high = 0;
    for (const Line& l : lines)
      for (const ImVec2& p : l.points) high = std::max(high, double{p.y});
    draw_lines(ui,
               {.name = name,
                .title = title,
                .lines = std::move(lines),
                .high = high > 0 ? 1.08 * high : 1,
                .marker = ui.session.moment().time,
                .x_name = "t =",
                .x_format = "%.4g",
                .x_end = branch.until,
                .whole_numbers = false},
               ui.px(120));
  };
  plot("way-plot", "LENGTH OF THE WAY SO FAR",
       {line(path->by_motion, "motion", color::kAccent),
        line(path->by_redistribution, "redistribution", color::kSecond)});
  plot("path-plot", "DISTANCE FROM WHERE IT STARTED", {line(path->distance, "distance", color::kAccent)});
}

std::string share_sentence(const model::MovingTriangle& t) {
  std::string text =
      "Its smallest angle is " + number_text("%.2f", t.step.after.metrics.min_angle_deg) + "\xC2\xB0";
  if (t.area_start > 0)
    text += ", its area " + number_text("%.3g", t.step.after.metrics.area / t.area_start) +
            " \xC3\x97 that at the start";
  return text + ".";
}

}  // namespace

void draw_moving_vertex(const Ui& ui) {
  const model::Session& s = ui.session;
  draw_moving_title(ui, "Vertex " + std::to_string(*s.selected_vertex));
  const auto& v = s.inspection.moving_vertex;
  if (is_waiting(ui, v && v->vertex == *s.selected_vertex)) return;
  const bool at_start = s.timeline.cursor.iteration == s.moving()->start;
  if (!at_start) wrapped(ui.fonts.text, color::kText, way_sentence(*v));
  mark_area(ui, "why", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  heading(ui, "THIS STEP");
  value_row(ui, number_row("moving/motion", "By the motion", v->by_motion.norm(), "",
                           "How far the motion alone would have taken it in this step, units of the file."));
  value_row(ui, number_row("moving/redistribution", "By redistribution", v->by_redistribution.norm(), "",
                           "How far redistribution, and the balance of volume, then moved it."));
  position_row(ui, "moving/before", "From", v->before, "Position before the step, in units of the file.");
  position_row(ui, "moving/after", "To", v->after, "Position after the step.");
  draw_way(ui);
  wrapped(ui.fonts.small, color::kTextFaint,
          "Gradient, class and stages belong to a smoother's steps; a moving surface has none.");
}

void draw_moving_triangle(const Ui& ui) {
  const model::Session& s = ui.session;
  draw_moving_title(ui, "Triangle " + std::to_string(*s.selected_triangle));
  if (!s.inspection.unknown.empty()) {
    wrapped(ui.fonts.text, color::kWarning, s.inspection.unknown);
    return;
  }
  const auto& t = s.inspection.moving_triangle;
  if (is_waiting(ui, t && t->step.triangle == *s.selected_triangle)) return;
  wrapped(ui.fonts.text, color::kText, share_sentence(*t));
  mark_area(ui, "why", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImGui::Dummy({0, ui.px(2)});
  draw_triangles(ui, t->step, ui.px(150));
  draw_triangle_sections(ui, t->step);
  value_row(ui, number_row("triangle/area-start", "Area at the start", t->area_start, "",
                           "When the motion began, squared units of the file."));
}

}  // namespace isorelax::ui
