#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <fstream>
#include <future>
#include <thread>

#include "app/ui/interface_fixture.h"
#include "io/mesh_file.h"
#include "mesh/topology.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

TEST_F(InterfaceTest, StepChangesRecordColoursAndNumbers) {
  open();
  const auto colours = session.current->values(model::Coloring::min_angle);
  const std::vector<double> before(colours.begin(), colours.end());
  const double mean_before = session.current->quality().mean_min_angle_deg;
  click("step");
  ASSERT_TRUE(session.last_step);
  EXPECT_EQ(session.current->iteration, 1U);
  const auto after = session.current->values(model::Coloring::min_angle);
  EXPECT_FALSE(std::ranges::equal(before, after));
  EXPECT_NE(session.current->quality().mean_min_angle_deg, mean_before);
  EXPECT_TRUE(shows("figure/Mean smallest"));
  EXPECT_TRUE(shows("figure/Mean smallest/better")) << "not by its colour alone";
}

TEST_F(InterfaceTest, TheSameDoneByKeys) {
  open();
  press(Key::right);
  EXPECT_EQ(session.current->iteration, 1U);
  press(Key::right);
  EXPECT_EQ(session.current->iteration, 2U);
  press(Key::left);
  EXPECT_EQ(session.current->iteration, 1U);
  press(Key::home);
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  press(Key::end);
  EXPECT_EQ(session.current->iteration, 2U);
  press(Key::z, {.control = true});
  EXPECT_EQ(session.current->iteration, 1U);
  press(Key::z, {.control = true, .shift = true});
  EXPECT_EQ(session.current->iteration, 2U);
}

TEST_F(InterfaceTest, RunButtonRunsTheNumberOfIterations) {
  open();
  session.smoothing.iterations = 5;
  session.smoothing.tolerance = 0;
  click("run");
  EXPECT_EQ(session.current->iteration, 5U);
  EXPECT_TRUE(shows("news"));
  EXPECT_NE(describe_last_run(session).find("5 iterations"), std::string::npos);
  EXPECT_NE(describe_last_run(session).find("boundary"), std::string::npos) << describe_last_run(session);
  press(Key::right);
  press(Key::right);
  EXPECT_NE(describe_last_run(session).find("after 7 iterations"), std::string::npos)
      << "all of the run, not the last step: " << describe_last_run(session);
}

TEST_F(InterfaceTest, DraggingTheWeightSliderChangesTheSettingOnce) {
  open();
  move_to("mu");
  interface.input().push(ButtonChanged{0, true});
  settle();
  const Rect rect = interface.state().rects.at("mu");
  for (const float share : {0.55F, 0.6F, 0.7F}) {
    interface.input().push(PointerMoved{rect.low.x + share * rect.width(), rect.center().y});
    settle();
  }
  interface.input().push(ButtonChanged{0, false});
  settle_and_finish();
  EXPECT_GT(session.smoothing.mu_a, 0.5);
  EXPECT_EQ(session.undo.size(), 1U);
  press(Key::z, {.control = true});
  EXPECT_EQ(session.smoothing.mu_a, 0);
}

TEST_F(InterfaceTest, BoundaryReferenceAndColouringAreChosenByClicks) {
  open();
  click("boundary/Slide");
  EXPECT_EQ(session.smoothing.boundary, BoundaryRule::slide);
  click("reference");
  click("reference/Mesh as opened");
  EXPECT_EQ(session.smoothing.reference, model::ReferenceKind::initial);
  click("coloring/Energy");
  EXPECT_EQ(session.view.coloring, model::Coloring::energy);
  press(Key::digit2);
  EXPECT_EQ(session.view.coloring, model::Coloring::max_angle);
  click("range/Current");
  EXPECT_EQ(session.view.range_mode, model::RangeMode::current);
}

TEST_F(InterfaceTest, AFileIsOpenedThroughTheBrowserWithTheKeyboardAlone) {
  open();
  (void)folder.make_square(100, "zz.off");
  press(Key::o, {.control = true});
  ASSERT_TRUE(shows("browser-accept"));
  type("zz.off");
  press(Key::enter);
  EXPECT_EQ(session.document->mesh().triangle_count(), 100U);
  EXPECT_FALSE(shows("browser-accept"));
}

TEST_F(InterfaceTest, AMissingFileIsAMessageInTheBrowserWhichEscapeCloses) {
  open();
  press(Key::o, {.control = true});
  type("nothing.off");
  press(Key::enter);
  EXPECT_TRUE(shows("browser-note"));
  EXPECT_NE(interface.state().browser.error.find("nothing.off"), std::string::npos);
  press(Key::escape);
  settle();
  EXPECT_FALSE(shows("browser-accept"));
}

TEST_F(InterfaceTest, WhatIsTypedTakesThePlaceOfASuggestedOrRefusedName) {
  open();
  press(Key::o, {.control = true});
  type("square.off");
  press(Key::escape);
  press(Key::s, {.control = true});
  type("bad.name");
  EXPECT_EQ(interface.state().browser.name, "bad.name") << "not inside the suggestion";
  press(Key::enter);
  EXPECT_TRUE(shows("browser-note"));
  EXPECT_EQ(interface.state().focused, "name");
  type("good.off");
  EXPECT_EQ(interface.state().browser.name, "good.off");
  click("browser-cancel");
}

TEST_F(InterfaceTest, ABadFileIsANoticeAndTheDocumentStays) {
  open();
  const auto document = session.document;
  std::ofstream(folder / "bad.ply") << "ply\nformat ascii 1.0\n";
  interface.drop(folder / "bad.ply");
  settle_and_finish();
  EXPECT_EQ(session.document, document);
  EXPECT_TRUE(shows("notice"));
  click("dismiss");
  EXPECT_FALSE(shows("notice"));
}

TEST_F(InterfaceTest, ANoticeIsClosedByEscapeAndAnsweredByWhatWorksOut) {
  open();
  const auto fails = [&] {
    model::execute(session, model::SaveFile{folder / "nowhere" / "square.off"});
    settle_and_finish();
    return shows("notice");
  };
  ASSERT_TRUE(fails());
  press(Key::escape);
  EXPECT_FALSE(shows("notice"));
  ASSERT_TRUE(fails());
  model::execute(session, model::SaveFile{folder / "saved.off"});
  settle_and_finish();
  EXPECT_FALSE(shows("notice"));
}

TEST_F(InterfaceTest, UnsavedWorkIsAskedForBeforeItIsLost) {
  open();
  press(Key::right);
  const auto document = session.document;
  interface.drop(folder.make_square(100, "other.off"));
  settle_and_finish();
  ASSERT_TRUE(shows("unsaved-cancel"));
  click("unsaved-cancel");
  EXPECT_EQ(session.document, document);
  interface.ask_to_quit();
  settle();
  ASSERT_TRUE(shows("unsaved-discard"));
  EXPECT_FALSE(requested<Quit>());
  click("unsaved-discard");
  EXPECT_TRUE(requested<Quit>());
}

TEST_F(InterfaceTest, SavingOverAFileAsksFirst) {
  open();
  press(Key::right);
  std::ofstream(folder / "square-smooth.off") << "precious";
  press(Key::s, {.control = true});
  ASSERT_TRUE(shows("browser-accept")) << "the first save asks for a name";
  click("browser-accept");
  EXPECT_TRUE(shows("browser-note"));
  EXPECT_TRUE(session.has_unsaved_changes());
  click("browser-accept");
  EXPECT_FALSE(session.has_unsaved_changes());
  EXPECT_EQ(read_mesh(folder / "square-smooth.off").mesh.triangle_count(), 400U);
}

TEST_F(InterfaceTest, TabReachesEveryControlAndSpaceUsesIt) {
  open();
  const std::vector<std::string> stops = interface.state().stops;
  ASSERT_GT(stops.size(), 20U);
  for (const std::string& stop : stops) {
    press(Key::tab);
    EXPECT_EQ(interface.state().focused, stop);
  }
  while (interface.state().focused != "boundary/Fixed") press(Key::tab);
  press(Key::right);
  EXPECT_EQ(session.smoothing.boundary, BoundaryRule::slide);
  EXPECT_EQ(interface.state().focused, "boundary/Slide");
  press(Key::right);
  EXPECT_EQ(session.smoothing.boundary, BoundaryRule::free);
  press(Key::right);
  EXPECT_EQ(session.smoothing.boundary, BoundaryRule::free) << "the last";
  press(Key::tab);
  EXPECT_EQ(interface.state().focused, "features/Auto") << "the next control, not the next segment";
  while (interface.state().focused != "wire") press(Key::tab);
  const bool wire = session.view.wire;
  press(Key::space);
  EXPECT_NE(session.view.wire, wire);
  press(Key::enter);
  EXPECT_EQ(session.view.wire, wire) << "Enter does what Space does";
  EXPECT_FALSE(session.is_running()) << "Space belongs to the control that has the focus";
  EXPECT_EQ(session.current->iteration, 0U);
  press(Key::escape);
  EXPECT_TRUE(interface.state().focused.empty());
  press(Key::right);
  EXPECT_EQ(session.current->iteration, 1U) << "without a focus the keys are shortcuts again";
}

TEST_F(InterfaceTest, TypingInAFieldIsNoShortcut) {
  open();
  press(Key::o, {.control = true});
  interface.input().push(KeyChanged{Key::w, true, {}});
  interface.input().push(TextTyped{"w"});
  interface.input().push(KeyChanged{Key::w, false, {}});
  settle_and_finish();
  EXPECT_TRUE(session.view.wire);
  EXPECT_EQ(interface.state().browser.name, "w");
}

TEST_F(InterfaceTest, AKeyPressedAndReleasedBetweenTwoFramesIsNotLost) {
  open();
  interface.input().push(KeyChanged{Key::w, true, {}});
  interface.input().push(KeyChanged{Key::w, false, {}});
  interface.input().push(KeyChanged{Key::w, true, {}});
  interface.input().push(KeyChanged{Key::w, false, {}});
  interface.input().push(KeyChanged{Key::w, true, {}});
  interface.input().push(KeyChanged{Key::w, false, {}});
  settle();
  EXPECT_FALSE(session.view.wire) << "three presses toggle three times";
}

TEST_F(InterfaceTest, DraggingInTheViewportPansAPlanarMeshAndTheWheelZoomsToThePointer) {
  open();
  move_to("viewport");
  interface.input().push(ButtonChanged{0, true});
  settle();
  const ImVec2 at = interface.state().rects.at("viewport").center();
  interface.input().push(PointerMoved{at.x + 30, at.y + 10});
  settle();
  interface.input().push(ButtonChanged{0, false});
  interface.input().push(WheelTurned{0, 1});
  settle();
  EXPECT_TRUE(requested<PanView>());
  EXPECT_FALSE(requested<OrbitView>());
  const auto zoom =
      std::ranges::find_if(requests, [](const Request& r) { return std::holds_alternative<ZoomView>(r); });
  ASSERT_NE(zoom, requests.end());
  EXPECT_GT(std::get<ZoomView>(*zoom).factor, 1);
  EXPECT_NEAR(std::get<ZoomView>(*zoom).x, at.x + 30 - interface.state().rects.at("viewport").low.x, 1);
}

TEST_F(InterfaceTest, KeysMoveTheCamera) {
  open();
  const auto last = [&]() -> const Request& { return requests.back(); };
  press(Key::right, {.control = true});
  ASSERT_TRUE(std::holds_alternative<OrbitView>(last()));
  EXPECT_GT(std::get<OrbitView>(last()).dx, 0);
  press(Key::up, {.control = true, .shift = true});
  ASSERT_TRUE(std::holds_alternative<PanView>(last()));
  EXPECT_LT(std::get<PanView>(last()).dy, 0);
  press(Key::page_up);
  ASSERT_TRUE(std::holds_alternative<ZoomView>(last()));
  EXPECT_GT(std::get<ZoomView>(last()).factor, 1);
  press(Key::digit5, {.control = true});
  ASSERT_TRUE(std::holds_alternative<LookFrom>(last()));
  EXPECT_EQ(std::get<LookFrom>(last()).view, "top");
  // In a field they move between words.
  const std::size_t count = requests.size();
  press(Key::i);
  click("inspect-id");
  press(Key::left, {.control = true});
  EXPECT_EQ(requests.size(), count);
}

TEST_F(InterfaceTest, HelpListsTheKeysAndEscapeClosesIt) {
  open();
  press(Key::question);
  EXPECT_TRUE(shows("help-page"));
  press(Key::escape);
  settle();
  EXPECT_FALSE(shows("help-page"));
}

TEST_F(InterfaceTest, TheGuardOfAStepCanBeLookedIntoAtOnce) {
  open();
  session.smoothing.iterations = 30;
  session.smoothing.tolerance = 0;
  session.smoothing.exponent = 16;
  click("run");
  unsigned guarded = 0;
  for (unsigned k = 1; k <= session.timeline.last(); ++k)
    if (session.timeline.step(0, k)->energy_passes > 0) guarded = k;
  ASSERT_GT(guarded, 0U);
  model::execute(session, model::Seek{guarded, {}});
  settle_and_finish();
  click("stage/Guard");
  settle_and_finish();
  const auto stage = session.timeline.cursor.stage;
  ASSERT_TRUE(stage);
  ASSERT_TRUE(session.inspection.step && session.inspection.step->record->detail);
  const auto& passes = session.inspection.step->record->detail->passes;
  ASSERT_LT(stage->pass, passes.size());
  EXPECT_EQ(passes[stage->pass].why, kLimitEnergy);
}

TEST_F(InterfaceTest, TheKeyOfThreeRunsStandsClearOfTheTitle) {
  open();
  session.smoothing.iterations = 3;
  model::execute(session, model::Teach{});
  settle_and_finish();
  press(Key::q);
  ASSERT_EQ(session.shown_branches.size(), 2U);
  for (const std::string plot : {"energy-plot", "angle-plot"}) {
    const Rect key = interface.state().rects.at(plot + "/key");
    const Rect title = interface.state().rects.at(plot + "/title");
    EXPECT_TRUE(key.low.x > title.high.x || key.low.y >= title.high.y) << plot;
  }
}

TEST_F(InterfaceTest, WhileBusyTheLineOfNewsStandsWithItsNeighbours) {
  open();
  model::execute(session, model::Say{{model::MessageKind::info, "News"}});
  std::promise<void> seen;
  session.engine.post("test", [done = seen.get_future().share()](auto& context) {
    context.progress("Waiting", -1);
    done.wait();
  });
  while (!session.engine.progress().busy) std::this_thread::yield();
  frame();
  frame();
  EXPECT_TRUE(shows("cancel"));
  ASSERT_TRUE(shows("news"));
  EXPECT_NEAR(interface.state().rects.at("news").center().y,
              interface.state().rects.at("document").center().y, 1);
  seen.set_value();
  model::finish(session);
}

TEST_F(InterfaceTest, TheTimelineDoesNotJoinEnergiesOfDifferentKinds) {
  open();
  click("step");
  press(Key::t);
  settle();
  ASSERT_EQ(session.history.size(), 2U);
  const int joined = interface.draw_data().TotalVtxCount;
  session.history.back().series = session.history.front().series + 1;
  frame();
  EXPECT_LT(interface.draw_data().TotalVtxCount, joined);
}

TEST_F(InterfaceTest, ASmallWindowHasMenusForWhatDoesNotFit) {
  display = {1024, 640};
  open();
  click("step");
  EXPECT_FALSE(shows("stage/Tangent"));
  click("stage");
  click("stage/Tangent");
  EXPECT_EQ(session.timeline.cursor.stage, model::Stage{model::StageKind::tangent});
  click("compare");
  click("compare/Split");
  EXPECT_EQ(interface.state().comparison.mode, CompareMode::split);
  EXPECT_TRUE(shows("compare-with"));
}

TEST_F(InterfaceTest, ChoicesWhoseLabelsDoNotFitAreAMenu) {
  interface.state().left_width = 240;
  open();
  EXPECT_TRUE(shows("boundary/Slide"));
  EXPECT_FALSE(shows("reach/Near"));
  click("reach");
  click("reach/Near");
  EXPECT_EQ(session.smoothing.reach, model::Reach::nearest);
}

TEST_F(InterfaceTest, AtALargeScaleASinglePanelHasTheSettingsAndNothingIsOutside) {
  open();
  for (const float size : {1.5F, 2.0F}) {
    scale = size;
    interface.state().tab = SideTab::quality;
    settle();
    const auto& rects = interface.state().rects;
    for (const char* name : {"open", "undo", "coloring", "wire", "shading", "frame", "help", "transport-run",
                             "to-start", "to-end", "track", "compare-bar", "tab/Settings"}) {
      ASSERT_TRUE(shows(name)) << name << " at " << size;
      EXPECT_LE(rects.at(name).high.x, display.x) << name << " at " << size;
      EXPECT_LE(rects.at(name).high.y, display.y) << name << " at " << size;
      EXPECT_GE(rects.at(name).width(), 20 * size) << name << " at " << size;
    }
    EXPECT_LT(rects.at("to-end").high.x, rects.at("viewport").high.x) << size;
    EXPECT_GT(rects.at("viewport").height(), display.y / 2 - 2) << size;
    EXPECT_FALSE(shows("solver"));
    click("tab/Settings");
    EXPECT_TRUE(shows("solver"));
  }
  click("transport-run");
  EXPECT_GT(session.current->iteration, 0U);
  scale = 1;
  settle();
  EXPECT_EQ(interface.state().tab, SideTab::quality) << "the settings have their own panel again";
  EXPECT_TRUE(shows("solver"));
}

TEST_F(InterfaceTest, SpaceRunsAfterAQuestionThatEscapeAnswers) {
  open();
  click("step");
  interface.state().focused.clear();
  press(Key::escape);
  press(Key::q, {.control = true});
  EXPECT_TRUE(shows("unsaved-save"));
  press(Key::escape);
  EXPECT_FALSE(shows("unsaved-save"));
  EXPECT_EQ(interface.state().focused, "");
  press(Key::space);
  EXPECT_GT(session.current->iteration, 2U);
}

TEST_F(InterfaceTest, WhatAMethodWithoutAnEnergyHasNoUseForIsGrey) {
  open();
  const auto reaches = [&](const char* name) {
    return std::ranges::find(interface.state().stops, name) != interface.state().stops.end();
  };
  for (const char* name : {"exponent/2", "mu", "reference"}) EXPECT_TRUE(reaches(name)) << name;
  session.smoothing.method = model::Method::laplacian;
  settle();
  for (const char* name : {"exponent/2", "mu", "reference"}) EXPECT_FALSE(reaches(name)) << name;
  EXPECT_TRUE(reaches("solver"));
  EXPECT_TRUE(reaches("boundary/Fixed"));
}

TEST_F(InterfaceTest, AStepDoesNotEndBecauseOfTheAllowedNumber) {
  open();
  session.smoothing.iterations = 30;
  session.smoothing.tolerance = 0;
  click("step");
  EXPECT_NE(describe_last_run(session).find("after 1 iteration: one step was made"), std::string::npos)
      << describe_last_run(session);
}

TEST_F(InterfaceTest, EachOfTheThreeMethodsHasItsFigures) {
  open();
  session.smoothing.iterations = 3;
  model::execute(session, model::Teach{});
  settle_and_finish();
  press(Key::q);
  for (const char* name : {"run-figure/0/smallest", "run-figure/1/largest", "run-figure/2/mean"})
    EXPECT_TRUE(shows(name)) << name;
  EXPECT_LT(interface.state().rects.at("run-figure/0/mean").center().y,
            interface.state().rects.at("run-figure/1/mean").center().y);
}

TEST_F(InterfaceTest, ANoteGoesWhenWhatItSaysIsDone) {
  TriangleMesh mesh = read_mesh(folder.make_square()).mesh;
  const Topology topology(mesh.triangles, mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (topology.is_boundary(v)) continue;
    mesh.positions[v].x() += 0.3;
    break;
  }
  (void)write_mesh(folder / "thrown.off", mesh);
  model::execute(session, model::OpenFile{folder / "thrown.off"});
  settle_and_finish();
  ASSERT_GT(session.current->quality().inverted, 0U);
  ASSERT_TRUE(shows("notice"));
  click("run");
  EXPECT_FALSE(shows("notice"));
  press(Key::home);
  EXPECT_TRUE(shows("notice")) << "there it is true again";
}

TEST_F(InterfaceTest, TheInspectorSaysWhatIsSelected) {
  open();
  interface.state().tab = SideTab::inspect;
  model::execute(session, model::SelectTriangle{3});
  settle_and_finish();
  EXPECT_TRUE(interface.state().typing.triangle);
  click("inspect-what/Vertex");
  EXPECT_FALSE(interface.state().typing.triangle) << "the number of a vertex can be typed";
  model::execute(session, model::SelectTriangle{4});
  settle_and_finish();
  EXPECT_TRUE(interface.state().typing.triangle);
}

TEST_F(InterfaceTest, NothingOverlapsInTheSmallestWindow) {
  display = {960, 540};
  open();
  click("step");
  const auto& rects = interface.state().rects;
  EXPECT_LT(rects.at("redo").high.x, rects.at("coloring/Min angle").low.x);
  EXPECT_LT(rects.at("coloring/Plain").high.x, rects.at("wire").low.x);
  EXPECT_LT(rects.at("help").high.x, display.x);
  EXPECT_LT(rects.at("to-end").high.x, rects.at("stage").low.x);
  EXPECT_LE(rects.at("stage").high.x, rects.at("timeline").high.x);
  EXPECT_LE(rects.at("compare-bar").high.x, rects.at("viewport").high.x);
  EXPECT_LE(rects.at("document").high.x, rects.at("news").low.x);
  press(Key::f1);
  EXPECT_LE(rects.at("help-page").high.y, display.y) << "it scrolls";
}

TEST_F(InterfaceTest, WhatIsWrittenInANarrowPanelStaysApart) {
  display = {800, 600};
  open();
  click("transport-run");
  model::execute(session, model::SelectVertex{130});
  settle_and_finish();
  interface.state().tab = SideTab::inspect;
  settle();
  const auto& rects = interface.state().rects;
  ASSERT_TRUE(shows("ring-factor"));
  const Rect& factor = rects.at("ring-factor");
  const Rect& key = rects.at("ring-key");
  EXPECT_TRUE(factor.low.x >= key.high.x || factor.high.y <= key.low.y);
}

TEST_F(InterfaceTest, TextThatDoesNotFitEndsInAnEllipsis) {
  settle();
  const ImFont& font = *ImGui::GetFont();
  EXPECT_EQ(fitted(font, "Near-isometry", 500), "Near-isometry");
  const std::string cut = fitted(font, "Near-isometry", 60);
  EXPECT_TRUE(cut.ends_with("\xE2\x80\xA6")) << cut;
  EXPECT_LE(text_width(font, cut), 60);
  EXPECT_EQ(fitted(font, "", 60), "");
  EXPECT_EQ(fitted(font, "Near-isometry", 1), "");
}

TEST_F(InterfaceTest, HiddenPanelsLeaveTheWholeWindowToTheMesh) {
  open();
  press(Key::h);
  EXPECT_EQ(interface.state().rects.at("viewport").width(), 1280);
  EXPECT_FALSE(shows("run"));
  press(Key::h);
  EXPECT_TRUE(shows("run"));
}

TEST_F(InterfaceTest, NextWorstSelectsAndFliesThere) {
  open();
  press(Key::n);
  ASSERT_TRUE(session.selected_triangle);
  EXPECT_TRUE(requested<FlyToSelection>());
  EXPECT_TRUE(shows("selection"));
}

}  // namespace
}  // namespace isorelax::ui
