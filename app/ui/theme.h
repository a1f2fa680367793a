#pragma once

#include <imgui.h>

#include <span>

namespace isorelax::ui {

/// The colours of the editor. Charcoal surfaces in three heights, quiet text in three weights, one accent.
namespace color {
inline constexpr ImU32 kBackdrop = IM_COL32(20, 22, 26, 255);
inline constexpr ImU32 kPanel = IM_COL32(28, 31, 36, 255);
inline constexpr ImU32 kControl = IM_COL32(43, 47, 55, 255);
inline constexpr ImU32 kControlHover = IM_COL32(54, 59, 69, 255);
inline constexpr ImU32 kControlActive = IM_COL32(65, 71, 83, 255);
inline constexpr ImU32 kLine = IM_COL32(46, 50, 58, 255);
inline constexpr ImU32 kText = IM_COL32(226, 229, 235, 255);
inline constexpr ImU32 kTextDim = IM_COL32(152, 159, 171, 255);
inline constexpr ImU32 kTextFaint = IM_COL32(104, 111, 123, 255);
inline constexpr ImU32 kAccent = IM_COL32(242, 140, 79, 255);
inline constexpr ImU32 kAccentHover = IM_COL32(250, 160, 106, 255);
inline constexpr ImU32 kAccentActive = IM_COL32(219, 120, 62, 255);
inline constexpr ImU32 kOnAccent = IM_COL32(30, 20, 12, 255);
// The hues below differ by 12 or more (CIE 1976, as sRGB is seen) with full colour vision, without the red
// and without the green cones.
inline constexpr ImU32 kBetter = IM_COL32(120, 208, 158, 255);
inline constexpr ImU32 kWorse = IM_COL32(235, 122, 108, 255);
inline constexpr ImU32 kWarning = IM_COL32(233, 196, 106, 255);
inline constexpr ImU32 kSecond = IM_COL32(112, 178, 214, 255);  ///< a second line in a plot
/// What limited a vertex, by bit of Limit: pinned, corner, ridge, boundary, fold, energy, surface, converged.
inline constexpr ImU32 kLimits[8] = {
    IM_COL32(194, 116, 210, 255), IM_COL32(218, 60, 86, 255),   IM_COL32(244, 203, 82, 255),
    IM_COL32(73, 147, 251, 255),  IM_COL32(255, 122, 61, 255),  IM_COL32(64, 201, 198, 255),
    IM_COL32(159, 134, 116, 255), IM_COL32(111, 191, 121, 255),
};
/// Branches of the timeline, in turn.
inline constexpr ImU32 kBranches[6] = {
    IM_COL32(234, 133, 73, 255),  IM_COL32(125, 172, 194, 255), IM_COL32(130, 211, 154, 255),
    IM_COL32(197, 151, 233, 255), IM_COL32(241, 203, 114, 255), IM_COL32(223, 108, 139, 255),
};
/// Arrows of the stages: gradient, tangent, proposed, control, moved.
inline constexpr ImU32 kStages[5] = {
    IM_COL32(235, 235, 240, 255), IM_COL32(112, 178, 214, 255), IM_COL32(233, 196, 106, 255),
    IM_COL32(240, 110, 90, 255),  IM_COL32(255, 122, 61, 255),
};
}  // namespace color

/// Sizes in points; multiply by the scale for pixels. Distances are multiples of the grid.
namespace size {
inline constexpr float kGrid = 4;
inline constexpr float kText = 14.5F;
inline constexpr float kSmallText = 12.5F;
inline constexpr float kTitleText = 17;
inline constexpr float kTopBar = 48;
inline constexpr float kStatusBar = 30;
inline constexpr float kControl = 30;
inline constexpr float kTimeline = 116;
inline constexpr float kLowTimeline = 72;  ///< without its words
}  // namespace size

/// Bytes of OpenType fonts with Latin and Greek letters.
struct FontFiles {
  std::span<const char> regular;
  std::span<const char> semibold;
};

/// Fonts in the order in which they stand in the atlas.
struct Fonts {
  ImFont* text = nullptr;
  ImFont* small = nullptr;
  ImFont* heading = nullptr;
  ImFont* title = nullptr;
};

/// Fills the atlas for a scale (pixels per point) and makes all digits equally wide, so that columns of
/// numbers line up. The caller uploads the atlas again.
Fonts load_fonts(ImFontAtlas& atlas, const FontFiles& files, float scale);

/// Sets the whole style of the current context for a scale.
void apply_theme(float scale);

/// The same colour, more transparent: `share` of its opacity.
constexpr ImU32 faded(ImU32 color, float share) {
  const auto alpha = static_cast<ImU32>(static_cast<float>(color >> IM_COL32_A_SHIFT) * share);
  return (color & ~IM_COL32_A_MASK) | alpha << IM_COL32_A_SHIFT;
}

/// A theme colour for functions that want floats.
inline ImVec4 to_vec4(ImU32 color) {
  return ImGui::ColorConvertU32ToFloat4(color);
}

}  // namespace isorelax::ui
