#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "app/temporary_mesh.h"
#include "model/command.h"
#include "model/jobs.h"

namespace isorelax::model {
namespace {

class SessionTest : public ::testing::Test {
 protected:
  void open(std::size_t triangles = 400) {
    execute(session, OpenFile{folder.make_square(triangles)});
    finish(session);
    ASSERT_TRUE(session.current);
  }
  void run(unsigned iterations) {
    SmoothingSettings settings = session.smoothing;
    settings.iterations = iterations;
    settings.tolerance = 0;
    execute(session, SetSmoothing{settings, "Iterations"});
    execute(session, model::Run{});
    finish(session);
  }
  void do_and_wait(const Command& command) {
    execute(session, command);
    finish(session);
  }
  [[nodiscard]] std::string last_message() const {
    return session.messages.empty() ? "" : session.messages.back().text;
  }

  test::TemporaryFolder folder;
  Session session;
};

TEST_F(SessionTest, OpeningMeasuresTheMeshAndItsEnergy) {
  open();
  EXPECT_EQ(session.document->mesh().triangle_count(), 400U);
  EXPECT_TRUE(session.document->plane_normal);
  EXPECT_EQ(session.current, session.original);
  EXPECT_FALSE(session.has_unsaved_changes());
  ASSERT_TRUE(session.current->energy);
  EXPECT_GE(session.current->energy->total, 2.0 * 400);
  ASSERT_EQ(session.history.size(), 1U);
  EXPECT_EQ(session.history[0].iteration, 0U);
  EXPECT_EQ(session.recent.size(), 1U);
}

TEST_F(SessionTest, AFileThatCannotBeReadLeavesTheDocumentAndSaysWhy) {
  open();
  const DocumentPtr before = session.document;
  const std::filesystem::path bad = folder / "bad.off";
  std::ofstream(bad) << "OFF\n3 1 0\n0 0 0\n1 0 0\n";
  do_and_wait(OpenFile{bad});
  EXPECT_EQ(session.document, before);
  EXPECT_EQ(session.activity, Activity::idle);
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
  EXPECT_NE(last_message().find("bad.off"), std::string::npos) << last_message();
}

TEST_F(SessionTest, AStepLowersTheEnergyAndLeavesARecord) {
  open();
  const MeshStatePtr before = session.current;
  do_and_wait(Step{});
  EXPECT_NE(session.current->geometry, before->geometry);
  EXPECT_EQ(session.current->iteration, 1U);
  ASSERT_TRUE(session.last_step);
  EXPECT_LT(session.last_step->after.energy, session.last_step->before.energy);
  EXPECT_GT(session.last_step->moved, 0U);
  EXPECT_GT(session.last_step->limits[3], 0U) << "the boundary is fixed";
  ASSERT_EQ(session.history.size(), 2U);
  EXPECT_NEAR(session.history[1].energy, session.current->energy->total, 1e-9 * session.history[1].energy);
  EXPECT_NEAR(session.history[0].energy, session.last_step->before.energy, 1e-9 * session.history[0].energy);
  EXPECT_TRUE(session.has_unsaved_changes());
}

TEST_F(SessionTest, EveryRowTellsTheWorstAnglesThatTheReportFinds) {
  open();
  do_and_wait(Step{});
  EXPECT_NEAR(session.history[1].min_angle_deg, session.current->quality().min_angle_deg, 1e-9);
  EXPECT_NEAR(session.history[1].max_angle_deg, session.current->quality().max_angle_deg, 1e-9);
}

TEST_F(SessionTest, ARunGoesWhereItsStepsGo) {
  open();
  run(7);
  const auto in_one = session.current;
  do_and_wait(Reset{});
  for (int k = 0; k < 7; ++k) do_and_wait(Step{});
  ASSERT_EQ(session.current->iteration, in_one->iteration);
  for (std::size_t v = 0; v < in_one->positions().size(); ++v)
    ASSERT_EQ(session.current->positions()[v], in_one->positions()[v]) << v;
}

TEST_F(SessionTest, TheEndOfARunTellsHowFarTheSurfaceWent) {
  const std::filesystem::path path = folder / "cube.off";
  (void)write_mesh(path, generate(ShapeKind::cube, {.seed = 2, .triangles = 300, .jitter = 0.5}));
  do_and_wait(OpenFile{path});
  EXPECT_FALSE(session.surface);
  const auto warnings = [&] {
    return std::ranges::count_if(session.messages,
                                 [](const Message& m) { return m.kind == MessageKind::warning; });
  };
  run(10);
  ASSERT_TRUE(session.surface);
  EXPECT_EQ(session.surface->geometry, session.current->geometry);
  EXPECT_LT(session.surface->deviation.max, 1e-9) << "faces and edges of a cube are kept";
  EXPECT_TRUE(session.surface->deviation.has_volume);
  EXPECT_EQ(warnings(), 0);
  // Without features corners are cut, as far as they may go.
  SmoothingSettings settings = session.smoothing;
  settings.features = FeatureRule::none;
  settings.reach = Reach::any;
  do_and_wait(SetSmoothing{settings, "Features"});
  run(10);
  ASSERT_EQ(session.surface->geometry, session.current->geometry);
  const double far = session.surface->deviation.max;
  EXPECT_GT(far, 0.005);
  settings.reach = Reach::typed;
  settings.max_deviation = 0.005;
  do_and_wait(Reset{});
  do_and_wait(SetSmoothing{settings, "Stay within"});
  run(10);
  EXPECT_LE(session.surface->deviation.max, 0.005);
  EXPECT_GT(session.surface->deviation.max, 0.0025);
  EXPECT_EQ(warnings(), 0) << last_message();
}

TEST_F(SessionTest, TheDistanceIsMeasuredAnywhereOnTheTimeline) {
  const std::filesystem::path path = folder / "torus.off";
  (void)write_mesh(path, generate(ShapeKind::torus, {.triangles = 600, .jitter = 0.3}));
  do_and_wait(OpenFile{path});
  run(6);
  const double end = session.surface->deviation.max;
  const std::size_t messages = session.messages.size();
  do_and_wait(Seek{2, {}});
  ASSERT_EQ(session.surface->geometry, session.current->geometry);
  EXPECT_GT(session.surface->deviation.max, 0);
  EXPECT_NE(session.surface->deviation.max, end);
  do_and_wait(Seek{6, {}});
  ASSERT_EQ(session.surface->geometry, session.current->geometry);
  EXPECT_EQ(session.surface->deviation.max, end);
  EXPECT_EQ(session.messages.size(), messages);
}

TEST_F(SessionTest, TheDistanceIsMeasuredHoweverMuchElseIsAsked) {
  const std::filesystem::path path = folder / "torus.off";
  (void)write_mesh(path, generate(ShapeKind::torus, {.triangles = 3000, .jitter = 0.3}));
  do_and_wait(OpenFile{path});
  run(3);
  session.surface.reset();
  // While one job runs, it is asked for, and then something else.
  session.engine.post("",
                      [](const JobContext&) { std::this_thread::sleep_for(std::chrono::milliseconds(20)); });
  session.engine.post("surface", surface_job(session.document, session.smoothing, session.current, {}));
  execute(session, SelectVertex{8});
  finish(session);
  ASSERT_TRUE(session.surface);
  EXPECT_EQ(session.surface->geometry, session.current->geometry);
  EXPECT_GT(session.surface->deviation.max, 0);
}

TEST_F(SessionTest, PositionsAndSettingsAreUndoneSeparately) {
  open();
  run(3);
  const MeshStatePtr smoothed = session.current;
  SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.5;
  do_and_wait(SetSmoothing{settings, "mu"});
  do_and_wait(Undo{});
  EXPECT_EQ(session.smoothing.mu_a, 0);
  EXPECT_EQ(session.current->geometry, smoothed->geometry) << "undoing a setting moves nothing";
  do_and_wait(Undo{});
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  EXPECT_EQ(session.history.size(), 1U);
  EXPECT_FALSE(session.has_unsaved_changes());
  do_and_wait(Redo{});
  EXPECT_EQ(session.current->geometry, smoothed->geometry);
  EXPECT_EQ(session.history.size(), 4U);
  do_and_wait(Redo{});
  EXPECT_EQ(session.smoothing.mu_a, 0.5);
}

TEST_F(SessionTest, DraggingASliderIsOneUndo) {
  open();
  for (const double mu : {0.1, 0.2, 0.3}) {
    SmoothingSettings settings = session.smoothing;
    settings.mu_a = mu;
    execute(session, SetSmoothing{settings, "mu"});
  }
  execute(session, EndEdit{});
  SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.4;
  execute(session, SetSmoothing{settings, "mu"});
  do_and_wait(Undo{});
  EXPECT_EQ(session.smoothing.mu_a, 0.3);
  do_and_wait(Undo{});
  EXPECT_EQ(session.smoothing.mu_a, 0);
}

TEST_F(SessionTest, AnotherWeightMeasuresBothEnergiesAnew) {
  open();
  run(2);
  const double before = session.original->energy->total;
  SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.5;
  do_and_wait(SetSmoothing{settings, "mu"});
  EXPECT_NE(session.original->energy->total, before);
  EXPECT_EQ(session.original->energy->settings.mu_a, 0.5);
  EXPECT_EQ(session.current->energy->settings.mu_a, 0.5);
  do_and_wait(Step{});
  const IterationRow& start = session.history[session.history.size() - 2];
  EXPECT_EQ(start.iteration, 2U) << "the new series starts where the step started";
  EXPECT_GT(start.energy, session.history.back().energy);
}

TEST_F(SessionTest, ResetGoesBackToTheFileAndCanBeUndone) {
  open();
  run(3);
  const MeshStatePtr smoothed = session.current;
  do_and_wait(Reset{});
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  EXPECT_EQ(session.history.size(), 1U);
  do_and_wait(StepBack{});
  EXPECT_EQ(session.current->geometry, session.original->geometry)
      << "a reset is no iteration to go back over";
  do_and_wait(Undo{});
  EXPECT_EQ(session.current->geometry, smoothed->geometry);
}

TEST_F(SessionTest, StepBackTakesBackOneStep) {
  open();
  do_and_wait(Step{});
  const MeshStatePtr first = session.current;
  do_and_wait(Step{});
  do_and_wait(StepBack{});
  EXPECT_EQ(session.current->geometry, first->geometry);
  EXPECT_EQ(session.history.size(), 3U) << "what comes after is recorded";
}

TEST_F(SessionTest, PauseStopsARunThatContinuesWhereItWas) {
  open(20000);
  SmoothingSettings settings = session.smoothing;
  settings.iterations = 1000000;
  settings.tolerance = 0;
  execute(session, SetSmoothing{settings, "Iterations"});
  execute(session, model::Run{});
  EXPECT_TRUE(session.is_running());
  while (session.current->iteration < 2) {
    session.engine.wait();
    execute(session, Collect{});
  }
  do_and_wait(Pause{});
  EXPECT_FALSE(session.is_running());
  ASSERT_TRUE(session.last_run);
  EXPECT_EQ(session.last_run->stopped, StopReason::cancelled);
  const unsigned paused_at = session.current->iteration;
  EXPECT_EQ(session.history.back().iteration, paused_at);
  EXPECT_EQ(session.remaining, 1000000 - paused_at);
  execute(session, model::Run{});
  while (session.current->iteration <= paused_at) {
    session.engine.wait();
    execute(session, Collect{});
  }
  do_and_wait(Pause{});
  EXPECT_EQ(session.undo.size(), 3U) << "the setting and two runs";
}

TEST_F(SessionTest, SavingWhileARunGoesStopsTheRunAndLosesNothing) {
  open(20000);
  SmoothingSettings settings = session.smoothing;
  settings.iterations = 1000000;
  settings.tolerance = 0;
  execute(session, SetSmoothing{settings, "Iterations"});
  execute(session, model::Run{});
  while (session.current->iteration < 1) {
    session.engine.wait();
    execute(session, Collect{});
  }
  const std::filesystem::path path = folder / "saved.off";
  do_and_wait(SaveFile{path});
  EXPECT_FALSE(session.has_unsaved_changes());
  const TriangleMesh saved = read_mesh(path).mesh;
  for (std::size_t v = 0; v < saved.positions.size(); ++v)
    ASSERT_EQ(saved.positions[v], session.current->positions()[v]);
}

TEST_F(SessionTest, ASaveThatFailsKeepsTheWorkAndSaysWhy) {
  open();
  do_and_wait(Step{});
  do_and_wait(SaveFile{folder / "no such folder" / "x.off"});
  EXPECT_TRUE(session.has_unsaved_changes());
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
}

TEST_F(SessionTest, AReferenceFileThatDoesNotFitIsAnErrorAndTheMeshStays) {
  open();
  SmoothingSettings settings = session.smoothing;
  settings.reference = ReferenceKind::file;
  settings.reference_file = folder.make_square(100, "other.off").string();
  do_and_wait(SetSmoothing{settings, "Reference"});
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
  const auto geometry = session.current->geometry;
  do_and_wait(Step{});
  EXPECT_EQ(session.current->geometry, geometry);
  EXPECT_EQ(session.activity, Activity::idle);
}

TEST_F(SessionTest, NextWorstWalksFromTheSmallestAngleUpwards) {
  open();
  execute(session, SelectNextWorst{});
  ASSERT_TRUE(session.selected_triangle);
  const auto angle = [&] { return session.current->geometry->min_angle_values[*session.selected_triangle]; };
  double last = angle();
  EXPECT_NEAR(last, session.current->quality().min_angle_deg, 1e-9);
  for (int k = 0; k < 10; ++k) {
    execute(session, SelectNextWorst{});
    EXPECT_GE(angle(), last);
    last = angle();
  }
  EXPECT_EQ(session.rank_of_worst(), 11U);
}

TEST_F(SessionTest, TheRunRangeHoldsEverythingSinceOpening) {
  open();
  const ValueRange first = session.current->range(Coloring::relative_area);
  run(5);
  const ValueRange now = session.current->range(Coloring::relative_area);
  const ValueRange all = session.run_range[static_cast<std::size_t>(Coloring::relative_area)];
  EXPECT_LE(all.low, std::min(first.low, now.low));
  EXPECT_GE(all.high, std::max(first.high, now.high));
}

TEST_F(SessionTest, TheCommandLineNamesEverySettingAndQuotesTheFile) {
  execute(session, OpenFile{folder.make_square(100, "it's a square.off")});
  finish(session);
  session.smoothing.mu_a = 0.3;
  session.smoothing.reference = ReferenceKind::edge_length;
  session.smoothing.edge_length = 0.25;
  session.smoothing.boundary = BoundaryRule::slide;
  session.smoothing.features = FeatureRule::angle;
  session.smoothing.feature_deg = 40;
  const std::string text = command_line(session);
  EXPECT_NE(text.find("it'\\''s a square.off'"), std::string::npos) << text;
  EXPECT_NE(
      text.find("--mu 0.3 --reference equilateral:0.25 --boundary slide --features 40 --iterations 1000 "
                "--tolerance 1e-06"),
      std::string::npos)
      << text;
}

TEST_F(SessionTest, TheCommandLineMakesTheStepsThatWereMade) {
  open();
  const auto has = [&](const std::string& words) {
    return command_line(session).find(words) != std::string::npos;
  };
  session.smoothing.polish = Polish::worst;
  do_and_wait(Step{});
  do_and_wait(Step{});
  EXPECT_TRUE(has("--iterations 2 --tolerance 0 --max")) << command_line(session);
  session.smoothing.polish = Polish::none;
  do_and_wait(model::Run{});
  EXPECT_TRUE(has("--iterations 1000 --tolerance 1e-06 ")) << "it ended by itself: " << command_line(session);
  do_and_wait(Seek{3, {}});
  EXPECT_TRUE(has("--iterations 3 --tolerance 0 ")) << command_line(session);
  do_and_wait(Seek{0, {}});
  EXPECT_TRUE(has("--iterations 1000 ")) << command_line(session);
}

TEST_F(SessionTest, TheCommandLineNamesAnOutputThatIsNotThereYet) {
  open();
  const std::string name = (folder / "square-smooth").string();
  EXPECT_NE(command_line(session).find(" -o " + name + ".off "), std::string::npos);
  do_and_wait(SaveFile{name + ".off"});
  EXPECT_NE(command_line(session).find(" -o " + name + "-2.off "), std::string::npos)
      << command_line(session);
}

TEST_F(SessionTest, WhatWasSaidOfAMeshIsGoneWithIt) {
  const std::filesystem::path flawed = folder / "flawed.off";
  std::ofstream(flawed) << "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n3 0 1 2\n3 1 3 2\n3 0 1 4\n";
  do_and_wait(OpenFile{flawed});
  ASSERT_FALSE(session.messages.empty());
  open();
  EXPECT_TRUE(session.messages.empty()) << last_message();
}

TEST_F(SessionTest, CopyingTheCommandLineOfARunThatLeftAnotherSaysWhatItLeavesOut) {
  open();
  run(4);
  do_and_wait(CopyCommandLine{});
  EXPECT_EQ(session.messages.back().kind, MessageKind::info) << last_message();
  do_and_wait(Seek{2, {}});
  SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.7;
  do_and_wait(SetSmoothing{settings, "Area"});
  do_and_wait(model::Run{});
  do_and_wait(CopyCommandLine{});
  EXPECT_EQ(session.messages.back().kind, MessageKind::warning) << last_message();
  EXPECT_NE(last_message().find("iteration 2"), std::string::npos) << last_message();
}

TEST_F(SessionTest, CommandsBeforeAMeshIsOpenDoNoHarm) {
  for (const Command& command :
       {Command(model::Run{}), Command(Step{}), Command(Pause{}), Command(Reset{}), Command(StepBack{}),
        Command(Undo{}), Command(Redo{}), Command(Cancel{}), Command(SelectNextWorst{}),
        Command(CopyCommandLine{}), Command(SaveFile{folder / "x.off"})})
    do_and_wait(command);
  EXPECT_FALSE(session.current);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.off"));
}

TEST_F(SessionTest, ASessionCanEndWhileItsWorkerRuns) {
  open(20000);
  session.smoothing.iterations = 1000000;
  session.smoothing.tolerance = 0;
  execute(session, model::Run{});
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

}  // namespace
}  // namespace isorelax::model
