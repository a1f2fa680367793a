#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

std::string describe_document(const model::Session& s) {
  if (!s.document) return "No mesh";
  const TriangleMesh& mesh = s.document->mesh();
  return s.document->path.filename().string() + (s.has_unsaved_changes() ? " *" : "") + "   " +
         counted(mesh.vertex_count(), "vertex", "vertices") + "   " +
         counted(mesh.triangle_count(), "triangle", "triangles") + "   " +
         (s.moving() != nullptr ? "t = " + number_text("%.4g", s.moment().time)
                                : "iteration " + count_text(s.current->iteration));
}

void draw_progress(const Ui& ui, const model::Progress& progress, float x) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 origin = ImGui::GetWindowPos();
  const float height = ImGui::GetWindowHeight();
  const float width = ui.px(110);
  const float y = std::floor(origin.y + 0.5F * height - ui.px(2));
  draw.AddRectFilled({origin.x + x, y}, {origin.x + x + width, y + ui.px(4)}, color::kControl, ui.px(2));
  if (progress.share >= 0) {
    draw.AddRectFilled(
        {origin.x + x, y},
        {origin.x + x + width * static_cast<float>(std::clamp(progress.share, 0.0, 1.0)), y + ui.px(4)},
        color::kAccent, ui.px(2));
  } else {
    // How long it takes is not known: a piece that wanders.
    const float at = static_cast<float>(std::fmod(ImGui::GetTime() * 0.7, 1.0)) * 0.7F * width;
    draw.AddRectFilled({origin.x + x + at, y}, {origin.x + x + at + 0.3F * width, y + ui.px(4)},
                       color::kAccent, ui.px(2));
  }
  mark_area(ui, "progress", {{origin.x + x, y}, {origin.x + x + width, y + ui.px(4)}});
}

// A message that came after the run says more than the run does.
std::string news(const model::Session& s) {
  const std::uint64_t newest = s.messages.empty() ? 0 : s.messages.back().number;
  if (s.last_run && !s.is_running() && newest <= s.last_run_number) return describe_last_run(s);
  return s.messages.empty() ? "" : s.messages.back().text;
}

}  // namespace

void draw_status_bar(const Ui& ui, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(14), ui.px(6)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  begin_panel("status", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::SetCursorPosY(0.5F * (rect.height() - ui.fonts.small->FontSize));
  text_in(ui.fonts.small, color::kTextDim, describe_document(ui.session));
  mark_area(ui, "document", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  const float left = ImGui::GetItemRectMax().x - rect.low.x + ui.px(24);
  const model::Progress progress = ui.session.engine.progress();
  float right = rect.width() - ui.px(14);
  if (progress.busy) {
    right -= ui.px(110) + ui.px(26);
    draw_progress(ui, progress, right);
    ImGui::PushFont(ui.fonts.small);
    const float label = ImGui::CalcTextSize(progress.label.c_str()).x;
    ImGui::PopFont();
    right -= label + ui.px(10);
    ImGui::SameLine(right);
    text_in(ui.fonts.small, color::kText, progress.label);
    ImGui::SameLine(rect.width() - ui.px(34));
    ImGui::SetCursorPosY(ui.px(5));
    // Text behind it in the line would be set on the baseline of its padding.
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
    if (button(ui, "cancel", "",
               {.icon = Icon::close, .look = ButtonLook::quiet, .width = ui.px(22), .height = ui.px(20)}))
      ui.command(model::Cancel{});
    ImGui::PopStyleVar();
    tooltip(ui, "Stop this.");
    right -= ui.px(20);
  }
  const std::string text = news(ui.session);
  const bool error = !ui.session.messages.empty() && text == ui.session.messages.back().text &&
                     ui.session.messages.back().kind == model::MessageKind::error;
  const float room = right - left;
  if (!text.empty() && room > ui.px(60)) {
    // A whole sentence rather than the beginning of two.
    const bool fits = text_width(*ui.fonts.small, text) <= room;
    const std::string shown = fitted(*ui.fonts.small, fits ? text : text.substr(0, text.find("; ")), room);
    ImGui::SameLine(right - text_width(*ui.fonts.small, shown));
    ImGui::SetCursorPosY(0.5F * (rect.height() - ui.fonts.small->FontSize));
    text_in(ui.fonts.small, error ? color::kWorse : color::kText, shown);
    mark_area(ui, "news", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    tooltip(ui, text);
  }
  ImGui::GetWindowDrawList()->AddLine(rect.low, {rect.high.x, rect.low.y}, color::kLine);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace isorelax::ui
