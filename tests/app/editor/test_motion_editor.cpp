#include <gtest/gtest.h>

#include <fstream>

#include "app/editor/editor_fixture.h"
#include "editor/script.h"
#include "editor/script_words.h"
#include "mesh/error.h"
#include "support/golden.h"

namespace isorelax::editor {
namespace {

using render::Image;

/// The panel that moves surfaces, driven as a person does.
class MotionEditorTest : public EditorTest {
 protected:
  MotionEditorTest() { tick = 0.2; }
  void act(const std::string& line) {
    editor.act(*parse_line(split_words(line), editor.session(), folder / ""));
    model::finish(editor.session());
    settle();
  }
  [[nodiscard]] const model::Session& session() { return editor.session(); }
  [[nodiscard]] bool shows(const std::string& name) {
    return editor.interface().state().rects.contains(name);
  }
  void show_sphere() { act("motion sphere 300"); }
};

TEST_F(MotionEditorTest, AFewKeysAndClicksMoveTheOpenMeshAndGoThroughItsTime) {
  open(folder.make_square());
  press(ui::Key::m);
  EXPECT_EQ(session().task, model::Task::move);
  EXPECT_EQ(session().view.coloring, model::Coloring::relative_area);
  act("motion field shear step 0.25");
  const Image start = part("viewport");
  press(ui::Key::space);
  EXPECT_EQ(session().current->iteration, 4U);
  ASSERT_NE(session().moving(), nullptr);
  EXPECT_DOUBLE_EQ(session().moment().time, 1);
  const Image end = part("viewport");
  EXPECT_FALSE(start == end);
  for (const char* plot : {"motion-angles", "motion-share", "motion-areas", "motion-off"})
    EXPECT_TRUE(shows(plot)) << plot;
  EXPECT_FALSE(shows("stage/Gradient")) << "its steps have no stages";
  press(ui::Key::left);
  press(ui::Key::left);
  EXPECT_DOUBLE_EQ(session().moment().time, 0.5);
  press(ui::Key::right);
  EXPECT_DOUBLE_EQ(session().moment().time, 0.75);
  press(ui::Key::home);
  EXPECT_EQ(session().current->geometry, session().original->geometry);
  press(ui::Key::end);
  EXPECT_TRUE(part("viewport") == end);
  press(ui::Key::p, {.shift = true});
  EXPECT_EQ(session().current->iteration, 0U) << "it played back to the start";
}

TEST_F(MotionEditorTest, ATriangleAndAVertexAreInspectedAtAnyTime) {
  show_sphere();
  act("motion field paper:0.6 step 0.1");
  act("motion run 4");
  act("vertex 17");
  press(ui::Key::i);
  EXPECT_TRUE(shows("moving/motion"));
  EXPECT_TRUE(shows("way-plot"));
  EXPECT_FALSE(shows("move/alpha")) << "what a smoother knows";
  const Image at_four = part("moving/after");
  press(ui::Key::left);
  EXPECT_FALSE(part("moving/after") == at_four);
  act("triangle 5");
  EXPECT_TRUE(shows("triangle/ratio"));
  EXPECT_TRUE(shows("triangle/area-start"));
}

TEST_F(MotionEditorTest, WhatWasDoneByHandIsWrittenDownAndDoneAgain) {
  show_sphere();
  act("motion field paper:0.6 step 0.1 preset accuracy");
  press(ui::Key::space);
  press(ui::Key::left);
  press(ui::Key::left);
  act("motion preset none");
  press(ui::Key::right);
  press(ui::Key::right);
  const std::string script = editor.script();
  EXPECT_NE(script.find("motion sphere 300:0.15:0.5,0.75,0.5\n"), std::string::npos) << script;
  EXPECT_NE(script.find("motion defaults field paper:0.6 step 0.1 preset accuracy\nmotion run 6\ncamera "),
            std::string::npos)
      << script;
  EXPECT_NE(script.find("motion defaults field paper:0.6 step 0.1 preset none\nmotion run 1\nmotion run 1\n"),
            std::string::npos)
      << script;
  move_to("viewport");
  const Image mine = editor.picture();
  std::ofstream(folder / "a.script") << script;
  const ScriptResult again =
      run_script({.file = folder / "a.script", .pictures = {}, .size = kSize, .scale = 1});
  ASSERT_EQ(again.pictures.size(), 1U);
  const Image theirs = render::read_png(again.pictures[0]);
  const ui::Rect at = editor.interface().state().rects.at("motion-angles");
  for (int x = static_cast<int>(at.low.x); x < static_cast<int>(at.high.x); ++x)
    for (int y = static_cast<int>(at.low.y); y < static_cast<int>(at.high.y); ++y)
      ASSERT_TRUE(std::ranges::equal(theirs.at(x, y), mine.at(x, y))) << x << " " << y;
}

TEST_F(MotionEditorTest, ScriptsAreToldWhatAMotionDoesNotKnow) {
  const auto complaint = [&](const std::string& line) {
    try {
      (void)parse_line(split_words(line), session(), folder / "");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint("motion swirl 3").find("\"swirl\" is no option of a motion"), std::string::npos);
  EXPECT_NE(complaint("motion field").find("its value is missing"), std::string::npos);
  EXPECT_NE(complaint("motion field swirl").find("expected paper"), std::string::npos);
  EXPECT_NE(complaint("motion step -1").find("--step -1: expected a number over 0"), std::string::npos);
  EXPECT_NE(complaint("motion run soon").find("expected a number of steps"), std::string::npos);
  EXPECT_NE(complaint("motion sphere 2").find("--sphere 2"), std::string::npos);
  EXPECT_TRUE(complaint("motion defaults every 3 only-below 20").empty());
}

TEST_F(MotionEditorTest, AMovingSurfaceLooksAsAccepted) {
  act("motion sphere 600");
  act("motion field paper:0.9 step 0.05");
  press(ui::Key::space);
  act("seek 9");
  move_to("viewport");
  keep("moving");
  EXPECT_TRUE(test::matches_baseline(editor.picture(), "editor_moving"));
}

}  // namespace
}  // namespace isorelax::editor
