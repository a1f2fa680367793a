#include <algorithm>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

bool begin_dialog(const Ui& ui, const char* name, float width) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * display.x, 0.5F * display.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(width, display.x - ui.px(32)), 0});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, display.y - ui.px(16)});  // a low window scrolls
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(22), ui.px(18)});
  const bool open = ImGui::BeginPopupModal(name, nullptr,
                                           ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                               ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
  return open;
}

bool escape_pressed() {
  return ImGui::IsKeyPressed(static_cast<int>(Key::escape), false);
}

void draw_shortcut_group(const Ui& ui, std::string_view group) {
  text_in(ui.fonts.heading, color::kAccent, group);
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.group != group || shortcut.text.empty()) continue;
    text_in(ui.fonts.text, color::kText, shortcut.listed.empty() ? shortcut.keys : shortcut.listed);
    ImGui::SameLine(ui.px(118));
    wrapped(ui.fonts.text, color::kTextDim, shortcut.text);
  }
  ImGui::Dummy({0, ui.px(4)});
}

void draw_pointer_help(const Ui& ui) {
  constexpr std::pair<const char*, const char*> kLines[]{
      {"Click", "Inspect a vertex or a triangle"},
      {"Drag", "Orbit; a planar mesh pans"},
      {"Middle drag, Shift", "Pan"},
      {"Wheel", "Zoom to the pointer"},
      {"Tab, Shift+Tab", "To the next control and back"},
      {"Arrows, Space, Enter", "Use the control with the focus"},
      {"Left, Right", "Choose in a row of buttons"},
      {"Escape", "Leave the controls, close a dialog"},
      {"Drop a file", "Open it"},
  };
  text_in(ui.fonts.heading, color::kAccent, "Pointer and focus");
  for (const auto& [keys, text] : kLines) {
    text_in(ui.fonts.text, color::kText, keys);
    ImGui::SameLine(ui.px(150));
    wrapped(ui.fonts.text, color::kTextDim, text);
  }
}

// After the answer: what was waiting happens.
void go_on(const Ui& ui) {
  if (std::holds_alternative<PendingQuit>(ui.state.pending)) ui.request(Quit{});
  if (const auto* path = std::get_if<std::filesystem::path>(&ui.state.pending))
    ui.command(model::OpenFile{*path});
  if (const auto* sphere = std::get_if<SphereStart>(&ui.state.pending))
    ui.command(model::OpenSphere{*sphere});
  ui.state.pending = std::monostate{};
}

// Once a save that was asked for has ended well, and no name is asked for any more.
void go_on_after_save(const Ui& ui) {
  const FileBrowser& browser = ui.state.browser;
  if (!ui.state.go_on_after_save || browser.wanted || browser.open || ui.session.engine.busy()) return;
  ui.state.go_on_after_save = false;
  if (ui.session.would_lose_work())
    ui.state.pending = std::monostate{};
  else
    go_on(ui);
}

}  // namespace

void draw_help(const Ui& ui) {
  if (ui.state.help_wanted) ImGui::OpenPopup("help");
  ui.state.help_wanted = false;
  if (!begin_dialog(ui, "help", ui.px(1060))) return;
  text_in(ui.fonts.title, color::kText, "Keys");
  ImGui::Dummy({0, ui.px(4)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(4)});
  ImGui::Columns(3, "keys", false);
  draw_shortcut_group(ui, "Smoothing and moving");
  draw_shortcut_group(ui, "Inspect");
  ImGui::NextColumn();
  draw_shortcut_group(ui, "View");
  ImGui::NextColumn();
  draw_shortcut_group(ui, "File and edit");
  draw_pointer_help(ui);
  ImGui::Columns(1);
  ImGui::PopStyleVar();
  mark_area(ui, "help-page",
            {ImGui::GetWindowPos(),
             {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
              ImGui::GetWindowPos().y + ImGui::GetWindowHeight()}});
  ImGui::Dummy({0, ui.px(4)});
  ImGui::SetCursorPosX(ImGui::GetWindowWidth() - ui.px(22 + 98));
  if (button(ui, "help-close", "Close", {.look = ButtonLook::accent, .width = ui.px(98)}) || escape_pressed())
    ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_unsaved_question(const Ui& ui) {
  if (ui.state.ask_unsaved) {
    ImGui::OpenPopup("unsaved");
    ui.state.next_focus = "unsaved-save";
  }
  ui.state.ask_unsaved = false;
  go_on_after_save(ui);
  if (!begin_dialog(ui, "unsaved", ui.px(440))) return;
  const bool mesh = ui.session.has_unsaved_changes();
  text_in(ui.fonts.title, color::kText, mesh ? "Keep the changed mesh?" : "Keep what was run?");
  ImGui::PushTextWrapPos(0);
  text_in(ui.fonts.text, color::kTextDim,
          mesh ? "Its positions are in no file yet. Without saving they are lost."
               : "The iterations are in no file yet: a trace keeps them. Without one they are lost.");
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, ui.px(6)});
  if (button(ui, "unsaved-cancel", "Cancel", {.width = ui.px(98)}) || escape_pressed()) {
    ui.state.pending = std::monostate{};
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine(ImGui::GetWindowWidth() - ui.px(22 + 98 + 8 + 118));
  if (button(ui, "unsaved-discard", "Do not save", {.width = ui.px(118)})) {
    go_on(ui);
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (button(ui, "unsaved-save", "Save", {.look = ButtonLook::accent, .width = ui.px(98)})) {
    ImGui::CloseCurrentPopup();
    ui.state.go_on_after_save = true;
    perform(ui, mesh ? Action::save : Action::save_trace);
  }
  ImGui::EndPopup();
}

}  // namespace isorelax::ui
