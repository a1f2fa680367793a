#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

// Points of the choice of colours: with words beside it, and at all.
constexpr float kLeastChoice = 200;
constexpr float kSmallestChoice = 90;

// Pixels across a triangle under which nothing is to be seen of its edges (mesh.frag).
constexpr double kLeastTriangle = 3;

struct Tool {
  std::string_view name{}, label{}, tip{};
  Icon icon = Icon::none;
  Action action = Action::help;
  bool enabled = true;
  bool on = false;
};

/// Whether what has an icon has words, too.
enum class Words : std::uint8_t { shown, left_out };

std::string_view words_of(const Tool& t, Words words) {
  return words == Words::left_out && t.icon != Icon::none ? std::string_view() : t.label;
}

void tool(const Ui& ui, const Tool& t, Words words) {
  const ButtonStyle style{
      .icon = t.icon, .look = t.on ? ButtonLook::pressed : ButtonLook::quiet, .enabled = t.enabled};
  if (button(ui, t.name, words_of(t, words), style)) perform(ui, t.action);
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

std::array<Tool, 3> file_tools(const Ui& ui) {
  const bool open = ui.session.current != nullptr;
  static const std::string kOpenTip = "Open a mesh: " + model::mesh_formats() + ".";
  return {{{.name = "open", .label = "Open", .tip = kOpenTip, .icon = Icon::open, .action = Action::open},
           {.name = "save",
            .label = "Save",
            .tip = "Save the mesh with its current positions.",
            .icon = Icon::save,
            .action = Action::save,
            .enabled = open},
           {.name = "picture",
            .label = "Picture",
            .tip = "Save what the viewport shows as a PNG file.",
            .icon = Icon::picture,
            .action = Action::save_picture,
            .enabled = open}}};
}

std::array<Tool, 4> view_tools(const Ui& ui) {
  const model::ViewSettings& view = ui.session.view;
  // Smaller triangles would be painted over by their edges: those fade away.
  const bool dense = ui.session.current && ui.state.looking.triangle_pixels < kLeastTriangle;
  return {{{.name = "wire",
            .label = "Edges",
            .tip = view.wire && dense ? "On, but the triangles are too small for their edges here: zoom in."
                                      : "Show the edges of the triangles.",
            .icon = Icon::wire,
            .action = Action::wire,
            .on = view.wire && !dense},
           {.name = "shading",
            .label = "Smooth",
            .tip = "Shade the surface smoothly instead of each triangle flat.",
            .action = Action::shading,
            .on = view.shading == model::Shading::smooth},
           {.name = "frame",
            .label = "Frame",
            .tip = "Show the whole mesh.",
            .icon = Icon::frame,
            .action = Action::frame,
            .enabled = ui.session.current != nullptr},
           {.name = "help", .tip = "All keys.", .icon = Icon::help, .action = Action::help}}};
}

float width_of(const Ui& ui, std::span<const Tool> tools, Words words) {
  float width = 0;
  for (const Tool& t : tools) width += button_width(ui, words_of(t, words), t.icon) + ui.px(2);
  return width;
}

void draw_undo_tools(const Ui& ui) {
  const auto* undo = ui.session.undo.next_undo();
  const auto* redo = ui.session.undo.next_redo();
  const std::string undo_tip = undo != nullptr ? "Undo: " + undo->label : "Nothing to undo";
  const std::string redo_tip = redo != nullptr ? "Redo: " + redo->label : "Nothing to redo";
  tool(ui,
       {.name = "undo",
        .tip = undo_tip,
        .icon = Icon::undo,
        .action = Action::undo,
        .enabled = undo != nullptr},
       Words::shown);
  tool(ui,
       {.name = "redo",
        .tip = redo_tip,
        .icon = Icon::redo,
        .action = Action::redo,
        .enabled = redo != nullptr},
       Words::shown);
}

}  // namespace

void draw_top_bar(const Ui& ui, const Rect& rect) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(9)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(2)});
  begin_panel("top-bar", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const auto files = file_tools(ui);
  const auto views = view_tools(ui);
  const float history = 2 * (button_width(ui, "", Icon::undo) + ui.px(2));
  // Everything stays in the window: where it is too narrow, what has an icon has no words.
  const float others = history + ui.px(10 + 10 + 10 + 20);
  const float all = width_of(ui, files, Words::shown) + width_of(ui, views, Words::shown) + others;
  const Words words = all + ui.px(kLeastChoice) <= rect.width() ? Words::shown : Words::left_out;
  for (const Tool& t : files) tool(ui, t, words);
  ImGui::SameLine(0, ui.px(10));
  draw_undo_tools(ui);
  const float tools = width_of(ui, views, words) + ui.px(12);
  const float left = ImGui::GetCursorPosX() + ui.px(10);
  const float width = std::clamp(rect.width() - tools - left - ui.px(10), ui.px(kSmallestChoice), ui.px(390));
  ImGui::SameLine(std::max(0.5F * (rect.width() - width), left), 0);
  draw_colorings(ui, width);
  const float end = ImGui::GetItemRectMax().x - rect.low.x + ui.px(10);
  ImGui::SameLine(std::max(rect.width() - tools, end), 0);
  for (const Tool& t : views) tool(ui, t, words);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace isorelax::ui
