#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr float kBlinkSeconds = 0.6F;

/// A part of a picture from share a to share b of its width, where it would be if it filled the rectangle.
void draw_part(ImDrawList& draw, ImTextureID texture, const Rect& rect, float a, float b) {
  if (texture == nullptr || a >= b) return;
  const float x0 = rect.low.x + a * rect.width();
  const float x1 = rect.low.x + b * rect.width();
  draw.AddImage(texture, {x0, rect.low.y}, {x1, rect.high.y}, {a, 1}, {b, 0});
}

std::string name_of_before(const Comparison& comparison) {
  switch (comparison.with) {
    case CompareWith::beside:
      return "The run beside";
    case CompareWith::original:
      break;
    case CompareWith::remembered:
      return comparison.remembered;
    case CompareWith::file:
      return comparison.file;
  }
  return "Original";
}

// At the left of a place where `room` is left of a pane's width, or at its right. Of a run it has the colour
// that the run has everywhere.
void draw_name(const Ui& ui, ImDrawList& draw, const std::string& whole, ImVec2 at, float room,
               bool right_of_x, ImU32 ink = 0) {
  const auto [x, y] = at;
  ImFont& font = *ui.fonts.text;
  const ImVec2 pad{ui.px(ink != 0 ? 12 : 8), ui.px(4)};
  const std::string name = fitted(font, whole, room - 2 * (ui.px(10) + pad.x));
  if (name.empty()) return;
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, name.c_str());
  const float left = right_of_x ? x + ui.px(10) : x - ui.px(10) - size.x - 2 * pad.x;
  const ImVec2 low{left, y - ui.px(12) - size.y - 2 * pad.y};
  draw.AddRectFilled(low, {low.x + size.x + 2 * pad.x, low.y + size.y + 2 * pad.y}, IM_COL32(34, 37, 43, 225),
                     ui.px(5));
  if (ink != 0)
    draw.AddRectFilled(low, {low.x + ui.px(4), low.y + size.y + 2 * pad.y}, ink, ui.px(5),
                       ImDrawFlags_RoundCornersLeft);
  draw.AddText(&font, font.FontSize, {low.x + pad.x, low.y + pad.y}, color::kText, name.c_str());
  mark_area(ui, "name/" + whole, {low, {low.x + size.x + 2 * pad.x, low.y + size.y + 2 * pad.y}});
}

void draw_divider(const Ui& ui, ImDrawList& draw, const Rect& rect, float x) {
  const float middle = rect.center().y;
  draw.AddRectFilled({x - ui.px(1), rect.low.y}, {x + ui.px(1), rect.high.y}, color::kAccent);
  draw.AddRectFilled({x - ui.px(6), middle - ui.px(16)}, {x + ui.px(6), middle + ui.px(16)}, color::kAccent,
                     ui.px(4));
  mark_area(ui, "divider", {{x - ui.px(6), middle - ui.px(16)}, {x + ui.px(6), middle + ui.px(16)}});
}

void draw_blink(const Ui& ui, ImDrawList& draw, const Rect& rect, const ViewportImage& image) {
  Comparison& comparison = ui.state.comparison;
  comparison.blink_seconds += ImGui::GetIO().DeltaTime;
  if (comparison.blink_seconds > kBlinkSeconds) {
    comparison.blink_seconds = 0;
    comparison.blink_before = !comparison.blink_before;
  }
  draw_part(draw, comparison.blink_before ? image.before : image.texture, rect, 0, 1);
  draw_name(ui, draw, comparison.blink_before ? name_of_before(comparison) : "Current",
            {rect.low.x, rect.high.y}, rect.width(), true);
}

// In a row of so many pixels.
void choose_partner(const Ui& ui, float room) {
  Comparison& comparison = ui.state.comparison;
  const std::string remembered = comparison.remembers ? comparison.remembered : "Remember this state";
  const std::string file = comparison.file.empty() ? "Another file..." : comparison.file;
  const std::array<MenuEntry, 4> entries{
      {{"Original"}, {remembered}, {file}, {"The run beside", !ui.session.shown_branches.empty()}}};
  const float buttons =
      button_width(ui, "Remember", Icon::none) + button_width(ui, "File", Icon::open) + ui.px(6);
  ImGui::SetNextItemWidth(std::clamp(room - buttons, ui.px(60), ui.px(180)));
  const int choice = menu(ui, "compare-with", entries, static_cast<int>(comparison.with));
  tooltip(ui, "What the mesh is compared with.");
  ImGui::SameLine(0, ui.px(4));
  if (button(ui, "remember", "Remember", {.look = ButtonLook::quiet})) {
    ui.request(RememberState{});
    comparison.with = CompareWith::remembered;
  }
  tooltip(ui, "Keep the present state to be compared with.");
  ImGui::SameLine(0, ui.px(2));
  if (button(ui, "compare-file", "File", {.icon = Icon::open, .look = ButtonLook::quiet}))
    ask_for_file(ui, FilePurpose::comparison);
  tooltip(ui, "Compare with a mesh in another file.");
  if (choice == 0) comparison.with = CompareWith::original;
  if (choice == 1) {
    if (!comparison.remembers) ui.request(RememberState{});
    comparison.with = CompareWith::remembered;
  }
  if (choice == 3) comparison.with = CompareWith::beside;
  if (choice == 2) {
    if (comparison.file.empty())
      ask_for_file(ui, FilePurpose::comparison);
    else
      comparison.with = CompareWith::file;
  }
}

}  // namespace

bool drag_divider(const Ui& ui, const Rect& rect) {
  Comparison& comparison = ui.state.comparison;
  if (comparison.mode != CompareMode::split) return false;
  const ImGuiIO& io = ImGui::GetIO();
  const float x = rect.low.x + comparison.divider * rect.width();
  const bool near = std::abs(io.MousePos.x - x) < ui.px(8);
  const bool began_near = std::abs(io.MouseClickedPos[0].x - x) < ui.px(8);
  const bool active = ImGui::IsItemActive() && io.MouseDown[0];
  // Taken hold of where the press began; then it follows the pointer.
  if (ImGui::IsItemActivated()) comparison.dragged = near || began_near;
  if (!active) comparison.dragged = false;
  if (comparison.dragged)
    comparison.divider = std::clamp((io.MousePos.x - rect.low.x) / rect.width(), 0.0F, 1.0F);
  const bool hold = comparison.dragged || (near && ImGui::IsItemHovered() && !active);
  if (hold) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  return comparison.dragged;
}

Grid grid_of(std::size_t pictures, float width, float height) {
  Grid best;
  float longest = 0;
  const int count = static_cast<int>(std::max<std::size_t>(1, pictures));
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const float side = std::min(width / static_cast<float>(columns), height / static_cast<float>(rows));
    if (side > longest) best = {columns, rows}, longest = side;
  }
  return best;
}

namespace {

// Draws the legend that panes share. Returns what is left for them.
Rect beside_legend(const Ui& ui, ImDrawList& draw, Rect rect, const ViewportImage& image) {
  if (image.legend == nullptr) return rect;
  const float left = rect.high.x - std::floor(ui.px(kLegendStrip));
  draw_part(draw, image.legend, {{left, rect.low.y}, rect.high}, 0, 1);
  mark_area(ui, "pane-legend", {{left, rect.low.y}, rect.high});
  rect.high.x = left;
  return rect;
}

// With its number and the iteration that it shows; that, and the word for it, only where they have room.
std::string name_of_run(const Ui& ui, unsigned branch, float width) {
  const model::Session& s = ui.session;
  const unsigned at = std::min(s.shared_iteration(), s.timeline.branches[branch].tip());
  std::string name = s.timeline.numbered_name(branch);
  for (const char* word : {", iteration ", ", "}) {
    std::string whole = name + word + std::to_string(at);
    if (text_width(*ui.fonts.text, whole) <= width - ui.px(44)) return whole;
  }
  return name;
}

/// A run and its picture.
struct Pane {
  unsigned branch = 0;
  ImTextureID texture = nullptr;
};

// In the order of the list of runs, whichever of them is the present one.
std::vector<Pane> panes_of(const model::Session& s, const ViewportImage& image) {
  std::vector<Pane> panes{{s.timeline.cursor.branch, image.texture}};
  for (std::size_t k = 0; k < std::min(image.others.size(), s.shown_branches.size()); ++k)
    panes.push_back({s.shown_branches[k], image.others[k]});
  std::ranges::sort(panes, {}, &Pane::branch);
  return panes;
}

// The runs beside each other, each with its name, the present one with a brighter edge.
void draw_grid(const Ui& ui, ImDrawList& draw, const Rect& rect, const ViewportImage& image) {
  const model::Session& s = ui.session;
  const std::vector<Pane> panes = panes_of(s, image);
  const Grid grid = grid_of(1 + image.others.size(), rect.width(), rect.height());
  const float width = std::floor(rect.width() / static_cast<float>(grid.columns));
  const float height = std::floor(rect.height() / static_cast<float>(grid.rows));
  for (std::size_t k = 0; k < panes.size(); ++k) {
    const unsigned branch = panes[k].branch;
    const int column = static_cast<int>(k) % grid.columns;
    const int row = static_cast<int>(k) / grid.columns;
    const ImVec2 low{rect.low.x + static_cast<float>(column) * width,
                     rect.low.y + static_cast<float>(row) * height};
    const Rect cell{low, {low.x + width, low.y + height}};
    draw_part(draw, panes[k].texture, cell, 0, 1);
    const bool present = branch == s.timeline.cursor.branch;
    draw.AddRect(cell.low, cell.high, present ? color::kTextFaint : color::kLine);
    if (branch >= s.timeline.branches.size()) continue;
    draw_name(ui, draw, name_of_run(ui, branch, cell.width()), {cell.low.x, cell.high.y}, cell.width(), true,
              color::kBranches[branch % std::size(color::kBranches)]);
    mark_area(ui, "view/" + std::to_string(k), cell);
  }
}

}  // namespace

void draw_pictures(const Ui& ui, ImDrawList& draw, const Rect& rect, const ViewportImage& image) {
  const Comparison& comparison = ui.state.comparison;
  if (!image.others.empty()) {
    draw_grid(ui, draw, beside_legend(ui, draw, rect, image), image);
    return;
  }
  const bool pair = image.before != nullptr;
  switch (pair ? comparison.mode : CompareMode::off) {
    case CompareMode::off:
    case CompareMode::change:
      draw_part(draw, image.texture, rect, 0, 1);
      break;
    case CompareMode::split: {
      draw_part(draw, image.before, rect, 0, comparison.divider);
      draw_part(draw, image.texture, rect, comparison.divider, 1);
      const float x = rect.low.x + comparison.divider * rect.width();
      draw_divider(ui, draw, rect, x);
      draw_name(ui, draw, name_of_before(comparison), {x, rect.high.y}, x - rect.low.x, false);
      draw_name(ui, draw, "Current", {x, rect.high.y}, rect.high.x - x, true);
      break;
    }
    case CompareMode::blink:
      draw_blink(ui, draw, rect, image);
      break;
    case CompareMode::side_by_side: {
      const Rect panes = beside_legend(ui, draw, rect, image);
      const float width = std::floor(0.5F * panes.width());
      const float middle = panes.low.x + width;
      draw_part(draw, image.before, {panes.low, {middle, panes.high.y}}, 0, 1);
      draw_part(draw, image.texture, {{middle, panes.low.y}, {middle + width, panes.high.y}}, 0, 1);
      draw_name(ui, draw, name_of_before(comparison), {panes.low.x, panes.high.y}, width, true);
      draw_name(ui, draw, "Current", {middle, panes.high.y}, width, true);
      break;
    }
    case CompareMode::ghost:
      draw_part(draw, image.texture, rect, 0, 1);
      draw_part(draw, image.before, rect, 0, 1);
      draw_name(ui, draw, "Lines: " + name_of_before(comparison), {rect.low.x, rect.high.y}, rect.width(),
                true);
      break;
  }
}

namespace {

// Of the bar, in points.
constexpr float kBarEdge = 10;  // above it
constexpr float kBarPadY = 6;
constexpr float kBarPadX = 10;
constexpr float kRowGap = 8;
constexpr float kModesWidth = 330;
constexpr float kModeMenuWidth = 100;
constexpr float kNarrow = kModesWidth + 120;  // viewports in which the modes do not fit side by side
constexpr float kTooNarrow = 280;             // and those in which the bar would cover all

bool shows_bar(const UiState& state, float width, float scale) {
  return !state.panels_hidden && width >= kTooNarrow * scale;
}

int choose_mode(const Ui& ui, const Rect& rect) {
  constexpr std::array<std::string_view, 6> kModes{"Off", "Split", "Blink", "Side", "Ghost", "Change"};
  const int mode = static_cast<int>(ui.state.comparison.mode);
  if (rect.width() >= ui.px(kNarrow)) return segmented(ui, "compare", kModes, mode, ui.px(kModesWidth));
  ImGui::SetNextItemWidth(ui.px(kModeMenuWidth));
  return combo(ui, "compare", kModes, mode);
}

}  // namespace

float compare_bar_height(const UiState& state, float width, float scale) {
  if (!shows_bar(state, width, scale)) return 0;
  const float more = state.comparison.mode == CompareMode::off ? 0 : kRowGap + size::kControl;
  return std::floor((kBarEdge + 2 * kBarPadY + size::kControl + more) * scale);
}

Rect room_of_pictures(const Ui& ui, Rect viewport, const ViewportImage& image) {
  const Comparison& comparison = ui.state.comparison;
  const bool pair = image.before != nullptr && comparison.mode == CompareMode::side_by_side;
  if (pair || !image.others.empty())
    viewport.low.y += compare_bar_height(ui.state, viewport.width(), ui.scale);
  return viewport;
}

void draw_compare_bar(const Ui& ui, const Rect& rect) {
  Comparison& comparison = ui.state.comparison;
  const bool on = comparison.mode != CompareMode::off;
  if (!shows_bar(ui.state, rect.width(), ui.scale)) return;
  ImGui::SetNextWindowPos({rect.low.x + ui.px(14), rect.low.y + ui.px(kBarEdge)});
  ImGui::SetNextWindowSize({0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, to_vec4(IM_COL32(34, 37, 43, 255)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(kBarPadX), ui.px(kBarPadY)});
  ImGui::Begin("compare-bar", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::AlignTextToFramePadding();
  text_in(ui.fonts.heading, color::kTextDim, "COMPARE");
  ImGui::SameLine(0, ui.px(10));
  const int choice = choose_mode(ui, rect);
  tooltip(ui, "Before and after on one camera; Change colours by quality now minus then.",
          keys_of(Action::compare));
  if (choice >= 0) comparison.mode = static_cast<CompareMode>(choice);
  if (on) choose_partner(ui, rect.width() - 2 * ui.px(14 + kBarPadX));
  const ImVec2 low = ImGui::GetWindowPos();
  mark_area(ui, "compare-bar", {low, {low.x + ImGui::GetWindowWidth(), low.y + ImGui::GetWindowHeight()}});
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace isorelax::ui
