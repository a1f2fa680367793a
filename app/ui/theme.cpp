#include "ui/theme.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isorelax::ui {
namespace {

// Latin, Latin-1, Greek, general punctuation (dashes, ellipsis), superscripts, arrows, minus, approximately,
// less-equal.
constexpr std::array<ImWchar, 19> kGlyphs{0x0020, 0x017F, 0x0391, 0x03C9, 0x2002, 0x2027, 0x2032,
                                          0x2033, 0x2070, 0x209C, 0x2190, 0x2199, 0x2212, 0x2212,
                                          0x2248, 0x2248, 0x2264, 0x2265, 0};

void make_digits_equally_wide(ImFont& font) {
  float widest = 0;
  for (ImWchar c = '0'; c <= '9'; ++c) widest = std::max(widest, font.FindGlyph(c)->AdvanceX);
  for (ImFontGlyph& glyph : font.Glyphs) {
    if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
    const float shift = 0.5F * (widest - glyph.AdvanceX);
    glyph.X0 += shift;
    glyph.X1 += shift;
    glyph.AdvanceX = widest;
    font.IndexAdvanceX[static_cast<int>(glyph.Codepoint)] = widest;
  }
}

ImFont* add_font(ImFontAtlas& atlas, std::span<const char> file, float pixels) {
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  config.OversampleV = 1;
  // The atlas only reads the bytes, though its interface does not say so.
  return atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()), pixels,
                                    &config, kGlyphs.data());
}

}  // namespace

Fonts load_fonts(ImFontAtlas& atlas, const FontFiles& files, float scale) {
  atlas.Clear();
  Fonts fonts;
  fonts.text = add_font(atlas, files.regular, size::kText * scale);
  fonts.small = add_font(atlas, files.regular, size::kSmallText * scale);
  fonts.heading = add_font(atlas, files.semibold, size::kSmallText * scale);
  fonts.title = add_font(atlas, files.semibold, size::kTitleText * scale);
  atlas.Build();
  for (ImFont* font : atlas.Fonts) make_digits_equally_wide(*font);
  return fonts;
}

void apply_theme(float scale) {
  ImGuiStyle style;
  style.WindowPadding = {14, 12};
  style.FramePadding = {10, 0.5F * (size::kControl - size::kText)};
  style.ItemSpacing = {8, 8};
  style.ItemInnerSpacing = {6, 6};
  style.ScrollbarSize = 10;
  style.GrabMinSize = 12;
  style.WindowRounding = 0;
  style.ChildRounding = 6;
  style.FrameRounding = 5;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 5;
  style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.FrameBorderSize = 0;
  style.PopupBorderSize = 1;
  style.CellPadding = {6, 3};
  style.DisabledAlpha = 0.45F;
  style.AntiAliasedLinesUseTex = false;
  constexpr std::array<std::pair<ImGuiCol, ImU32>, 33> kColors{{
      {ImGuiCol_Text, color::kText},
      {ImGuiCol_TextDisabled, color::kTextDim},
      {ImGuiCol_WindowBg, color::kPanel},
      {ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_PopupBg, IM_COL32(34, 37, 43, 255)},
      {ImGuiCol_Border, IM_COL32(62, 67, 77, 255)},
      {ImGuiCol_FrameBg, color::kControl},
      {ImGuiCol_FrameBgHovered, color::kControlHover},
      {ImGuiCol_FrameBgActive, color::kControlActive},
      {ImGuiCol_TitleBg, color::kPanel},
      {ImGuiCol_TitleBgActive, color::kPanel},
      {ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_ScrollbarGrab, color::kControl},
      {ImGuiCol_ScrollbarGrabHovered, color::kControlHover},
      {ImGuiCol_ScrollbarGrabActive, color::kControlActive},
      {ImGuiCol_CheckMark, color::kAccent},
      {ImGuiCol_SliderGrab, color::kAccent},
      {ImGuiCol_SliderGrabActive, color::kAccentHover},
      {ImGuiCol_Button, color::kControl},
      {ImGuiCol_ButtonHovered, color::kControlHover},
      {ImGuiCol_ButtonActive, color::kControlActive},
      {ImGuiCol_Header, color::kControl},
      {ImGuiCol_HeaderHovered, color::kControlHover},
      {ImGuiCol_HeaderActive, color::kControlActive},
      {ImGuiCol_Separator, color::kLine},
      {ImGuiCol_TableHeaderBg, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_TableBorderStrong, color::kLine},
      {ImGuiCol_TableBorderLight, color::kLine},
      {ImGuiCol_TableRowBg, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_TableRowBgAlt, IM_COL32(255, 255, 255, 7)},
      {ImGuiCol_TextSelectedBg, IM_COL32(242, 140, 79, 96)},
      {ImGuiCol_NavHighlight, color::kAccent},
      {ImGuiCol_ModalWindowDimBg, IM_COL32(8, 9, 11, 150)},
  }};
  for (const auto& [index, value] : kColors) style.Colors[index] = to_vec4(value);
  style.ScaleAllSizes(scale);
  style.PopupBorderSize = 1;
  ImGui::GetStyle() = style;
}

}  // namespace isorelax::ui
