#pragma once

#include <filesystem>
#include <memory>

#include "ui/input.h"
#include "ui/panels.h"
#include "ui/ui_state.h"

struct ImGuiContext;
struct ImDrawData;
struct ImDrawList;

namespace isorelax::ui {

/// The whole interface: input in, commands, requests and triangles to draw out. Needs no window and no
/// OpenGL.
class Interface {
 public:
  explicit Interface(const FontFiles& fonts);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  struct FrameOptions {
    ImVec2 display{1280, 720};  ///< pixels
    float scale = 1;            ///< pixels per point
    float seconds = 1.0F / 60;  ///< since the last frame
    ViewportImage viewport{};
  };
  /// One frame. Reads the session, changes nothing in it: execute the commands that come back.
  Output frame(const model::Session& session, const FrameOptions& options);
  /// What frame() drew last.
  [[nodiscard]] const ImDrawData& draw_data() const;
  /// The pictures of the viewport with their names, without controls, over a whole display: for a picture in
  /// a file. Precondition: frame() at this scale. Good until the next call.
  const ImDrawData& compose(const model::Session& session, const FrameOptions& options);

  [[nodiscard]] InputQueue& input() { return input_; }
  [[nodiscard]] UiState& state() { return state_; }
  [[nodiscard]] const UiState& state() const { return state_; }
  /// A file was dropped on the window: asks about unsaved changes with the next frame, then opens it.
  void drop(std::filesystem::path path) { dropped_ = std::move(path); }
  /// The user asked the window to close.
  void ask_to_quit() { quit_asked_ = true; }
  /// Whether the interface has taken in all input, and nothing in it is on its way: it looks the same in the
  /// next frame, but for a blink, which never ends.
  [[nodiscard]] bool has_settled() const { return input_.empty() && settle_frames_ == 0; }
  /// Whether it wants to be drawn again without new input: something moves or waits.
  [[nodiscard]] bool is_restless() const {
    return !has_settled() || state_.comparison.mode == CompareMode::blink;
  }

  /// The font atlas as 8-bit coverage, and a number that changes whenever it does.
  struct Atlas {
    const unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    unsigned revision = 0;
  };
  Atlas atlas();
  /// Tells the interface which texture holds the atlas.
  void set_atlas_texture(ImTextureID texture);
  [[nodiscard]] ImGuiContext& context() { return *context_; }
  [[nodiscard]] ImGuiMouseCursor cursor() const;

 private:
  void prepare(const FrameOptions& options);
  void move_focus(int direction);
  void handle_keys(const Ui& ui, std::span<const KeyChanged> pressed);
  void draw(const Ui& ui, const FrameOptions& options);
  void follow_dialog();

  FontFiles font_files_;
  ImGuiContext* context_;
  Fonts fonts_;
  float scale_ = 0;
  unsigned atlas_revision_ = 0;
  InputQueue input_;
  UiState state_;
  std::filesystem::path dropped_;
  bool quit_asked_ = false;
  int settle_frames_ = 0;
  bool dialog_shown_ = false;
  bool had_focus_ = false;  ///< a control, before the dialog opened
  std::unique_ptr<ImDrawList> composed_;
  ImDrawList* composed_list_ = nullptr;
  std::unique_ptr<ImDrawData> composed_data_;
};

}  // namespace isorelax::ui
