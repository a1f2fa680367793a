#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "app/editor/editor_fixture.h"

namespace isorelax::editor {
namespace {

/// Pixels of exactly this colour.
std::size_t count_color(const render::Image& image, ImU32 color) {
  const std::array<std::uint8_t, 3> wanted{static_cast<std::uint8_t>(color >> IM_COL32_R_SHIFT),
                                           static_cast<std::uint8_t>(color >> IM_COL32_G_SHIFT),
                                           static_cast<std::uint8_t>(color >> IM_COL32_B_SHIFT)};
  std::size_t count = 0;
  for (std::size_t k = 0; k < image.pixels.size(); k += 4)
    if (std::equal(wanted.begin(), wanted.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(k)))
      ++count;
  return count;
}

/// The debugger as a person uses it: by keys, clicks and pictures.
class DebuggerTest : public EditorTest {
 protected:
  DebuggerTest() { tick = 0.2; }  // nothing here depends on how long tooltips wait
  void open_and_run(unsigned iterations = 12) {
    open(folder.make_square());
    editor.session().smoothing.iterations = iterations;
    editor.session().smoothing.tolerance = 0;
    editor.session().smoothing.solver = Solver::newton;  // its first step is cut back
    press(ui::Key::space);
  }
  [[nodiscard]] model::Session& session() { return editor.session(); }
  [[nodiscard]] const model::Cursor& cursor() { return editor.session().timeline.cursor; }
};

TEST_F(DebuggerTest, KeysGoThroughTheTimeline) {
  open_and_run();
  EXPECT_EQ(cursor().iteration, 12U);
  const render::Image end = part("viewport");
  press(ui::Key::left);
  EXPECT_EQ(cursor().iteration, 11U);
  press(ui::Key::home);
  EXPECT_EQ(cursor().iteration, 0U);
  EXPECT_FALSE(part("viewport") == end);
  press(ui::Key::right);
  EXPECT_EQ(cursor().iteration, 1U);
  EXPECT_EQ(session().timeline.last(), 12U) << "what is recorded is not run again";
  press(ui::Key::end);
  EXPECT_EQ(cursor().iteration, 12U);
  EXPECT_TRUE(part("viewport") == end);
  keep("timeline");
}

TEST_F(DebuggerTest, DraggingOverTheTrackScrubs) {
  open_and_run();
  const ui::Rect track = editor.interface().state().rects.at("track");
  auto& input = editor.interface().input();
  input.push(ui::PointerMoved{track.low.x + 0.5F * track.width(), track.center().y});
  settle();
  input.push(ui::ButtonChanged{0, true});
  settle();
  EXPECT_EQ(cursor().iteration, 6U);
  input.push(ui::PointerMoved{track.low.x, track.center().y});
  settle();
  EXPECT_EQ(cursor().iteration, 0U);
  input.push(ui::ButtonChanged{0, false});
  settle();
  EXPECT_EQ(session().current->iteration, 0U);
}

TEST_F(DebuggerTest, ItPlaysBothWaysAndHaltsAtTheEnds) {
  open_and_run();
  click("play");
  for (int k = 0; k < 2000 && editor.interface().state().playing.direction != 0; ++k) frames(1);
  EXPECT_EQ(cursor().iteration, 12U) << "from the end it starts over";
  click("play-back");
  for (int k = 0; k < 2000 && editor.interface().state().playing.direction != 0; ++k) frames(1);
  EXPECT_EQ(cursor().iteration, 0U);
}

TEST_F(DebuggerTest, EveryStageIsDrawn) {
  open_and_run();
  press(ui::Key::home);
  press(ui::Key::right);
  std::vector<render::Image> pictures{part("viewport")};
  for (const char* stage :
       {"stage/Gradient", "stage/Tangent", "stage/Proposed", "stage/Control", "stage/Moved"}) {
    click(stage);
    for (const render::Image& other : pictures) EXPECT_FALSE(other == part("viewport")) << stage;
    pictures.push_back(part("viewport"));
    keep(std::string("stage_") + (stage + 6));
  }
  press(ui::Key::escape);
  EXPECT_FALSE(cursor().stage);
}

TEST_F(DebuggerTest, AClickOnTheMeshInspectsWhatIsThere) {
  open_and_run(3);
  click("viewport");
  EXPECT_TRUE(session().selected_vertex || session().selected_triangle);
  EXPECT_EQ(editor.interface().state().tab, ui::SideTab::inspect);
  EXPECT_TRUE(editor.interface().state().rects.contains("inspected"));
  press(ui::Key::escape);
  EXPECT_FALSE(session().selected_vertex || session().selected_triangle);
}

TEST_F(DebuggerTest, AVertexSaysWhyItMoved) {
  open_and_run(3);
  press(ui::Key::i);
  click("inspect-id");
  type("130");
  press(ui::Key::enter);
  ASSERT_EQ(session().selected_vertex, 130U);
  EXPECT_TRUE(editor.interface().state().rects.contains("why"));
  EXPECT_TRUE(editor.interface().state().rects.contains("ring"));
  EXPECT_TRUE(editor.interface().state().rects.contains("check/shares"));
  keep("inspect_vertex");
}

TEST_F(DebuggerTest, ATriangleShowsItsReferenceAndItsCorners) {
  open_and_run(3);
  press(ui::Key::n);
  press(ui::Key::i);
  ASSERT_TRUE(session().selected_triangle);
  EXPECT_TRUE(editor.interface().state().rects.contains("triangles"));
  keep("inspect_triangle");
  click("corner/1");
  EXPECT_TRUE(session().selected_vertex) << "a corner is a link";
}

TEST_F(DebuggerTest, ReasonsAreColoursAndCountsThatCanBeClicked) {
  open_and_run(3);
  press(ui::Key::home);
  press(ui::Key::right);
  const render::Image plain = part("viewport");
  press(ui::Key::b);
  click("reasons");
  const render::Image all = part("viewport");
  EXPECT_FALSE(all == plain);
  keep("reasons");
  EXPECT_TRUE(editor.interface().state().rects.contains("gradient-check"));
  click("reason/boundary");
  EXPECT_EQ(session().selected_limit, 3U);
  EXPECT_FALSE(part("viewport") == all);
}

TEST_F(DebuggerTest, DotsComeWithTheirMeaningInPicturesToo) {
  open_and_run();
  press(ui::Key::r);
  const auto lower_left = [](const render::Image& image) {
    std::size_t count = 0;
    for (int y = image.height / 2; y < image.height; ++y)
      for (int x = 14; x < 40; ++x)
        if (image.at(x, y)[2] > 200 && image.at(x, y)[0] < 100) ++count;
    return count;
  };
  EXPECT_GT(lower_left(part("viewport")), 20U) << "the blue of the boundary";
  keep("reasons_key");
  editor.ask(ui::SavePicture{folder / "dots.png"});
  EXPECT_GT(lower_left(render::read_png(folder / "dots.png")), 20U);
  editor.interface().state().comparison.mode = ui::CompareMode::split;
  settle();
  EXPECT_GT(lower_left(part("viewport")), 20U) << "in the left part, too, where the other picture is";
  editor.interface().state().comparison.mode = ui::CompareMode::off;
  press(ui::Key::r);
  EXPECT_EQ(lower_left(part("viewport")), 0U);
}

TEST_F(DebuggerTest, ABreakpointIsTypedShownAndObeyed) {
  open(folder.make_square());
  press(ui::Key::b);
  click("predicate");
  type("iteration = 2");
  EXPECT_TRUE(editor.interface().state().rects.contains("mistake"));
  keep("breakpoint_mistake");
  press(ui::Key::enter);
  EXPECT_EQ(editor.interface().state().focused, "predicate");
  press(ui::Key::m);
  EXPECT_EQ(session().task, model::Task::smooth) << "the field still has the keyboard";
  click("add-break");
  EXPECT_EQ(editor.interface().state().focused, "predicate");
  EXPECT_TRUE(session().breakpoints.empty());
  type("iteration == 2");
  EXPECT_FALSE(editor.interface().state().rects.contains("mistake"));
  press(ui::Key::enter);
  ASSERT_EQ(session().breakpoints.size(), 1U);
  press(ui::Key::escape);
  press(ui::Key::space);
  EXPECT_EQ(session().current->iteration, 2U);
  EXPECT_EQ(session().broken_by, "iteration == 2");
  keep("breakpoint");
}

TEST_F(DebuggerTest, ThePictureOfAVertexTurnsWithTheCamera) {
  open(folder.make_square());
  editor.session().smoothing.iterations = 3;
  press(ui::Key::space);
  editor.act(model::SelectVertex{130});
  press(ui::Key::i);
  const render::Image before = part("ring");
  press(ui::Key::left, {.control = true});
  EXPECT_FALSE(part("ring") == before);
  press(ui::Key::right, {.control = true});
  EXPECT_TRUE(part("ring") == before);
}

TEST_F(DebuggerTest, RunsStandSideBySide) {
  open(folder.make_square());
  editor.session().smoothing.iterations = 4;
  editor.session().smoothing.tolerance = 0;
  press(ui::Key::t);
  click("teach");
  EXPECT_TRUE(editor.interface().state().rects.contains("view/2"));
  keep("three_methods");
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(count_color(part("view/" + std::to_string(k)), ui::color::kBranches[k]), 40U)
        << "views stand in the order of the runs, the name of " << k << " has the colour of its run";
  }
  press(ui::Key::home);
  keep("three_methods_start");
}

}  // namespace
}  // namespace isorelax::editor
