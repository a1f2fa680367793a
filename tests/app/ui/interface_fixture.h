#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/temporary_mesh.h"
#include "render/embedded.h"
#include "ui/interface.h"

namespace isorelax::ui {

inline FontFiles test_fonts() {
  const std::string_view font = render::embedded_file("Inter-Regular.otf");
  return {{font.data(), font.size()}, {font.data(), font.size()}};
}

/// Drives the whole interface as a person does, with neither window nor OpenGL.
class InterfaceTest : public ::testing::Test {
 protected:
  void frame() {
    const Output output = interface.frame(session, {.display = display, .scale = scale});
    for (const model::Command& command : output.commands) model::execute(session, command);
    requests.insert(requests.end(), output.requests.begin(), output.requests.end());
    model::execute(session, model::Collect{});
  }
  void settle() {
    do {
      frame();
    } while (interface.is_restless());
  }
  void settle_and_finish() {
    settle();
    model::finish(session);
    settle();
  }
  [[nodiscard]] bool shows(const std::string& name) const { return interface.state().rects.contains(name); }
  void move_to(const std::string& name) {
    ASSERT_TRUE(shows(name)) << name;
    const ImVec2 at = interface.state().rects.at(name).center();
    interface.input().push(PointerMoved{at.x, at.y});
    settle();
  }
  void click(const std::string& name) {
    move_to(name);
    interface.input().push(ButtonChanged{0, true});
    interface.input().push(ButtonChanged{0, false});
    settle_and_finish();
  }
  void press(Key key, Modifiers modifiers = {}) {
    interface.input().push(KeyChanged{key, true, modifiers});
    interface.input().push(KeyChanged{key, false, {}});
    settle_and_finish();
  }
  void type(const std::string& text) {
    interface.input().push(TextTyped{text});
    settle();
  }
  void open(std::size_t triangles = 400) {
    model::execute(session, model::OpenFile{folder.make_square(triangles)});
    model::finish(session);
    settle();
  }
  template <typename R>
  [[nodiscard]] bool requested() const {
    return std::ranges::any_of(requests, [](const Request& r) { return std::holds_alternative<R>(r); });
  }

  test::TemporaryFolder folder;
  model::Session session;
  Interface interface { test_fonts() };
  std::vector<Request> requests;
  ImVec2 display{1280, 720};
  float scale = 1;
};

}  // namespace isorelax::ui
