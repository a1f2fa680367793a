#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "ui/widgets.h"

namespace isorelax::ui {

std::string exact_text(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

float text_width(const ImFont& font, std::string_view text) {
  if (text.empty()) return 0;  // Dear ImGui would look for the end of what may be no text at all
  return font
      .CalcTextSizeA(font.FontSize, std::numeric_limits<float>::max(), 0, text.data(),
                     text.data() + text.size())
      .x;
}

std::string fitted(const ImFont& font, std::string_view text, float width) {
  if (text_width(font, text) <= width) return std::string(text);
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!text.empty()) {
    while (continues(text.back())) text.remove_suffix(1);
    text.remove_suffix(1);
    std::string shorter = std::string(text) + std::string(kEllipsis);
    if (text_width(font, shorter) <= width) return shorter;
  }
  return {};
}

void draw_figure_label(const Ui& ui, std::string_view label, std::string_view brief, std::string_view tip) {
  const float room = ImGui::GetContentRegionAvail().x;
  const ImFont& font = *ui.fonts.text;
  text_in(ui.fonts.text, color::kTextDim,
          fitted(font, text_width(font, label) <= room ? label : brief, room));
  tooltip(ui, tip);
}

void value_row(const Ui& ui, const ValueRow& row) {
  const std::string id = "##" + std::string(row.name);
  const float height = ImGui::GetTextLineHeight() + ui.px(4);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string& copied = row.exact.empty() ? row.shown : row.exact;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  if (ImGui::InvisibleButton(id.c_str(), {width, height})) ImGui::SetClipboardText(copied.c_str());
  ImGui::PopStyleVar();
  mark_area(ui, row.name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool hovered = ImGui::IsItemHovered();
  if (hovered)
    draw.AddRectFilled({low.x - ui.px(5), low.y}, {low.x + width + ui.px(5), low.y + height},
                       ImGui::IsItemActive() ? color::kControlActive : color::kControl, ui.px(4));
  const float y = low.y + ui.px(2);
  draw.AddText({low.x, y}, color::kTextDim, row.label.data(), row.label.data() + row.label.size());
  const ImFont& font = *ImGui::GetFont();
  const std::string shown = fitted(font, row.shown, width - text_width(font, row.label) - ui.px(8));
  draw.AddText({std::floor(low.x + width - text_width(font, shown)), y}, row.color, shown.c_str());
  if (hovered) tooltip(ui, std::string(row.tip) + (row.tip.empty() ? "" : "\n") + copied, "Click to copy");
}

ValueRow number_row(std::string_view name, std::string_view label, double value, std::string_view unit,
                    std::string_view tip) {
  ValueRow row{name, label, number_text("%.4g", value), exact_text(value), tip};
  if (std::isfinite(value)) row.shown += std::string(unit);
  return row;
}

bool small_button(const Ui& ui, std::string_view name, std::string_view label, const ButtonStyle& style) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(7), ui.px(4)});
  ButtonStyle small = style;
  if (small.height <= 0) small.height = ui.px(24);
  const bool pressed = button(ui, name, label, small);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  return pressed;
}

bool link(const Ui& ui, std::string_view name, std::string_view label) {
  const ImVec2 size = ImGui::CalcTextSize(label.data(), label.data() + label.size());
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(("##" + std::string(name)).c_str(), size);
  mark(ui, name);
  const bool hovered = ImGui::IsItemHovered();
  const ImU32 ink = hovered ? color::kAccentHover : color::kAccent;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddText(low, ink, label.data(), label.data() + label.size());
  if (hovered) draw.AddLine({low.x, low.y + size.y}, {low.x + size.x, low.y + size.y}, ink);
  return pressed;
}

void wrapped(ImFont* font, ImU32 color, std::string_view text) {
  ImGui::PushTextWrapPos(0);
  text_in(font, color, text);
  ImGui::PopTextWrapPos();
}

void draw_mistake(const Ui& ui, const std::string& text, std::size_t column, const std::string& reason) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const std::size_t before = std::min(column - 1, text.size());
  const float from = ImGui::CalcTextSize(text.substr(0, before).c_str()).x;
  const std::string at = before < text.size() ? text.substr(before, 1) : " ";
  const float to = from + std::max(ui.px(6), ImGui::CalcTextSize(at.c_str()).x);
  text_in(ui.fonts.text, color::kText, text);
  const float y = low.y + ImGui::GetTextLineHeight() + ui.px(1);
  draw.AddLine({low.x + from, y}, {low.x + to, y}, color::kWorse, ui.px(2));
  draw.AddTriangleFilled({low.x + from, y + ui.px(6)}, {low.x + to, y + ui.px(6)},
                         {low.x + 0.5F * (from + to), y + ui.px(1)}, color::kWorse);
  ImGui::Dummy({0, ui.px(2)});
  wrapped(ui.fonts.small, color::kWorse, "Column " + std::to_string(column) + ": " + reason);
}

}  // namespace isorelax::ui
