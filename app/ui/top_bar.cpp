#include <algorithm>
#include <array>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

struct Tool {
  std::string_view name{}, label{}, tip{};
  Icon icon = Icon::none;
  Action action = Action::help;
  bool enabled = true;
  bool on = false;
};

void tool(const Ui& ui, const Tool& t) {
  const ButtonStyle style{
      .icon = t.icon, .look = t.on ? ButtonLook::pressed : ButtonLook::quiet, .enabled = t.enabled};
  if (button(ui, t.name, t.label, style)) perform(ui, t.action);
  tooltip(ui, t.tip, keys_of(t.action));
  ImGui::SameLine(0, ui.px(2));
}

void draw_colorings(const Ui& ui, float width) {
  constexpr std::array<std::string_view, 5> kLabels{"Min angle", "Max angle", "Area", "Energy", "Plain"};
  constexpr std::array kColorings{model::Coloring::min_angle, model::Coloring::max_angle,
                                  model::Coloring::relative_area, model::Coloring::energy,
                                  model::Coloring::none};
  int chosen = 0;
  for (int k = 0; k < 5; ++k)
    if (kColorings[static_cast<std::size_t>(k)] == ui.session.view.coloring) chosen = k;
  const int choice = segmented(ui, "coloring", kLabels, chosen, width);
  tooltip(ui, "What the colours of the triangles say. Keys 1 to 5.");
  if (choice < 0) return;
  model::ViewSettings view = ui.session.view;
  view.coloring = kColorings[static_cast<std::size_t>(choice)];
  ui.command(model::SetView{view});
}

void draw_view_tools(const Ui& ui) {
  tool(ui, {.name = "wire",
            .label = "Edges",
            .tip = "Show the edges of the triangles.",
            .icon = Icon::wire,
            .action = Action::wire,
            .on = ui.session.view.wire});
  tool(ui, {.name = "shading",
            .label = "Smooth",
            .tip = "Shade the surface smoothly instead of each triangle flat.",
            .action = Action::shading,
            .on = ui.session.view.shading == model::Shading::smooth});
  tool(ui, {.name = "frame",
            .label = "Frame",
            .tip = "Show the whole mesh.",
            .icon = Icon::frame,
            .action = Action::frame,
            .enabled = ui.session.current != nullptr});
  tool(ui, {.name = "help", .tip = "All keys.", .icon = Icon::help, .action = Action::help});
}

}  // namespace

void draw_top_bar(const Ui& ui, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(9)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(2)});
  begin_panel("top-bar", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const model::Session& s = ui.session;
  const bool open = s.current != nullptr;
  tool(ui, {.name = "open",
            .label = "Open",
            .tip = "Open a mesh: " + model::mesh_formats() + ".",
            .icon = Icon::open,
            .action = Action::open});
  tool(ui, {.name = "save",
            .label = "Save",
            .tip = "Save the mesh with its current positions.",
            .icon = Icon::save,
            .action = Action::save,
            .enabled = open});
  tool(ui, {.name = "picture",
            .label = "Picture",
            .tip = "Save what the viewport shows as a PNG file.",
            .icon = Icon::picture,
            .action = Action::save_picture,
            .enabled = open});
  ImGui::SameLine(0, ui.px(10));
  const auto* undo = s.undo.next_undo();
  const auto* redo = s.undo.next_redo();
  const std::string undo_tip = undo != nullptr ? "Undo: " + undo->label : "Nothing to undo";
  const std::string redo_tip = redo != nullptr ? "Redo: " + redo->label : "Nothing to redo";
  tool(ui, {.name = "undo",
            .tip = undo_tip,
            .icon = Icon::undo,
            .action = Action::undo,
            .enabled = undo != nullptr});
  tool(ui, {.name = "redo",
            .tip = redo_tip,
            .icon = Icon::redo,
            .action = Action::redo,
            .enabled = redo != nullptr});

  const float tools = button_width(ui, "Edges", Icon::wire) + button_width(ui, "Smooth", Icon::none) +
                      button_width(ui, "Frame", Icon::frame) + button_width(ui, "", Icon::help) + ui.px(20);
  const float left = ImGui::GetCursorPosX() + ui.px(10);
  const float width = std::clamp(rect.width() - tools - left - ui.px(10), ui.px(200), ui.px(390));
  ImGui::SameLine(std::max(0.5F * (rect.width() - width), left), 0);
  draw_colorings(ui, width);
  const float end = ImGui::GetItemRectMax().x - rect.low.x + ui.px(10);
  ImGui::SameLine(std::max(rect.width() - tools, end), 0);
  draw_view_tools(ui);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace isorelax::ui
