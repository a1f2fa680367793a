#include "app/ui/interface_fixture.h"

namespace isorelax::ui {
namespace {

/// The panel that moves surfaces.
class MotionPanelTest : public InterfaceTest {
 protected:
  void show_sphere() {
    SphereStart sphere;
    sphere.vertices = 300;
    model::execute(session, model::OpenSphere{sphere});
    model::finish(session);
    settle();
  }
  void set(const std::vector<std::string>& words) {
    MotionChoices motion = session.motion;
    read_words(words, motion);
    model::execute(session, model::SetMotion{motion, "test"});
    settle();
  }
  /// In place of what the field that has the focus holds.
  void type_over(const std::string& text) {
    press(Key::a, {.control = true});
    type(text);
  }
};

TEST_F(MotionPanelTest, NumbersAreTakenOverAsTheyAreTypedAndUndoneAtOnce) {
  settle();
  click("task/Move");
  click("field-period");
  type_over("0.5");
  press(Key::enter);
  EXPECT_EQ(session.motion.field.period, 0.5);
  EXPECT_EQ(end_time(session.motion), 0.5);
  click("until");
  type_over("0.25");
  press(Key::enter);
  EXPECT_EQ(end_time(session.motion), 0.25);
  press(Key::escape);
  press(Key::z, {.control = true});
  EXPECT_EQ(end_time(session.motion), 0.5);
  press(Key::z, {.control = true});
  EXPECT_EQ(session.motion.field.period, 3);
  click("preset");
  click("preset/Paper's");
  EXPECT_EQ(session.motion.preset, "paper");
  click("motion-details");
  click("motion-solver");
  click("motion-solver/Newton");
  EXPECT_EQ(session.motion.solver, Solver::newton);
  click("preset");
  click("preset/Angles");
  EXPECT_FALSE(session.motion.solver) << "it is for tangent moves only";
  click("every");
  type_over("3");
  press(Key::enter);
  EXPECT_EQ(session.motion.every, 3U);
}

TEST_F(MotionPanelTest, AMistakeInAnExpressionIsShownWhereItStands) {
  show_sphere();
  set({"field", "expr:-y;x;0"});
  EXPECT_FALSE(shows("field-v-mistake"));
  click("field-v");
  type_over("x+*2");
  EXPECT_TRUE(shows("field-v-mistake"));
  EXPECT_FALSE(shows("field-u-mistake"));
  press(Key::enter);
  press(Key::escape);
  press(Key::space);
  EXPECT_EQ(session.messages.back().kind, model::MessageKind::error);
  EXPECT_NE(session.messages.back().text.find("x+*2: column 3"), std::string::npos)
      << session.messages.back().text;
  EXPECT_TRUE(session.timeline.empty());
}

TEST_F(MotionPanelTest, EveryControlIsReachedByTab) {
  show_sphere();
  set({"field", "expr:0;0;0", "preset", "paper"});
  click("motion-details");
  const auto& stops = interface.state().stops;
  for (const char* name : {"task/Move",
                           "task/Move",
                           "sphere/1500",
                           "field",
                           "field-u",
                           "field-w",
                           "until",
                           "time-step",
                           "step-error/Fixed",
                           "preset",
                           "motion-reference",
                           "every",
                           "only-below",
                           "motion-details",
                           "moves",
                           "method",
                           "motion-iterations",
                           "motion-solver",
                           "motion-mu",
                           "run",
                           "step"})
    EXPECT_NE(std::ranges::find(stops, name), stops.end()) << name;
}

TEST_F(MotionPanelTest, EveryFieldAndEveryOptionCanBeChosen) {
  show_sphere();
  click("task/Move");
  for (const char* field :
       {"Enright", "Rigid motion", "Shear", "Along the normal", "Expressions", "Eq. (10)"}) {
    click("field");
    click(std::string("field/") + field);
    EXPECT_EQ(model::title(session.motion.field.kind), field);
  }
  click("field");
  click("field/Sampled file");
  EXPECT_TRUE(shows("browser-accept")) << "which file?";
  press(Key::escape);
  click("step-error/1e-6");
  EXPECT_EQ(session.motion.tolerance, 1e-6);
  click("field");
  click("field/Along the normal");
  EXPECT_FALSE(session.motion.tolerance) << "motion along normals takes fixed steps";
  EXPECT_FALSE(shows("step-error/1e-6"));
  click("motion-reference");
  EXPECT_FALSE(shows("motion-reference/Equilateral, edge length")) << "references have the mesh's area";
  press(Key::escape);
  click("preset");
  click("preset/Paper's");
  click("motion-reference");
  click("motion-reference/Equilateral, edge length");
  EXPECT_EQ(session.motion.reference, "equilateral:0.01");
  EXPECT_TRUE(shows("motion-edge"));
  click("preset");
  click("preset/None");
  EXPECT_FALSE(shows("every")) << "nothing is redistributed";
  click("sphere/1500");
  EXPECT_EQ(session.document->mesh().vertex_count(), 1500U);
}

TEST_F(MotionPanelTest, TheTimelineAndThePanelsSpeakOfTime) {
  show_sphere();
  set({"field", "shear:1", "step", "0.25"});
  settle();
  press(Key::space);
  EXPECT_EQ(session.current->iteration, 4U);
  for (const char* name : {"moment", "figure/Volume change", "motion-angles", "motion-volume", "track"})
    EXPECT_TRUE(shows(name)) << name;
  EXPECT_FALSE(shows("figure/Energy"));
  click("tab/Debug");
  EXPECT_FALSE(shows("reason/pinned"));
  EXPECT_TRUE(shows("ended"));
  click("tab/Runs");
  EXPECT_TRUE(shows("branch/0"));
  press(Key::t, {.control = true});
  EXPECT_FALSE(shows("browser-accept"));
  EXPECT_NE(session.messages.back().text.find("isorelax advect"), std::string::npos);
  press(Key::right, {.shift = true});
  EXPECT_NE(session.messages.back().text.find("no stages"), std::string::npos);
}

}  // namespace
}  // namespace isorelax::ui
