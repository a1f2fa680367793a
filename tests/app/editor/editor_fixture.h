#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "app/temporary_mesh.h"
#include "editor/editor.h"
#include "render/offscreen.h"

namespace isorelax::editor {

inline constexpr render::PictureSize kSize{1280, 720};

/// The whole editor without a display: driven by input events, looked at as pictures.
class EditorTest : public ::testing::Test {
 protected:
  void frames(int count = 4) {
    for (int k = 0; k < count; ++k) editor.frame({.size = kSize, .scale = 1, .time = time += tick});
  }
  void settle() {
    do {
      frames(1);
    } while (editor.is_restless() || editor.session().engine.busy());
    frames(2);
  }
  void open(const std::filesystem::path& path) {
    model::execute(editor.session(), model::OpenFile{path});
    model::finish(editor.session());
    settle();
  }
  void press(ui::Key key, ui::Modifiers modifiers = {}) {
    editor.interface().input().push(ui::KeyChanged{key, true, modifiers});
    editor.interface().input().push(ui::KeyChanged{key, false, {}});
    settle();
  }
  /// Into the field that has the focus, in place of what it holds.
  void type(const std::string& text) {
    press(ui::Key::a, {.control = true});
    editor.interface().input().push(ui::TextTyped{text});
    settle();
  }
  void move_to(const std::string& name) {
    const ImVec2 at = editor.interface().state().rects.at(name).center();
    editor.interface().input().push(ui::PointerMoved{at.x, at.y});
    settle();
  }
  void click(const std::string& name) {
    move_to(name);
    editor.interface().input().push(ui::ButtonChanged{0, true});
    editor.interface().input().push(ui::ButtonChanged{0, false});
    settle();
  }
  /// The part of the last picture inside a recorded rectangle.
  [[nodiscard]] render::Image part(const std::string& name) const {
    const ui::Rect rect = const_cast<Editor&>(editor).interface().state().rects.at(name);
    const render::Image whole = editor.picture();
    render::Image image(static_cast<int>(rect.width()), static_cast<int>(rect.height()));
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        std::ranges::copy(whole.at(x + static_cast<int>(rect.low.x), y + static_cast<int>(rect.low.y)),
                          image.at(x, y).begin());
    return image;
  }
  /// Leaves the picture where a person can look at it.
  void keep(const std::string& name) const {
    const std::filesystem::path pictures = std::filesystem::path(ISORELAX_BINARY_DIR) / "editor_pictures";
    std::filesystem::create_directories(pictures);
    render::write_png(pictures / (name + ".png"), editor.picture());
  }

  test::TemporaryFolder folder;
  std::unique_ptr<render::OffscreenContext> context =
      render::OffscreenContext::create(render::ContextKind::osmesa);
  Editor editor{context->loader(), Motion::instant};
  double time = 0;
  double tick = 0.02;  ///< seconds between frames
};

}  // namespace isorelax::editor
