#pragma once

#include "ui/ui_state.h"

namespace isorelax::ui {

/// Where everything is in a frame, in pixels.
struct Layout {
  Rect top, left, viewport, timeline, right, status;
  bool folded = false;  ///< the panel at the left has no room: its settings are a tab of the other one
};
/// The layout for a display of this size; hidden panels are empty.
[[nodiscard]] Layout make_layout(const UiState& state, ImVec2 display, float scale);

/// Textures with pictures of the mesh, first row at the bottom; null: none yet.
struct ViewportImage {
  ImTextureID texture = nullptr;
  ImTextureID before = nullptr;       ///< of what it is compared with
  std::vector<ImTextureID> others{};  ///< of the runs beside the present one
  ImTextureID legend = nullptr;       ///< of them all where there are panes, at the right, kLegendStrip wide
};
/// Points that the legend takes which several pictures share.
inline constexpr float kLegendStrip = 124;

/// How several pictures share the viewport.
struct Grid {
  int columns = 1;
  int rows = 1;
};
/// The grid in which pictures of a viewport of this size have the longest shorter side.
[[nodiscard]] Grid grid_of(std::size_t pictures, float width, float height);

/// Moves the divider of a split with the pointer; whether the pointer has hold of it. Belongs behind the
/// viewport's item.
[[nodiscard]] bool drag_divider(const Ui& ui, const Rect& rect);
/// Where the pictures are in the viewport: several begin under the controls of the comparison.
[[nodiscard]] Rect room_of_pictures(const Ui& ui, Rect viewport, const ViewportImage& image);
/// Draws the pictures into a rectangle as the comparison asks, with their names and the divider of a split.
void draw_pictures(const Ui& ui, ImDrawList& draw, const Rect& rect, const ViewportImage& image);
/// The controls of the comparison, over the viewport.
void draw_compare_bar(const Ui& ui, const Rect& rect);
/// What they cover at the top of a viewport of this width, in pixels.
[[nodiscard]] float compare_bar_height(const UiState& state, float width, float scale);
/// Points that the names of pictures, or what is said of a selection, cover at the bottom; the second stands
/// over the first.
inline constexpr float kNameStrip = 46;
inline constexpr float kSelectionStrip = 36;
/// The newest error or warning as long as it stands over the viewport; null: none does.
[[nodiscard]] const model::Message* notice(const UiState& state, const model::Session& session);
/// Whether what is said of a selected triangle stands over the viewport.
[[nodiscard]] bool tells_selection(const UiState& state, const model::Session& session);

void draw_top_bar(const Ui& ui, const Rect& rect);
void draw_settings_panel(const Ui& ui, const Rect& rect);
/// The panel at the right with its tabs; the settings are one of them where it is the only panel.
void draw_side_panel(const Ui& ui, const Rect& rect, bool folded);
/// What the tabs hold; inside a panel that has begun.
void draw_settings(const Ui& ui);
void draw_quality(const Ui& ui);
/// The distributions of smallest angles and of areas, now and as opened.
void draw_histograms(const Ui& ui, float height);
void draw_inspector(const Ui& ui);
void draw_debug(const Ui& ui);
void draw_runs(const Ui& ui);
/// Transport, stages and track of the timeline; with Run where the settings have no panel of their own.
void draw_timeline(const Ui& ui, const Rect& rect, bool folded);
/// The stages of the shown step behind what is in the line, up to `right`, in pixels.
void draw_stages(const Ui& ui, float right);
/// Goes on with a timeline that plays.
void play(const Ui& ui, float seconds);
void draw_viewport(const Ui& ui, const Rect& rect, const ViewportImage& image);
void draw_status_bar(const Ui& ui, const Rect& rect);
void draw_splitters(const Ui& ui, const Layout& layout);
void draw_help(const Ui& ui);
void draw_file_browser(const Ui& ui);
void draw_unsaved_question(const Ui& ui);

/// Shows the file browser for a purpose, at the folder that suits it.
void ask_for_file(const Ui& ui, FilePurpose purpose);
/// Opens a file, after asking what becomes of unsaved changes.
void open_file(const Ui& ui, const std::filesystem::path& path);
/// The same for a sphere.
void open_sphere(const Ui& ui, const SphereStart& sphere);
/// Carries out what a shortcut or a button asks for.
void perform(const Ui& ui, Action action);
/// The same for what moves the camera; nothing for others.
void perform_camera_action(const Ui& ui, Action action);

/// Begins a panel: a window that fills a rectangle and cannot be moved. Ends with ImGui::End().
void begin_panel(const char* name, const Rect& rect, ImGuiWindowFlags flags = 0);

/// The last run in one sentence, with how many vertices were limited by what.
[[nodiscard]] std::string describe_last_run(const model::Session& session);

}  // namespace isorelax::ui
