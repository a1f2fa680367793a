#include <gtest/gtest.h>

#include <fstream>

#include "app/editor/editor_fixture.h"
#include "editor/screenshot.h"
#include "editor/script.h"
#include "editor/script_words.h"
#include "mesh/error.h"

namespace isorelax::editor {
namespace {

class ScriptTest : public EditorTest {
 protected:
  ScriptTest() { tick = 0.2; }
  [[nodiscard]] ScriptResult play(const std::string& text, const std::string& name = "a.script") const {
    std::ofstream(folder / name) << text;
    return run_script({.file = folder / name, .pictures = {}, .size = kSize, .scale = 1});
  }
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      (void)play(text);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(ScriptTest, AScriptOpensRunsLooksAndDrawsWhatItSees) {
  (void)folder.make_square();
  const ScriptResult result = play(R"(# a session
open square.off
set --mu 0.25 --tolerance 0
run 5
seek 2
vertex 130   # why did it move?
tab inspect
screenshot one.png
stage tangent
screenshot two.png
key Shift+Right
click stage/Moved
screenshot three.png
expect iteration == 2 && vertex(130).alpha > 0
expect moved > 0
)");
  EXPECT_TRUE(result.failures.empty()) << result.failures.front();
  ASSERT_EQ(result.pictures.size(), 3U);
  const render::Image one = render::read_png(result.pictures[0]);
  EXPECT_EQ(one.width, kSize.width);
  EXPECT_FALSE(one == render::read_png(result.pictures[1]));
  EXPECT_FALSE(render::read_png(result.pictures[1]) == render::read_png(result.pictures[2]));
}

TEST_F(ScriptTest, AnExpectationThatDoesNotHoldIsToldWithItsLine) {
  (void)folder.make_square();
  const ScriptResult result = play("open square.off\nstep\nexpect iteration == 2\nexpect iteration == 1\n");
  ASSERT_EQ(result.failures.size(), 1U);
  EXPECT_NE(result.failures[0].find("line 3"), std::string::npos) << result.failures[0];
}

TEST_F(ScriptTest, MistakesAreRefusedWithTheirLine) {
  (void)folder.make_square();
  EXPECT_NE(complaint("open square.off\njump\n").find("line 2: \"jump\""), std::string::npos);
  EXPECT_NE(complaint("seek\n").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("\nopen missing.off\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("click nowhere\n").find("nowhere"), std::string::npos);
  EXPECT_NE(complaint("break min_angle <\n").find("column"), std::string::npos);
  EXPECT_NE(complaint("open 'square.off\n").find("quote"), std::string::npos);
  EXPECT_THROW((void)run_script({.file = folder / "none.script", .pictures = {}, .size = kSize, .scale = 1}),
               InputError);
}

TEST_F(ScriptTest, ASizeThatIsTooSmallIsRefusedWithTheSmallest) {
  (void)folder.make_square();
  for (const char* size : {"40x40", "159x120", "160x119", "1x1"})
    EXPECT_NE(complaint("open square.off\nsize " + std::string(size) + "\n").find("smallest size is 160x120"),
              std::string::npos)
        << size;
  EXPECT_EQ(complaint("open square.off\nsize 160x120\ntab inspect\nvertex 3\nscreenshot a.png\n"), "");
  EXPECT_THROW((void)take_screenshot({.file = {}, .size = {100, 48}}), UsageError);
  // A window manager may make a window smaller than it is allowed to be.
  for (const render::PictureSize size : {render::PictureSize{1, 1}, {120, 60}, {640, 78}})
    editor.frame({.size = size, .scale = 1, .time = time += tick});
}

TEST_F(ScriptTest, WhatWasDoneByHandIsWrittenDownAndDoneAgain) {
  editor.act(model::OpenFile{folder.make_square()});
  settle();
  model::SmoothingSettings settings = editor.session().smoothing;
  settings.tolerance = 0;
  settings.iterations = 6;
  settings.mu_a = 0.3;
  editor.act(model::SetSmoothing{settings, "mu"});
  press(ui::Key::space);
  press(ui::Key::left);
  press(ui::Key::left);
  press(ui::Key::n);
  press(ui::Key::i);
  move_to("viewport");
  const std::string script = editor.script();
  EXPECT_NE(script.find("run 6"), std::string::npos) << script;
  EXPECT_NE(script.find("--mu 0.3"), std::string::npos) << script;
  EXPECT_NE(script.find("next-worst"), std::string::npos) << script;
  const render::Image mine = part("viewport");  // before another context is made current
  const ScriptResult again = play(script, "again.script");
  ASSERT_EQ(again.pictures.size(), 1U);
  const render::Image whole = render::read_png(again.pictures[0]);
  const ui::Rect at = editor.interface().state().rects.at("viewport");
  render::Image theirs(mine.width, mine.height);
  for (int y = 0; y < mine.height; ++y)
    for (int x = 0; x < mine.width; ++x)
      std::ranges::copy(whole.at(x + static_cast<int>(at.low.x), y + static_cast<int>(at.low.y)),
                        theirs.at(x, y).begin());
  EXPECT_TRUE(theirs == mine) << script;
}

TEST(ScriptWords, QuotesAndCommentsAreUnderstood) {
  EXPECT_EQ(split_words("  open 'a b.off'  # c"), (std::vector<std::string>{"open", "a b.off"}));
  EXPECT_EQ(split_words("a\"b c\"d"), (std::vector<std::string>{"ab cd"}));
  EXPECT_TRUE(split_words("# nothing").empty());
  EXPECT_EQ(split_words(quote_word("it's #1")), (std::vector<std::string>{"it's #1"}));
}

TEST(ScriptWords, CommandsReadBackAsTheyWere) {
  model::Session session;
  for (const model::Command& command : std::vector<model::Command>{
           model::Seek{7, 2U}, model::Seek{3, {}},
           model::SetStage{model::Stage{model::StageKind::control, 3}}, model::SetStage{},
           model::StepStage{-1}, model::SelectVertex{9}, model::SelectLimited{4U}, model::SelectLimited{},
           model::SetWorstBy{model::WorstBy::shape}, model::ShowBranches{{0, 2}},
           model::SetStepBudget{std::size_t{64} << 20U}, model::TogglePin{5}, model::Teach{},
           model::Undo{}}) {
    const std::string line = to_line(command);
    const auto back = parse_line(split_words(line), session, {});
    ASSERT_TRUE(back) << line;
    EXPECT_EQ(to_line(*back), line);
  }
}

}  // namespace
}  // namespace isorelax::editor
