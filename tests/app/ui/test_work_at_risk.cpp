#include "app/ui/interface_fixture.h"
#include "io/mesh_file.h"

namespace isorelax::ui {
namespace {

/// What is told after a run, what is asked before it is lost, and what typed numbers do.
class WorkTest : public InterfaceTest {
 protected:
  [[nodiscard]] bool status_is_about(const std::string& text) const {
    return session.messages.back().text.find(text) != std::string::npos &&
           session.messages.back().number > session.last_run_number;
  }
  void ask_to_quit() {
    interface.ask_to_quit();
    settle();
    for (int k = 0; k < 3; ++k) frame();  // the dialog finds its size
  }
};

TEST_F(WorkTest, WhatIsSaidAfterARunIsNewsAndTheRunIsNoMore) {
  open();
  press(Key::right);
  ASSERT_TRUE(session.last_run);
  EXPECT_TRUE(session.messages.empty() || session.messages.back().number <= session.last_run_number);
  model::execute(session, model::SaveFile{folder / "better.off"});
  settle_and_finish();
  ASSERT_TRUE(session.last_run);
  EXPECT_TRUE(status_is_about("Saved"));
}

TEST_F(WorkTest, RunsInNoFileAreAskedForAtIterationZeroToo) {
  open();
  press(Key::right);
  press(Key::home);
  EXPECT_FALSE(session.has_unsaved_changes());
  ask_to_quit();
  ASSERT_TRUE(shows("unsaved-save"));
  EXPECT_FALSE(requested<Quit>());
  click("unsaved-save");
  ASSERT_TRUE(shows("browser-accept")) << "a trace needs a name";
  click("browser-accept");
  EXPECT_TRUE(requested<Quit>());
  EXPECT_TRUE(std::filesystem::exists(folder / "square.trace"));
}

TEST_F(WorkTest, NothingIsAskedOnceAMeshOrATraceHoldsTheWork) {
  open();
  press(Key::right);
  model::execute(session, model::SaveFile{folder / "better.off"});
  settle_and_finish();
  ask_to_quit();
  EXPECT_TRUE(requested<Quit>());
}

TEST_F(WorkTest, SaveInTheQuestionAsksForANameSavesAndQuits) {
  open();
  press(Key::right);
  ask_to_quit();
  click("unsaved-save");
  ASSERT_TRUE(shows("browser-accept"));
  EXPECT_FALSE(requested<Quit>());
  click("browser-accept");
  EXPECT_TRUE(requested<Quit>());
  EXPECT_TRUE(std::filesystem::exists(folder / "square-smooth.off"));
}

TEST_F(WorkTest, EnterAnswersTheQuestionWithSaveOrWithTheFocusedButton) {
  open();
  press(Key::right);
  ask_to_quit();
  EXPECT_EQ(interface.state().focused, "unsaved-save");
  press(Key::enter);
  ASSERT_TRUE(shows("browser-accept"));
  while (interface.state().focused != "browser-cancel") press(Key::tab);
  press(Key::enter);
  EXPECT_FALSE(shows("browser-accept"));
  EXPECT_TRUE(session.has_unsaved_changes()) << "Cancel was pressed, and not Save as well";
  ask_to_quit();
  press(Key::tab);
  ASSERT_EQ(interface.state().focused, "unsaved-cancel");
  press(Key::enter);
  EXPECT_FALSE(shows("unsaved-cancel"));
  EXPECT_FALSE(requested<Quit>());
}

TEST_F(WorkTest, AQuestionWhoseSaveIsGivenUpLeadsNowhere) {
  open();
  press(Key::right);
  ask_to_quit();
  click("unsaved-save");
  click("browser-cancel");
  press(Key::s, {.control = true});
  click("browser-accept");
  EXPECT_FALSE(session.has_unsaved_changes());
  EXPECT_FALSE(requested<Quit>()) << "that question is over";
}

TEST_F(WorkTest, ATypedDistanceHoldsWithoutEnter) {
  open();
  click("reach/Typed");
  click("max-deviation");
  press(Key::a, {.control = true});
  type("2");
  click("iterations");
  EXPECT_DOUBLE_EQ(session.smoothing.max_deviation, 0.02);
}

TEST_F(WorkTest, OtherExponentsAndTolerancesAreShownAndTyped) {
  open();
  EXPECT_FALSE(shows("tolerance-typed"));
  model::SmoothingSettings settings = session.smoothing;
  settings.tolerance = 1e-5;
  model::execute(session, model::SetSmoothing{settings, "Tolerance"});
  settle();
  EXPECT_TRUE(shows("tolerance-typed")) << "no segment stands for it";
  EXPECT_FALSE(shows("exponent-typed"));
  click("exponent/\xE2\x80\xA6");
  ASSERT_TRUE(shows("exponent-typed"));
  click("exponent-typed");
  press(Key::a, {.control = true});
  type("3");
  click("iterations");
  EXPECT_EQ(session.smoothing.exponent, 3);
  click("exponent/4");
  EXPECT_FALSE(shows("exponent-typed"));
}

TEST_F(WorkTest, WhereNothingMayMoveTheReasonsAreCounted) {
  std::ofstream(folder / "two.off") << "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  model::execute(session, model::OpenFile{folder / "two.off"});
  settle_and_finish();
  press(Key::right);
  ASSERT_TRUE(session.last_step);
  EXPECT_EQ(session.last_step->vertices, 4U);
  EXPECT_EQ(session.last_step->limits[3], 4U) << "all are on the border";
}

}  // namespace
}  // namespace isorelax::ui
