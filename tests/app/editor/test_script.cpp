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
  EXPECT_NE(result.failures[0].find("line 3: does not hold: iteration == 2; iteration = 1"),
            std::string::npos)
      << result.failures[0];
}

TEST_F(ScriptTest, TheMeshAsOpenedCanBeLookedAt) {
  (void)folder.make_square();
  EXPECT_TRUE(play("open square.off\nexpect iteration == 0 && min_angle > 0\n").failures.empty());
  EXPECT_EQ(play("open square.off\nexpect min_angle > 59\n").failures.size(), 1U);
}

TEST_F(ScriptTest, WhatTheEditorRefusesToDoEndsAScript) {
  const std::string moved =
      "motion sphere 300\nmotion field paper step 0.05 preset balanced\nmotion run 2\nmotion off\n";
  const std::string told = complaint(moved + "run 5\n");
  EXPECT_NE(told.find("line 5: run: Smoothing keeps to the mesh as opened"), std::string::npos) << told;
  (void)folder.make_square();
  const std::string runs = "open square.off\nset --tolerance 0\nrun 3\nseek 2\nset --boundary slide\nrun 2\n";
  EXPECT_NE(complaint(runs + "remove 1\n").find("line 7: remove: Run 2 "), std::string::npos);
  EXPECT_EQ(complaint(runs + "remove 2\nremove 1\nexpect iteration == 0\n"), "");
}

TEST_F(ScriptTest, MistakesAreRefusedWithTheirLine) {
  (void)folder.make_square();
  EXPECT_NE(complaint("open square.off\njump\n").find("line 2: \"jump\""), std::string::npos);
  EXPECT_NE(complaint("seek\n").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("\nopen missing.off\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("click nowhere\n").find("nowhere"), std::string::npos);
  EXPECT_NE(complaint("click nowhere\n").find(", welcome-open"), std::string::npos) << "what is there";
  EXPECT_NE(complaint("break min_angle <\n").find("column"), std::string::npos);
  for (const char* line : {"expect vertex(99999).x > 0", "break vertex(99999).x > 0"})
    EXPECT_NE(
        complaint("open square.off\n" + std::string(line)).find("line 2: vertex(99999).x > 0: column 8"),
        std::string::npos);
  EXPECT_NE(complaint("open 'square.off\n").find("quote"), std::string::npos);
  for (const char* wrong : {"run 2 3", "frame 1", "no-breaks 1", "next-stage 2", "tab runs 1",
                            "camera iso top", "show split original 1", "screenshot a.png b.png"}) {
    const std::string told = complaint("open square.off\n" + std::string(wrong) + "\n");
    EXPECT_NE(told.find("a.script: line 2: "), std::string::npos) << wrong << ": " << told;
  }
  EXPECT_THROW((void)run_script({.file = folder / "none.script", .pictures = {}, .size = kSize, .scale = 1}),
               InputError);
}

TEST_F(ScriptTest, WhatIsNotThereIsRefusedWithItsLine) {
  (void)folder.make_square();
  const std::string open = "open square.off\nset --tolerance 0\nrun 3\n";
  for (const char* wrong :
       {"view range=banana", "view range=30:0", "view range=", "vertex 99999", "triangle 99999", "pin 99999",
        "seek 4", "seek 0 2", "seek 0 0", "beside 2", "compare 1 2", "remove 2"})
    EXPECT_NE(complaint(open + wrong + "\n").find("a.script: line 4: "), std::string::npos) << wrong;
  EXPECT_EQ(complaint(open + "seek 3\nseek 0\nview range=current\n"), "");
  EXPECT_NE(complaint("vertex 0\n").find("none at all"), std::string::npos);
  EXPECT_NE(complaint("run 5\n").find("no mesh is open"), std::string::npos);
  EXPECT_NE(complaint("screenshot a.jpg\n").find(".png"), std::string::npos);
  EXPECT_NE(complaint(open + "stage control 99\n").find("line 4: stage: there is no round 99"),
            std::string::npos);
  EXPECT_NE(complaint(open + "stage moved 1\n").find("only control"), std::string::npos);
  EXPECT_THROW((void)play(open + "set --mu 7\n"), UsageError);
  const std::string settings = complaint(open + "set --mu banana\n");
  EXPECT_NE(settings.find("--mu banana"), std::string::npos) << settings;
}

TEST_F(ScriptTest, MistakesAndWhatCannotBeWrittenAreErrorsOfTheirKinds) {
  (void)folder.make_square();
  EXPECT_THROW((void)play("jump\n"), UsageError);
  EXPECT_THROW((void)play("open missing.off\n"), InputError);
  for (const char* writer : {"save none/a.off", "screenshot none/a.png", "picture none/a.png"}) {
    const std::string text = "open square.off\n" + std::string(writer) + "\n";
    EXPECT_THROW((void)play(text), OutputError) << writer;
    EXPECT_NE(complaint(text).find("a.script: line 2: "), std::string::npos) << complaint(text);
  }
}

TEST_F(ScriptTest, AMotionHasNoTraceToSave) {
  (void)folder.make_square();
  const std::string told =
      complaint("open square.off\nmotion field shear\nmotion run 2\nsave-trace a.trace\n");
  EXPECT_NE(told.find("a.script: line 4: save-trace: A motion has no trace"), std::string::npos) << told;
}

TEST_F(ScriptTest, ATypedRangeIsWrittenDownAndRead) {
  editor.act(model::OpenFile{folder.make_square()});
  settle();
  model::ViewSettings view = editor.session().view;
  view.coloring = model::Coloring::relative_area;
  view.range_mode = model::RangeMode::typed;
  view.typed[3] = {0.25, 1.75};
  EXPECT_NE(to_line(model::SetView{view}).find("range=0.25:1.75"), std::string::npos);
  const std::vector<std::string> words = split_words(to_line(model::SetView{view}));
  const auto read = parse_line(words, editor.session(), {});
  ASSERT_TRUE(read);
  EXPECT_EQ(std::get<model::SetView>(*read).view, view);
}

TEST_F(ScriptTest, AVertexOutOfSightIsFlownToAndInspected) {
  (void)write_mesh(folder / "ball.ply", generate(ShapeKind::sphere, {}));
  const std::string look = "open ball.ply\nstep\ncamera back\n";
  const auto pictures = play(look + "screenshot far.png\nvertex 0\nscreenshot why.png\n").pictures;
  const auto typed = play(look + "tab inspect\nvertex 0\nfly\nscreenshot typed.png\n", "b.script").pictures;
  EXPECT_FALSE(render::read_png(pictures[0]) == render::read_png(pictures[1]));
  EXPECT_TRUE(render::read_png(typed[0]) == render::read_png(pictures[1]));
  // One that is seen is only inspected.
  context->make_current();
  open(folder / "ball.ply");
  editor.look("front");
  const auto& x = editor.session().current->positions();
  Index nearest = 0;
  for (Index v = 0; v < x.size(); ++v)
    if (x[v].z() > x[nearest].z()) nearest = v;
  model::execute(editor.session(), model::SelectVertex{nearest});
  EXPECT_TRUE(editor.sees_selection());
  editor.look("back");
  EXPECT_FALSE(editor.sees_selection());
}

TEST_F(ScriptTest, AReferenceIsTakenFromTheScriptsFolderAndPicturesHaveTheirFolderMade) {
  (void)folder.make_square();
  std::ofstream(folder / "a.script")
      << "open square.off\nset --reference square.off\nstep\nscreenshot a.png\n";
  const ScriptResult result = run_script(
      {.file = folder / "a.script", .pictures = folder / "new" / "one", .size = kSize, .scale = 1});
  ASSERT_EQ(result.pictures.size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder / "new" / "one" / "a.png"));
}

TEST_F(ScriptTest, HelpListsEveryCommand) {
  for (const char* word : {"step-back", "range=run|current|LO:HI"})
    EXPECT_NE(script_reference().find(word), std::string::npos) << word;
}

TEST_F(ScriptTest, ASizeThatIsTooSmallIsRefusedWithTheSmallest) {
  (void)folder.make_square();
  for (const char* size : {"40x40", "159x120", "160x119", "1x1"})
    EXPECT_NE(complaint("open square.off\nsize " + std::string(size) + "\n").find("smallest size is 160x120"),
              std::string::npos)
        << size;
  EXPECT_EQ(complaint("open square.off\nsize 160x120\ntab inspect\nvertex 3\nscreenshot a.png\n"), "");
  EXPECT_THROW((void)take_screenshot({.file = {}, .size = {100, 48}}), UsageError);
  context->make_current();
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

TEST_F(ScriptTest, SettingsAreWrittenDownWhateverWasSetBefore) {
  model::Session session;
  session.smoothing.method = model::Method::laplacian;
  session.smoothing.polish = model::Polish::both;
  session.smoothing.pinned = {3, 5};
  session.smoothing.mu_a = 0.5;
  model::SmoothingSettings other;
  other.method = model::Method::angle_based;
  other.mu_a = 0.25;  // the energy is measured with it
  other.iterations = 7;
  for (const model::SmoothingSettings& settings : {model::SmoothingSettings{}, other}) {
    const std::string line = to_line(model::SetSmoothing{settings, ""});
    const auto read = parse_line(split_words(line), session, {});
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(std::get<model::SetSmoothing>(*read).settings, settings) << line;
  }
  // One that a person writes changes only what it names.
  const auto part = parse_line(split_words("set --mu 1"), session, {});
  EXPECT_EQ(std::get<model::SetSmoothing>(*part).settings.pinned, session.smoothing.pinned);
}

TEST_F(ScriptTest, AScriptThatWasWrittenDownBeginsWithTheSizeAndTheWholeNameOfTheMesh) {
  const std::filesystem::path file = std::filesystem::relative(folder.make_square());
  ASSERT_TRUE(file.is_relative());
  editor.act(model::OpenFile{file});
  settle();
  editor.frame({.size = {1600, 1000}, .scale = 2, .time = time += tick});
  const std::string script = editor.script();
  EXPECT_NE(script.find("\nsize 800x500\n"), std::string::npos) << script;
  EXPECT_NE(script.find("\nopen " + (folder / "square.off").string() + "\n"), std::string::npos) << script;
  EXPECT_LT(script.find("\nsize "), script.find("\nopen ")) << script;
  EXPECT_TRUE(play(script, "far.script").failures.empty());
}

TEST(ScriptWords, QuotesAndCommentsAreUnderstood) {
  EXPECT_EQ(split_words("  open 'a b.off'  # c"), (std::vector<std::string>{"open", "a b.off"}));
  EXPECT_EQ(split_words("a\"b c\"d"), (std::vector<std::string>{"ab cd"}));
  EXPECT_TRUE(split_words("# nothing").empty());
  for (const std::string word : {"it's #1", "a \"b\" c", "it's \"both\"", "\"", ""})
    EXPECT_EQ(split_words(quote_word(word)), (std::vector<std::string>{word})) << quote_word(word);
}

TEST(ScriptWords, CommandsReadBackAsTheyWere) {
  model::Session session;
  session.document = model::make_document("square.off", {generate(ShapeKind::random_square, {}), {}, {}});
  session.timeline.branches.resize(3);
  for (model::Branch& branch : session.timeline.branches) branch.start = 7;
  for (const model::Command& command : std::vector<model::Command>{
           model::Seek{7, 2U}, model::Seek{3, {}},
           model::SetStage{model::Stage{model::StageKind::control, 3}}, model::SetStage{},
           model::StepStage{-1}, model::SelectVertex{9}, model::SelectLimited{4U}, model::SelectLimited{},
           model::SetWorstBy{model::WorstBy::shape}, model::ShowBranches{{0, 2}},
           model::SetStepBudget{std::size_t{64} << 20U}, model::TogglePin{5}, model::Teach{},
           model::RemoveRun{1}, model::CompareBranches{0, 2}, model::Undo{}}) {
    const std::string line = to_line(command);
    const auto back = parse_line(split_words(line), session, {});
    ASSERT_TRUE(back) << line;
    EXPECT_EQ(to_line(*back), line);
  }
}

}  // namespace
}  // namespace isorelax::editor
