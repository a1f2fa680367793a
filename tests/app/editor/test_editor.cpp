#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/editor/editor_fixture.h"
#include "editor/screenshot.h"
#include "mesh/error.h"
#include "support/golden.h"

namespace isorelax::editor {
namespace {

using render::Image;

TEST_F(EditorTest, AStepChangesTheMeshOnScreenAndTheNumbersBesideIt) {
  open(folder.make_square());
  const Image mesh = part("viewport");
  const Image angle = part("figure/Mean smallest");
  click("step");
  EXPECT_FALSE(mesh == part("viewport"));
  EXPECT_FALSE(angle == part("figure/Mean smallest"));
  keep("step");
}

TEST_F(EditorTest, NothingChangesOnScreenWhenNothingWasDone) {
  open(folder.make_square());
  const Image before = editor.picture();
  frames(10);
  EXPECT_TRUE(before == editor.picture());
}

TEST_F(EditorTest, EachColouringLooksDifferent) {
  open(folder.make_square());
  std::vector<Image> pictures;
  for (const ui::Key key :
       {ui::Key::digit1, ui::Key::digit2, ui::Key::digit3, ui::Key::digit4, ui::Key::digit5}) {
    press(key);
    for (const Image& other : pictures) EXPECT_FALSE(other == part("viewport"));
    pictures.push_back(part("viewport"));
    keep("colouring" + std::to_string(pictures.size()));
  }
}

TEST_F(EditorTest, ReloadingKeepsTheCameraAndAnotherFileGetsItsOwn) {
  const auto path = folder.make_square();
  open(path);
  move_to("viewport");
  editor.interface().input().push(ui::WheelTurned{0, 3});
  settle();
  const render::Camera zoomed = editor.camera();
  open(path);
  EXPECT_EQ(editor.camera(), zoomed);
  open(folder.make_square(100, "other.off"));
  EXPECT_FALSE(editor.camera() == zoomed);
}

TEST_F(EditorTest, ThePictureIsSavedAsTheViewportShowsIt) {
  open(folder.make_square());
  press(ui::Key::h);
  press(ui::Key::f12);
  click("browser-accept");
  const Image saved = render::read_png(folder / "square.png");
  EXPECT_TRUE(saved == part("viewport"));
}

TEST_F(EditorTest, StatesLookAsAccepted) {
  frames();
  keep("welcome");
  EXPECT_TRUE(test::matches_baseline(editor.picture(), "editor_welcome"));
  open(folder.make_square());
  EXPECT_FALSE(test::passes_for_baseline(editor.picture(), "editor_after_run")) << "a run must be seen";
  editor.session().smoothing.iterations = 30;
  editor.session().smoothing.tolerance = 0;
  click("run");
  move_to("viewport");
  keep("after_run");
  EXPECT_TRUE(test::matches_baseline(editor.picture(), "editor_after_run"));
  press(ui::Key::question);
  keep("help");
  EXPECT_TRUE(test::matches_baseline(editor.picture(), "editor_help"));
  press(ui::Key::escape);
}

TEST_F(EditorTest, OneClickRunsAndPolishesWithinATypedDistance) {
  open(folder.make_square(100));
  click("reach/Typed");
  click("max-deviation");
  type("0.2");
  press(ui::Key::enter);
  EXPECT_EQ(editor.session().smoothing.reach, model::Reach::typed);
  EXPECT_NEAR(editor.session().smoothing.max_deviation, 0.002, 1e-12);
  click("polish/Worst");
  click("run");
  ASSERT_EQ(editor.session().timeline.branches.size(), 2U);
  EXPECT_EQ(editor.session().timeline.branches[1].kind, PartKind::polish);
  keep("polished");
}

TEST_F(EditorTest, ATooltipAppearsWhereThePointerRests) {
  open(folder.make_square());
  const Image below = part("reset");
  move_to("run");
  EXPECT_FALSE(below == part("reset"));
  keep("tooltip");
}

TEST_F(EditorTest, OtherStatesCanBeLookedAt) {
  open(folder.make_square());
  press(ui::Key::tab);
  press(ui::Key::tab);
  keep("focus");
  press(ui::Key::escape);
  press(ui::Key::n);
  keep("selection");
  press(ui::Key::right);
  press(ui::Key::o, {.control = true});
  std::ofstream(folder / "broken.off") << "OFF\n1 2\n";
  keep("browser");
  press(ui::Key::escape);
  open(folder / "broken.off");
  keep("notice");
  editor.interface().ask_to_quit();
  settle();
  keep("unsaved");
  press(ui::Key::escape);
  move_to("angle-plot");
  keep("hover");
  press(ui::Key::h);
  keep("hidden_panels");
  EXPECT_TRUE(
      std::filesystem::exists(std::filesystem::path(ISORELAX_BINARY_DIR) / "editor_pictures" / "hover.png"));
}

TEST_F(EditorTest, AtDoubleScaleEverythingIsTwiceAsLarge) {
  open(folder.make_square());
  const ui::Rect single = editor.interface().state().rects.at("run");
  for (int k = 0; k < 4; ++k) editor.frame({.size = {2560, 1440}, .scale = 2, .time = time += 0.02});
  const ui::Rect twice = editor.interface().state().rects.at("run");
  EXPECT_NEAR(twice.width(), 2 * single.width(), 2);
  EXPECT_NEAR(twice.low.y, 2 * single.low.y, 16);
  keep("scale2");
}

TEST(Screenshot, ABadFileIsAnError) {
  EXPECT_THROW((void)take_screenshot({.file = "/no/such/mesh.off"}), Error);
}

}  // namespace
}  // namespace isorelax::editor
