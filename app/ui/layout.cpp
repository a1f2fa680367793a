#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr float kSmallestPanel = 240;  // points
constexpr float kLargestPanel = 560;
constexpr float kSmallestViewport = 300;  // of the transport and a menu of stages
constexpr float kRoomForBoth = 600;       // with which both panels stand beside it
constexpr float kFoldedPanel = 300;       // the one that has the settings among its tabs

// A thin invisible handle between a panel and the viewport; `direction` is the sign of growth to the right.
void draw_splitter(const Ui& ui, const char* name, float x, const Rect& beside, float direction,
                   float& width) {
  if (beside.height() < 1) return;
  const float half = ui.px(3);
  ImGui::SetNextWindowPos({x - half, beside.low.y});
  ImGui::SetNextWindowSize({2 * half, beside.height()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav);
  ImGui::InvisibleButton("handle", {2 * half, beside.height()});
  const bool active = ImGui::IsItemActive();
  if (active || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled({x - ui.px(1), beside.low.y}, {x + ui.px(1), beside.high.y},
                                              active ? color::kAccent : color::kControlActive);
  }
  if (active)
    width =
        std::clamp(width + direction * ImGui::GetIO().MouseDelta.x / ui.scale, kSmallestPanel, kLargestPanel);
  mark_area(ui, name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImGui::End();
  ImGui::PopStyleVar(2);
}

// In a low window it has the transport and the track alone, in a lower one it gives way.
float timeline_height(float room, float scale) {
  if (room > 3 * size::kTimeline * scale) return size::kTimeline * scale;
  return room > 3 * size::kLowTimeline * scale ? size::kLowTimeline * scale : 0;
}

}  // namespace

Layout make_layout(const UiState& state, ImVec2 display, float scale) {
  Layout layout;
  if (state.panels_hidden) {
    layout.viewport = {{0, 0}, display};
    return layout;
  }
  const float top = size::kTopBar * scale;
  const float bottom = std::max(top, display.y - size::kStatusBar * scale);
  // In a small window the panels give way to the viewport; in a smaller one a single panel has all tabs.
  const float room = std::max(0.0F, display.x - kSmallestViewport * scale);
  const float wanted = (state.left_width + state.right_width) * scale;
  const float shrink = wanted > room ? room / wanted : 1;
  layout.folded = room < kRoomForBoth * scale;
  const float folded = std::min(kFoldedPanel * scale, std::max(room, 0.5F * display.x));
  const float left = layout.folded ? 0 : std::floor(state.left_width * scale * shrink);
  const float right = std::floor(display.x - (layout.folded ? folded : state.right_width * scale * shrink));
  layout.top = {{0, 0}, {display.x, top}};
  if (!layout.folded) layout.left = {{0, top}, {left, bottom}};
  const float timeline = state.has_mesh ? bottom - timeline_height(bottom - top, scale) : bottom;
  layout.viewport = {{left, top}, {right, timeline}};
  layout.timeline = {{left, timeline}, {right, bottom}};
  layout.right = {{right, top}, {display.x, bottom}};
  layout.status = {{0, bottom}, display};
  return layout;
}

void begin_panel(const char* name, const Rect& rect, ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(rect.low);
  ImGui::SetNextWindowSize({rect.width(), rect.height()});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | flags);
}

void draw_splitters(const Ui& ui, const Layout& layout) {
  draw_splitter(ui, "splitter-left", layout.left.high.x, layout.left, 1, ui.state.left_width);
  if (!layout.folded)
    draw_splitter(ui, "splitter-right", layout.right.low.x, layout.right, -1, ui.state.right_width);
}

}  // namespace isorelax::ui
