#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace isorelax::ui {
namespace {

struct ButtonColors {
  ImU32 rest, hover, active, text;
};

ButtonColors colors_of(ButtonLook look) {
  switch (look) {
    case ButtonLook::accent:
      return {color::kAccent, color::kAccentHover, color::kAccentActive, color::kOnAccent};
    case ButtonLook::quiet:
      return {IM_COL32(0, 0, 0, 0), color::kControl, color::kControlActive, color::kText};
    case ButtonLook::pressed:
      return {IM_COL32(242, 140, 79, 46), IM_COL32(242, 140, 79, 66), IM_COL32(242, 140, 79, 86),
              color::kAccentHover};
    case ButtonLook::plain:
      break;
  }
  return {color::kControl, color::kControlHover, color::kControlActive, color::kText};
}

// Gives the last item the keyboard focus where it is asked for, and notes whether it has it.
void follow_focus(const Ui& ui, std::string_view name) {
  const ImGuiID id = ImGui::GetItemID();
  if (ui.state.focus_request == name) {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    if (g.ActiveId != id) ImGui::ClearActiveID();  // a field that was left is typed into no more
    ImGui::FocusWindow(ImGui::GetCurrentWindow());
    ImGui::SetFocusID(id, ImGui::GetCurrentWindow());
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
    ImGui::SetScrollHereY();
  }
  const bool highlighted = ImGui::GetFocusID() == id && !ImGui::GetCurrentContext()->NavDisableHighlight;
  const bool typed_into = ImGui::GetIO().WantTextInput && ImGui::GetActiveID() == id;
  if (highlighted || typed_into) ui.state.focused = name;
}

}  // namespace

void mark_area(const Ui& ui, std::string_view name, const Rect& rect) {
  ui.state.rects.insert_or_assign(std::string(name), rect);
}

void mark(const Ui& ui, std::string_view name) {
  mark_area(ui, name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  const ImGuiID id = ImGui::GetItemID();
  if (id == 0 || (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0) return;
  ui.state.stops.emplace_back(name);
  follow_focus(ui, name);
}

float button_width(const Ui& ui, std::string_view label, Icon icon) {
  const float pad = ImGui::GetStyle().FramePadding.x;
  float width = 2 * pad;
  if (icon != Icon::none) width += ui.px(14);
  if (!label.empty()) width += ImGui::CalcTextSize(label.data(), label.data() + label.size()).x;
  if (icon != Icon::none && !label.empty()) width += ui.px(7);
  return std::ceil(width);
}

bool button(const Ui& ui, std::string_view name, std::string_view label, const ButtonStyle& style) {
  const ButtonColors colors = colors_of(style.look);
  const float height = style.height > 0 ? style.height : ui.px(size::kControl);
  const float width = style.width > 0 ? style.width : button_width(ui, label, style.icon);
  ImGui::BeginDisabled(!style.enabled);
  ImGui::PushStyleColor(ImGuiCol_Button, colors.rest);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colors.hover);
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, colors.active);
  const std::string id = "##" + std::string(name);
  const bool pressed = ImGui::Button(id.c_str(), {width, height});
  ImGui::PopStyleColor(3);
  if (style.stop) {
    mark(ui, name);
  } else {
    mark_area(ui, name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    follow_focus(ui, name);
  }
  const ImVec2 low = ImGui::GetItemRectMin();
  const float icon = style.icon != Icon::none ? ui.px(14) : 0;
  const float gap = icon > 0 && !label.empty() ? ui.px(7) : 0;
  const std::string shown = fitted(*ImGui::GetFont(), label, width - icon - gap);
  const ImVec2 text = ImGui::CalcTextSize(shown.c_str());
  float x = low.x + 0.5F * (width - icon - gap - text.x);
  if (style.align == ButtonAlign::left) x = low.x + ImGui::GetStyle().FramePadding.x;
  const ImU32 color = ImGui::GetColorU32(colors.text);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (icon > 0) draw_icon(draw, style.icon, {x + 0.5F * icon, low.y + 0.5F * height}, icon, color);
  x += icon + gap;
  draw.AddText({std::floor(x), std::floor(low.y + 0.5F * (height - text.y))}, color, shown.c_str());
  ImGui::EndDisabled();
  return pressed;
}

int segmented(const Ui& ui, std::string_view name, std::span<const std::string_view> labels, int chosen,
              float width) {
  int result = -1;
  const float each = std::floor(width / static_cast<float>(labels.size()));
  if (std::ranges::any_of(
          labels, [&](std::string_view label) { return text_width(*ImGui::GetFont(), label) > each; })) {
    ImGui::SetNextItemWidth(width);
    return combo(ui, name, labels, chosen);
  }
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(
      low, {low.x + each * static_cast<float>(labels.size()), low.y + ui.px(size::kControl)},
      ImGui::GetColorU32(color::kControl), ImGui::GetStyle().FrameRounding);
  const int last = static_cast<int>(labels.size()) - 1;
  const int stop = std::clamp(chosen, 0, last);
  const auto id_of = [&](int k) {
    return std::string(name) + "/" + std::string(labels[static_cast<std::size_t>(k)]);
  };
  bool focused = false;
  for (int k = 0; k <= last; ++k) {
    if (k > 0) ImGui::SameLine(0, 0);
    const bool on = chosen == k;
    const ButtonStyle style{
        .look = on ? ButtonLook::pressed : ButtonLook::quiet, .width = each, .stop = k == stop};
    if (button(ui, id_of(k), labels[static_cast<std::size_t>(k)], style) && !on) result = k;
    focused = focused || ui.state.focused == id_of(k);
  }
  if (!focused) return result;
  ui.state.segment_focused = true;
  const int next = std::clamp(stop + ui.state.segment_step, 0, last);
  if (ui.state.segment_step == 0 || next == chosen) return result;
  ui.state.next_focus = id_of(next);
  return next;
}

void heading(const Ui& ui, std::string_view text) {
  const bool first = ImGui::GetCursorPosY() < ImGui::GetStyle().WindowPadding.y + 1;
  if (!first) {
    ImGui::Dummy({0, ui.px(2)});
    ImGui::Separator();
    ImGui::Dummy({0, ui.px(1)});
  }
  text_in(ui.fonts.heading, color::kTextDim, text);
}

void text_in(ImFont* font, ImU32 color, std::string_view text) {
  ImGui::PushFont(font);
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void row_label(const Ui& ui, std::string_view label, std::string_view tip) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label.data(), label.data() + label.size());
  tooltip(ui, tip);
  ImGui::SameLine(ui.px(104));
  ImGui::SetNextItemWidth(-1);
}

void tooltip(const Ui& ui, std::string_view text, std::string_view keys) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (ImGui::GetCurrentContext()->HoveredIdTimer < kTooltipDelay && ImGui::GetItemID() != 0) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(8)});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ui.px(280));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  if (!keys.empty()) text_in(ui.fonts.small, color::kTextDim, keys);
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool slider(const Ui& ui, std::string_view name, float& value, float low, float high, const char* format) {
  const std::string id = "##" + std::string(name);
  const float width = ImGui::GetContentRegionAvail().x - ui.px(44);
  ImGui::SetNextItemWidth(width);
  // While a number is typed it stands in the slider itself.
  const bool is_typed = ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
  if (!is_typed) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(0, 0, 0, 0));
  const bool changed =
      ImGui::SliderFloat(id.c_str(), &value, low, high, format, ImGuiSliderFlags_AlwaysClamp);
  if (!is_typed) ImGui::PopStyleColor();
  const std::string text = number_text(format, value);
  const ImVec2 end = ImGui::GetItemRectMax();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  ImGui::GetWindowDrawList()->AddText(
      {std::floor(end.x + ui.px(44) - size.x), std::floor(end.y - 0.5F * (ui.px(size::kControl) + size.y))},
      ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return changed;
}

int menu(const Ui& ui, std::string_view name, std::span<const MenuEntry> entries, int chosen) {
  int result = -1;
  const std::string id = "##" + std::string(name);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::CalcItemWidth();
  const float height = ImGui::GetFrameHeight();
  const float room = width - height - 2 * ImGui::GetStyle().FramePadding.x;
  const bool known = chosen >= 0 && static_cast<std::size_t>(chosen) < entries.size();
  const std::string preview =
      known ? fitted(*ImGui::GetFont(), entries[static_cast<std::size_t>(chosen)].label, room) : "";
  if (ImGui::BeginCombo(id.c_str(), preview.c_str())) {
    mark_area(ui, name, {low, {low.x + width, low.y + height}});
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const std::string& label = entries[k].label;
      const auto flags = entries[k].enabled ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
      if (ImGui::Selectable(label.c_str(), chosen == static_cast<int>(k), flags))
        result = static_cast<int>(k);
      mark_area(ui, std::string(name) + "/" + label, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    }
    ImGui::EndCombo();
  } else {
    mark(ui, name);
  }
  return result;
}

int combo(const Ui& ui, std::string_view name, std::span<const std::string_view> labels, int chosen) {
  std::vector<MenuEntry> entries;
  for (const std::string_view label : labels) entries.push_back({std::string(label)});
  return menu(ui, name, entries, chosen);
}

std::string count_text(std::size_t count) {
  std::string digits = std::to_string(count);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), "\xE2\x80\x89");  // thin space
  return digits;
}

std::string counted(std::size_t count, std::string_view one, std::string_view more) {
  return count_text(count) + " " + std::string(count == 1 ? one : more);
}

std::string number_text(const char* format, double value) {
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  if (std::isnan(value)) return "\xE2\x80\x93";  // en dash
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  // A zero has no sign, nor has what is shown as one.
  const std::string shown = text;
  const bool is_zero = shown.find_first_of("123456789") == std::string::npos;
  return is_zero && shown.starts_with('-') ? shown.substr(1) : shown;
}

}  // namespace isorelax::ui
