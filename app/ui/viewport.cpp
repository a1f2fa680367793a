#include <algorithm>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

void navigate(const Ui& ui, const Rect& rect) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool planar = ui.session.document && ui.session.document->plane_normal.has_value();
  const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
  if (ImGui::IsItemActive() && moved) {
    const bool middle = io.MouseDown[2] || io.MouseDown[1];
    const bool pans = middle || io.KeyShift || (planar && !io.KeyCtrl);
    if (pans)
      ui.request(PanView{io.MouseDelta.x, io.MouseDelta.y});
    else
      ui.request(OrbitView{io.MouseDelta.x, io.MouseDelta.y});
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0)
    ui.request(
        ZoomView{std::pow(1.15F, io.MouseWheel), io.MousePos.x - rect.low.x, io.MousePos.y - rect.low.y});
}

// A press that goes up again where it went down is a click; anything else was a drag.
void pick(const Ui& ui, const Rect& rect, bool divides) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated()) ui.state.press_at = io.MouseClickedPos[0];
  if (!ImGui::IsItemDeactivated() || divides || !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return;
  const float dx = io.MousePos.x - ui.state.press_at.x;
  const float dy = io.MousePos.y - ui.state.press_at.y;
  if (dx * dx + dy * dy > ui.px(4) * ui.px(4)) return;
  ui.request(PickAt{io.MousePos.x - rect.low.x, io.MousePos.y - rect.low.y});
}

void centered(ImFont* font, float middle, ImU32 color, const std::string& text) {
  ImGui::PushFont(font);
  ImGui::SetCursorPosX(middle - 0.5F * ImGui::CalcTextSize(text.c_str()).x);
  ImGui::PopFont();
  text_in(font, color, text);
}

void draw_welcome(const Ui& ui, const Rect& rect) {
  const float middle = 0.5F * rect.width();
  ImGui::SetCursorPosY(0.36F * rect.height());
  centered(ui.fonts.title, middle, color::kText, "Drop a mesh here");
  centered(ui.fonts.text, middle, color::kTextDim, model::mesh_formats());
  ImGui::Dummy({0, ui.px(8)});
  const float width = ui.px(180);
  ImGui::SetCursorPosX(middle - 0.5F * width);
  if (button(ui, "welcome-open", "Open a mesh",
             {.icon = Icon::open, .look = ButtonLook::accent, .width = width, .height = ui.px(38)}))
    perform(ui, Action::open);
  if (ui.session.recent.empty()) return;
  ImGui::Dummy({0, ui.px(12)});
  centered(ui.fonts.heading, middle, color::kTextFaint, "RECENT");
  for (std::size_t k = 0; k < std::min<std::size_t>(ui.session.recent.size(), 5); ++k) {
    const std::string name = ui.session.recent[k].filename().string();
    ImGui::SetCursorPosX(middle - ui.px(130));
    if (button(ui, "recent/" + std::to_string(k), name, {.look = ButtonLook::quiet, .width = ui.px(260)}))
      open_file(ui, ui.session.recent[k]);
    tooltip(ui, ui.session.recent[k].string());
  }
}

// Whether what did not work has worked since, or what was to be done is done.
bool is_answered(const model::Session& session, const model::Message& message) {
  if (message.topic == model::Topic::other) return false;
  if (message.topic == model::Topic::turning)
    return session.current && session.current->geometry != session.original->geometry;
  return std::ranges::any_of(session.messages, [&](const model::Message& m) {
    return m.number > message.number && m.topic == message.topic && m.kind == model::MessageKind::info;
  });
}

/// The newest error, or the warnings that came together, each on its line.
std::string notice_text(const Ui& ui, const model::Message& newest) {
  if (newest.kind == model::MessageKind::error) return newest.text;
  static constexpr unsigned kMostLines = 6;
  const auto& messages = ui.session.messages;
  std::string text;
  unsigned lines = 0;
  for (auto m = messages.rbegin(); m != messages.rend() && lines < kMostLines; ++m) {
    if (m->number > newest.number || m->kind == model::MessageKind::info) continue;
    if (m->number <= ui.state.dismissed_message || m->kind == model::MessageKind::error) break;
    if (is_answered(ui.session, *m)) continue;
    if (lines > 0) text.insert(0, "\n");
    text.insert(0, m->text);
    ++lines;
  }
  return text;
}

// The newest error or the warnings stay over the viewport until they are dismissed or answered.
void draw_notice(const Ui& ui, const Rect& rect, float top) {
  const model::Message* found = notice(ui.state, ui.session);
  if (found == nullptr) return;
  const bool error = found->kind == model::MessageKind::error;
  const float margin = ui.px(14);
  const float width = std::min(ui.px(520), rect.width() - 2 * margin);
  if (width < ui.px(80)) return;
  ImGui::SetNextWindowPos({rect.low.x + margin, rect.low.y + top + margin});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, to_vec4(IM_COL32(34, 37, 43, 255)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(16), ui.px(10)});
  ImGui::Begin("notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize);
  const ImU32 tint = error ? color::kWorse : color::kWarning;
  text_in(ui.fonts.heading, tint, error ? "That did not work" : "Please note");
  ImGui::SameLine(width - ui.px(42));
  if (button(ui, "dismiss", "", {.icon = Icon::close, .look = ButtonLook::quiet, .height = ui.px(22)}))
    ui.state.dismissed_message = found->number;
  ImGui::PushTextWrapPos(width - ui.px(16));
  ImGui::TextUnformatted(notice_text(ui, *found).c_str());
  ImGui::PopTextWrapPos();
  const ImVec2 low = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(low, {low.x + size.x, low.y + size.y});
  draw.AddRectFilled(low, {low.x + ui.px(4), low.y + size.y}, tint, ui.px(6), ImDrawFlags_RoundCornersLeft);
  draw.PopClipRect();
  mark_area(ui, "notice", {low, {low.x + size.x, low.y + size.y}});
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

std::string describe_selection(const model::Session& s) {
  const Index t = *s.selected_triangle;
  const model::Geometry& g = *s.current->geometry;
  const std::string rank = s.rank_of_worst() > 0 ? ", worst no. " + std::to_string(s.rank_of_worst()) : "";
  std::string text = "Triangle " + std::to_string(t) + rank + ":  " +
                     number_text("%.2f", g.min_angle_values[t]) + "\xC2\xB0 to " +
                     number_text("%.2f", g.max_angle_values[t]) + "\xC2\xB0,  area " +
                     number_text("%.3g", g.area_values[t]) + " \xC3\x97 mean";
  if (s.current->energy) text += ",  E " + number_text("%.4g", s.current->energy->values[t]);
  return text;
}

// Cards at the bottom of the viewport leave the names of pictures alone, and each other.
float lowest_card(const Ui& ui, const Rect& rect, const ViewportImage& image) {
  const CompareMode mode = ui.state.comparison.mode;
  const bool pair = image.before != nullptr && mode != CompareMode::off && mode != CompareMode::change;
  return rect.high.y - ui.px(pair || !image.others.empty() ? kNameStrip : 14);
}

// Returns where it stands.
Rect draw_selection(const Ui& ui, const Rect& rect, float bottom) {
  if (!tells_selection(ui.state, ui.session)) return {};
  const ImVec2 pad{ui.px(12), ui.px(7)};
  const std::string text =
      fitted(*ui.fonts.text, describe_selection(ui.session), rect.width() - 2 * (ui.px(14) + pad.x));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 low{rect.low.x + ui.px(14), bottom - size.y - 2 * pad.y};
  const ImVec2 high{low.x + size.x + 2 * pad.x, low.y + size.y + 2 * pad.y};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(low, high, IM_COL32(34, 37, 43, 235), ui.px(6));
  draw.AddRectFilled(low, {low.x + ui.px(4), high.y}, color::kAccent, ui.px(6), ImDrawFlags_RoundCornersLeft);
  draw.AddText({low.x + pad.x, low.y + pad.y}, color::kText, text.c_str());
  mark_area(ui, "selection", {low, high});
  return {low, high};
}

// Of a moving surface: the time, and that colours of different times can be compared. Over the card of a
// selection where both have no room beside each other.
void draw_moment(const Ui& ui, const Rect& rect, float bottom, const Rect& selection) {
  const model::Session& s = ui.session;
  if (s.moving() == nullptr) return;
  const std::string time = "t = " + number_text("%.4g", s.moment().time);
  std::string text = time;
  const bool areas = s.view.coloring == model::Coloring::relative_area;
  if (s.view.range_mode == model::RangeMode::run && (areas || s.view.coloring == model::Coloring::energy))
    text += areas ? "   \xC2\xB7   areas over the mean, one range for the whole run"
                  : "   \xC2\xB7   one range for the whole run";
  const float line = ui.fonts.small->FontSize;
  const ImVec2 pad{ui.px(10), ui.px(5)};
  if (text_width(*ui.fonts.small, text) > rect.width() - 2 * (ui.px(14) + pad.x)) text = time;
  const float width = text_width(*ui.fonts.small, text);
  const bool beside = selection.high.x + ui.px(8) < rect.high.x - ui.px(14) - width - 2 * pad.x;
  const ImVec2 high{rect.high.x - ui.px(14), beside ? bottom : selection.low.y - ui.px(6)};
  const ImVec2 low{std::floor(high.x - width - 2 * pad.x), std::floor(high.y - line - 2 * pad.y)};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(low, high, IM_COL32(34, 37, 43, 235), ui.px(6));
  draw.AddText(ui.fonts.small, line, {low.x + pad.x, low.y + pad.y}, color::kText, text.c_str());
  mark_area(ui, "moment", {low, high});
}

}  // namespace

const model::Message* notice(const UiState& state, const model::Session& session) {
  const auto& messages = session.messages;
  const auto found = std::find_if(messages.rbegin(), messages.rend(), [&](const model::Message& m) {
    return m.kind != model::MessageKind::info && !is_answered(session, m);
  });
  const bool is_shown = found != messages.rend() && found->number > state.dismissed_message;
  return is_shown ? &*found : nullptr;
}

bool tells_selection(const UiState& state, const model::Session& session) {
  // The inspector says it better.
  const bool inspected = state.tab == SideTab::inspect && !state.panels_hidden;
  return session.selected_triangle && session.current && !inspected;
}

void draw_viewport(const Ui& ui, const Rect& rect, const ViewportImage& image) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, to_vec4(color::kBackdrop));
  begin_panel("viewport", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (ui.session.current) {
    const ImVec2 size{std::max(1.0F, rect.width()), std::max(1.0F, rect.height())};
    ImGui::InvisibleButton("view", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    if (ImGui::IsItemActivated()) ui.state.focused.clear();
    const bool divides = drag_divider(ui, rect);
    if (!divides) navigate(ui, rect);
    pick(ui, rect, divides);
    const Rect pictures = room_of_pictures(ui, rect, image);
    draw_pictures(ui, *ImGui::GetWindowDrawList(), pictures, image);
    mark_area(ui, "pictures", pictures);
    const float bottom = lowest_card(ui, rect, image);
    draw_moment(ui, rect, bottom, draw_selection(ui, rect, bottom));
  } else if (ui.session.activity != model::Activity::loading) {
    draw_welcome(ui, rect);
  }
  mark_area(ui, "viewport", rect);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  if (ui.session.current) draw_compare_bar(ui, rect);
  const bool bar = ui.session.current != nullptr;
  draw_notice(ui, rect, bar ? compare_bar_height(ui.state, rect.width(), ui.scale) : 0);
}

}  // namespace isorelax::ui
