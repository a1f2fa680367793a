#include "ui/interface.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

// Keys that move between or work on controls, and are shortcuts while no control has the focus.
bool drives_controls(const KeyChanged& press) {
  constexpr std::array kKeys{Key::left,  Key::right, Key::up,   Key::down,
                             Key::space, Key::enter, Key::home, Key::end};
  return !press.modifiers.control && std::ranges::find(kKeys, press.key) != kKeys.end();
}

// Left and right among choices side by side: the step; else 0.
int segment_step(const KeyChanged& press) {
  if (press.modifiers != Modifiers{}) return 0;
  return press.key == Key::right ? 1 : press.key == Key::left ? -1 : 0;
}

bool dialog_open() {
  return ImGui::GetCurrentContext()->OpenPopupStack.Size > 0;
}

bool is_text_shortcut(const KeyChanged& press) {
  constexpr std::array kKeys{Key::a, Key::c,    Key::v,     Key::x,  Key::z,
                             Key::y, Key::left, Key::right, Key::up, Key::down};
  return !press.modifiers.control || std::ranges::find(kKeys, press.key) != kKeys.end();
}

}  // namespace

Interface::Interface(const FontFiles& fonts) : font_files_(fonts), context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
  map_keys(io);
}

Interface::~Interface() {
  ImGui::DestroyContext(context_);
}

void Interface::prepare(const FrameOptions& options) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  if (scale_ != options.scale) {
    scale_ = options.scale;
    apply_theme(scale_);
    fonts_ = load_fonts(*io.Fonts, font_files_, scale_);
    ++atlas_revision_;
  }
  io.DisplaySize = options.display;
  io.DeltaTime = std::max(1e-4F, options.seconds);
}

Output Interface::frame(const model::Session& session, const FrameOptions& options) {
  prepare(options);
  ImGuiIO& io = ImGui::GetIO();
  const bool had_input = !input_.empty();
  Output output;
  const Ui ui{session, state_, output, fonts_, scale_};
  // Shortcuts are kept from Dear ImGui, unless a control or a dialog has a use for the key.
  const auto pressed = input_.next_frame(io, [&](const KeyChanged& press) {
    if (press.key == Key::tab) return true;
    if (dialog_open()) return false;
    if (io.WantTextInput) return !is_text_shortcut(press);
    if (state_.segment_focused && segment_step(press) != 0) return true;
    if (!state_.focused.empty() && drives_controls(press)) return false;
    return find_shortcut(press) != nullptr;
  });
  const bool text_before = io.WantTextInput;
  // Space alone presses buttons in Dear ImGui; Enter begins typing in the fields that have a use for it.
  if (!text_before && io.KeysDown[static_cast<std::size_t>(Key::enter)])
    io.NavInputs[ImGuiNavInput_Activate] = 1;
  state_.focus_request = std::exchange(state_.next_focus, {});
  state_.segment_step = 0;
  ImGui::NewFrame();
  for (const KeyChanged& press : pressed) {
    if (press.key == Key::tab) move_focus(press.modifiers.shift ? -1 : 1);
    if (state_.segment_focused && !dialog_open()) state_.segment_step += segment_step(press);
  }
  if (!dialog_open()) {
    std::vector<KeyChanged> usable;
    std::ranges::copy_if(pressed, std::back_inserter(usable), [&](const KeyChanged& press) {
      if (text_before) return !is_text_shortcut(press);
      return state_.focused.empty() || !drives_controls(press);
    });
    handle_keys(ui, usable);
  }
  draw(ui, options);
  follow_dialog();
  ImGui::Render();
  // Dear ImGui settles hover, focus and sizes within two frames of an input.
  settle_frames_ = had_input ? 2 : std::max(0, settle_frames_ - 1);
  if (state_.playing.direction != 0) settle_frames_ = std::max(1, settle_frames_);
  // A tooltip waits for its time to come, which only frames let pass.
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.HoveredId != 0 && context.HoveredIdTimer < 2 * kTooltipDelay)
    settle_frames_ = std::max(1, settle_frames_);
  return output;
}

void Interface::handle_keys(const Ui& ui, std::span<const KeyChanged> pressed) {
  for (const KeyChanged& press : pressed) {
    if (press.key == Key::escape) {
      state_.focused.clear();
      ImGui::SetWindowFocus(nullptr);
      state_.playing.direction = 0;
      const model::Session& s = ui.session;
      if (const model::Message* message = notice(state_, s))
        state_.dismissed_message = message->number;
      else if (s.selected_triangle || s.selected_vertex || s.selected_limit)
        ui.command(model::ClearSelection{});
      else if (s.timeline.cursor.stage)
        ui.command(model::SetStage{});
    }
    if (const Shortcut* shortcut = find_shortcut(press)) perform(ui, shortcut->action);
  }
}

// Dear ImGui gives the keyboard to some control when a dialog closes; where none had it before, keys are the
// viewport's again.
void Interface::follow_dialog() {
  const bool open = dialog_open();
  if (open && !dialog_shown_) had_focus_ = !state_.focused.empty();
  if (!open && dialog_shown_ && !had_focus_) {
    state_.focused.clear();
    ImGui::SetWindowFocus(nullptr);
    ImGui::GetCurrentContext()->NavDisableHighlight = true;
  }
  dialog_shown_ = open;
}

void Interface::move_focus(int direction) {
  // In a dialog only what the dialog drew last can be reached: it comes after the panels.
  const auto& stops = state_.stops;
  if (stops.empty()) return;
  const auto found = std::ranges::find(stops, state_.focused);
  const int count = static_cast<int>(stops.size());
  int next = direction > 0 ? 0 : count - 1;
  if (found != stops.end()) next = (static_cast<int>(found - stops.begin()) + direction + count) % count;
  state_.focus_request = stops[static_cast<std::size_t>(next)];
}

void Interface::draw(const Ui& ui, const FrameOptions& options) {
  if (!dropped_.empty()) open_file(ui, std::exchange(dropped_, {}));
  if (std::exchange(quit_asked_, false)) perform(ui, Action::quit);
  const std::string focused = state_.focused;
  state_.rects.clear();
  state_.stops.clear();
  state_.focused.clear();
  state_.segment_focused = false;
  state_.has_mesh = ui.session.current != nullptr;
  const Layout layout = make_layout(state_, options.display, scale_);
  play(ui, options.seconds);
  draw_viewport(ui, layout.viewport, options.viewport);
  if (!state_.panels_hidden) {
    draw_top_bar(ui, layout.top);
    if (!layout.folded) draw_settings_panel(ui, layout.left);
    draw_side_panel(ui, layout.right, layout.folded);
    if (layout.timeline.height() > 0) draw_timeline(ui, layout.timeline, layout.folded);
    draw_status_bar(ui, layout.status);
    draw_splitters(ui, layout);
  }
  if (dialog_open()) state_.stops.clear();
  draw_file_browser(ui);
  draw_help(ui);
  draw_unsaved_question(ui);
}

const ImDrawData& Interface::draw_data() const {
  ImGui::SetCurrentContext(context_);
  return *ImGui::GetDrawData();
}

const ImDrawData& Interface::compose(const model::Session& session, const FrameOptions& options) {
  ImGui::SetCurrentContext(context_);
  composed_ = std::make_unique<ImDrawList>(ImGui::GetDrawListSharedData());
  composed_->_ResetForNewFrame();
  const Rect all{{0, 0}, options.display};
  composed_->PushClipRect(all.low, all.high);
  composed_->PushTextureID(ImGui::GetIO().Fonts->TexID);
  composed_->AddRectFilled(all.low, all.high, color::kBackdrop);
  // What it notes of places, and of time for a blink, is not the window's.
  UiState state = state_;
  state.comparison.blink_seconds = 0;
  Output nothing;
  draw_pictures({session, state, nothing, fonts_, scale_}, *composed_, all, options.viewport);
  composed_data_ = std::make_unique<ImDrawData>();
  composed_list_ = composed_.get();
  composed_data_->CmdLists = &composed_list_;
  composed_data_->CmdListsCount = 1;
  return *composed_data_;
}

Interface::Atlas Interface::atlas() {
  ImGui::SetCurrentContext(context_);
  Atlas atlas;
  unsigned char* pixels = nullptr;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &atlas.width, &atlas.height);
  atlas.pixels = pixels;
  atlas.revision = atlas_revision_;
  return atlas;
}

void Interface::set_atlas_texture(ImTextureID texture) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().Fonts->SetTexID(texture);
}

ImGuiMouseCursor Interface::cursor() const {
  ImGui::SetCurrentContext(context_);
  return ImGui::GetMouseCursor();
}

}  // namespace isorelax::ui
