#include <gtest/gtest.h>

#include <functional>

#include "app/temporary_mesh.h"
#include "io/mesh_file.h"
#include "model/command.h"

namespace isorelax::model {
namespace {

/// A small sphere that moves, as the editor's panels ask for it.
class MotionTest : public ::testing::Test {
 protected:
  void act(const Command& command) {
    execute(session, command);
    finish(session);
  }
  void open_sphere(std::size_t vertices = 200) {
    SphereStart sphere;
    sphere.vertices = vertices;
    act(OpenSphere{sphere});
  }
  void set(const std::vector<std::string>& words) {
    MotionChoices motion;
    read_words(words, motion);
    act(SetMotion{motion, "test"});
  }
  [[nodiscard]] std::vector<Vec3> shown() const {
    const auto x = session.current->positions();
    return {x.begin(), x.end()};
  }
  [[nodiscard]] const Timeline& timeline() const { return session.timeline; }
  [[nodiscard]] std::string last_message() const {
    return session.messages.empty() ? std::string() : session.messages.back().text;
  }
  /// What advect does with these words: the states after every step.
  [[nodiscard]] static std::vector<std::vector<Vec3>> straight(std::vector<std::string> words,
                                                               std::size_t vertices = 200) {
    MotionChoices motion;
    read_words(words, motion);
    motion.sphere.emplace().vertices = vertices;
    std::vector<std::string> notes;
    MotionRun run(set_up_motion(motion, std::nullopt, notes), 0);
    std::vector<std::vector<Vec3>> states{run.surface().state().positions};
    while (!run.done()) {
      run.advance();
      states.push_back(run.surface().state().positions);
    }
    return states;
  }

  test::TemporaryFolder folder;
  Session session;
};

TEST_F(MotionTest, ARunIsTheOneOfAdvectToTheBitAndEveryStateComesBack) {
  for (const char* preset : {"balanced", "paper", "none"}) {
    const std::vector<std::string> words{"field", "paper:0.6", "step", "0.05", "preset", preset};
    open_sphere();
    set(words);
    act(Move{});
    const auto states = straight(words);
    ASSERT_EQ(timeline().last() + 1, states.size()) << preset;
    EXPECT_EQ(shown(), states.back()) << preset;
    for (const unsigned k : {3U, 12U, 0U, 7U, 8U}) {
      act(Seek{k, {}});
      EXPECT_EQ(session.current->iteration, k);
      EXPECT_EQ(shown(), states[k]) << preset << " " << k;
      EXPECT_NEAR(session.moment().time, 0.05 * k, 1e-12);
    }
    EXPECT_EQ(session.current->iteration, 8U);
  }
}

TEST_F(MotionTest, PausesStepsAndLooksBackDoNotChangeWhereItGoes) {
  const std::vector<std::string> words{"field", "enright:0.6", "step", "0.03"};
  const auto states = straight(words);
  open_sphere();
  set(words);
  act(Step{});
  execute(session, Move{});
  execute(session, Pause{});
  finish(session);
  const unsigned paused = timeline().last();
  EXPECT_LT(paused, states.size() - 1);
  EXPECT_EQ(shown(), states[paused]);
  act(Seek{1, {}});
  act(Step{});
  act(Move{2});
  act(Move{});
  ASSERT_EQ(timeline().branches.size(), 1U);
  ASSERT_EQ(timeline().last() + 1, states.size());
  EXPECT_EQ(shown(), states.back());
  act(Move{});
  EXPECT_NE(last_message().find("arrived"), std::string::npos) << last_message();
}

TEST_F(MotionTest, StepsChosenByTheirErrorsAreThoseOfAdvect) {
  const std::vector<std::string> words{"field", "paper:0.4", "tolerance", "1e-6", "preset", "accuracy"};
  const auto states = straight(words);
  open_sphere();
  set(words);
  act(Move{2});
  act(Move{});
  ASSERT_EQ(timeline().last() + 1, states.size());
  EXPECT_EQ(shown(), states.back());
  EXPECT_DOUBLE_EQ(session.moment().time, 0.4);
}

TEST_F(MotionTest, AFieldThatFailsEndsTheRunWithTimeAndVertexAndLeavesWhatWasRecorded) {
  open_sphere();
  const std::vector<Vec3> start = shown();
  set({"field", "expr:1/max(0,0.25-t);0;0", "step", "0.1", "until", "1"});
  act(Move{});
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
  EXPECT_NE(last_message().find("at time 0.25, vertex 0"), std::string::npos) << last_message();
  EXPECT_FALSE(session.is_running());
  ASSERT_EQ(timeline().last(), 2U);
  EXPECT_DOUBLE_EQ(session.moment().time, 0.2);
  const std::vector<Vec3> last = shown();
  act(Seek{0, {}});
  EXPECT_EQ(shown(), start);
  act(Seek{2, {}});
  EXPECT_EQ(shown(), last);
}

TEST_F(MotionTest, AMotionThatCannotBeginLeavesEverythingAsItWas) {
  open_sphere();
  for (const char* field : {"expr:0/0;0;0", "file:/nowhere.vtk", "expr:x+;y;z"}) {
    const std::vector<Vec3> before = shown();
    set({"field", field});
    act(Move{});
    EXPECT_EQ(session.messages.back().kind, MessageKind::error) << field;
    EXPECT_TRUE(timeline().empty()) << field;
    EXPECT_EQ(session.moving(), nullptr) << field;
    EXPECT_EQ(shown(), before) << field;
    EXPECT_EQ(session.activity, Activity::idle) << field;
  }
}

TEST_F(MotionTest, OtherSettingsBeginAnotherMotionAtTheSameStartAndBothGoOnToTheBit) {
  const std::vector<std::string> balanced{"field", "paper:0.6", "step", "0.05"};
  const std::vector<std::string> none{"field", "paper:0.6", "step", "0.05", "preset", "none"};
  open_sphere();
  set(balanced);
  act(Move{5});
  set(none);
  act(Move{});
  ASSERT_EQ(timeline().branches.size(), 2U);
  EXPECT_EQ(timeline().branches[1].start, 0U);
  EXPECT_EQ(shown(), straight(none).back());
  // The first one is taken up from its last state.
  act(Seek{3, 0U});
  EXPECT_EQ(session.motion.preset, "balanced") << "a run brings its settings";
  act(Move{});
  EXPECT_EQ(timeline().cursor.branch, 0U);
  const auto states = straight(balanced);
  ASSERT_EQ(timeline().branches[0].tip() + 1, states.size());
  EXPECT_EQ(shown(), states.back());
  act(Seek{6, {}});
  EXPECT_EQ(shown(), states[6]);
}

TEST_F(MotionTest, MotionsStandSideBySideAtTheSameTime) {
  open_sphere();
  set({"field", "paper:0.6", "step", "0.05"});
  act(Move{});
  set({"field", "paper:0.6", "step", "0.1", "preset", "none"});
  act(Move{});
  act(ShowBranches{{0}});
  act(Seek{2, {}});
  EXPECT_NEAR(session.moment().time, 0.2, 1e-12);
  ASSERT_EQ(session.other_states.size(), 1U);
  const auto beside = session.other_states[0]->positions();
  act(Seek{4, 0U});
  EXPECT_NEAR(session.moment().time, 0.2, 1e-12);
  EXPECT_TRUE(std::ranges::equal(shown(), beside));
}

TEST_F(MotionTest, ASmoothedMeshMovesFromWhereItStandsAndAMovedOneIsNotSmoothed) {
  act(OpenFile{folder.make_square()});
  SmoothingSettings settings = session.smoothing;
  settings.iterations = 3;
  act(SetSmoothing{settings, "test"});
  act(model::Run{});
  const std::vector<Vec3> smoothed = shown();
  set({"field", "rigid:0,0,0+1,0,0", "preset", "none", "step", "0.5"});
  act(Move{});
  EXPECT_EQ(session.current->iteration, 5U);
  for (std::size_t v = 0; v < smoothed.size(); ++v)
    EXPECT_LT((shown()[v] - smoothed[v] - Vec3::UnitX()).norm(), 1e-12);
  act(SetTask{Task::smooth});
  act(Step{});
  EXPECT_NE(last_message().find("Smoothing keeps to the mesh as opened"), std::string::npos);
  EXPECT_EQ(session.current->iteration, 5U);
  act(Seek{3, {}});
  EXPECT_EQ(shown(), smoothed);
  act(Step{});
  EXPECT_EQ(session.current->iteration, 4U) << last_message();
  EXPECT_EQ(session.moving(), nullptr);
}

TEST_F(MotionTest, TheInspectorTellsMotionFromRedistribution) {
  open_sphere();
  for (const char* preset : {"balanced", "paper", "none"}) {
    set({"field", "rigid:0,0,0.2+0.5,0,0", "preset", preset, "step", "0.1"});
    act(Move{4});
    act(SelectVertex{7});
    const auto& vertex = session.inspection.moving_vertex;
    ASSERT_TRUE(vertex) << preset;
    EXPECT_LT((vertex->by_motion + vertex->by_redistribution - vertex->after + vertex->before).norm(), 1e-15);
    EXPECT_NEAR(vertex->by_motion.norm(), 0.05, 0.02) << preset;
    if (std::string(preset) == "none") {
      EXPECT_EQ(vertex->by_redistribution.norm(), 0);
    }
    const auto& path = session.inspection.moving_path;
    ASSERT_TRUE(path) << preset;
    ASSERT_EQ(path->by_motion.size(), 5U);
    EXPECT_NEAR(path->distance[4], (shown()[7] - session.original->positions()[7]).norm(), 1e-15);
    EXPECT_GE(path->by_motion[4] + path->by_redistribution[4], path->distance[4] - 1e-12);
    act(ClearSelection{});
  }
}

TEST_F(MotionTest, ATriangleIsMeasuredAgainstTheMotionsReference) {
  open_sphere();
  set({"field", "normal:0.1", "preset", "none", "step", "0.25"});
  act(Move{});
  act(SelectTriangle{11});
  ASSERT_TRUE(session.inspection.moving_triangle);
  const MovingTriangle grown = *session.inspection.moving_triangle;
  EXPECT_NEAR(grown.step.after.metrics.area / grown.area_start, (0.25 / 0.15) * (0.25 / 0.15), 0.15);
  EXPECT_GT(grown.step.after.area, 2.01);
  act(Seek{0, {}});
  const MovingTriangle start = *session.inspection.moving_triangle;
  EXPECT_NEAR(start.step.after.shape, 2, 1e-12);
  EXPECT_NEAR(start.step.after.area, 2, 1e-12);
  EXPECT_EQ(start.step.reference_area, start.area_start);
  act(SetStage{Stage{}});
  EXPECT_FALSE(timeline().cursor.stage) << "its steps have none";
}

TEST_F(MotionTest, ColoursHaveOneRangeThatHoldsAllMoments) {
  open_sphere();
  EXPECT_EQ(session.view.coloring, Coloring::min_angle);
  set({"field", "paper:0.8", "step", "0.05", "preset", "none"});
  EXPECT_EQ(session.view.coloring, Coloring::relative_area);
  act(Move{});
  const ValueRange range = session.color_range();
  double widest = 0;
  for (unsigned k = 0; k <= timeline().last(); ++k) {
    act(Seek{k, {}});
    EXPECT_EQ(session.color_range(), range) << k;
    const ValueRange own = session.current->range(Coloring::relative_area);
    EXPECT_GE(own.low, range.low * (1 - 1e-9)) << k;
    EXPECT_LE(own.high, range.high * (1 + 1e-9)) << k;
    widest = std::max(widest, own.high);
  }
  EXPECT_NEAR(widest, range.high, 1e-9 * widest);
}

TEST_F(MotionTest, BreakpointsSeeTimeAndStopAlsoOverWhatIsRecorded) {
  open_sphere();
  set({"field", "paper:0.6", "step", "0.05"});
  act(SetBreakpoints{{make_breakpoint("time > 0.22 && vertex(3).move > 0", BreakAction::stop)}});
  act(Move{});
  EXPECT_EQ(session.current->iteration, 5U) << last_message();
  act(SetBreakpoints{});
  act(Move{});
  EXPECT_EQ(session.current->iteration, 12U);
  act(Seek{0, {}});
  act(SetBreakpoints{{make_breakpoint("time > 0.12", BreakAction::stop)}});
  act(Move{});
  EXPECT_EQ(session.current->iteration, 3U);
  ASSERT_FALSE(session.hits.empty());
}

TEST_F(MotionTest, UndoResetAndSaveAreThoseOfEveryRun) {
  open_sphere();
  const std::vector<Vec3> start = shown();
  set({"field", "shear:0.5", "step", "0.25"});
  act(Move{2});
  const std::vector<Vec3> half = shown();
  act(SaveFile{folder / "half.ply"});
  EXPECT_EQ(read_mesh(folder / "half.ply").mesh.positions, half);
  EXPECT_FALSE(session.has_unsaved_changes());
  act(Undo{});
  EXPECT_EQ(shown(), start);
  act(Redo{});
  EXPECT_EQ(shown(), half);
  EXPECT_NEAR(session.moment().time, 0.5, 1e-12);
  act(Reset{});
  EXPECT_EQ(shown(), start);
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  act(Undo{});
  EXPECT_EQ(shown(), half);
  set({"field", "shear:0.7"});
  act(Undo{});
  EXPECT_EQ(session.motion.field.rate, 0.5);
  act(Move{});
  EXPECT_EQ(session.current->iteration, 4U);
  EXPECT_EQ(timeline().branches.size(), 1U);
}

TEST_F(MotionTest, TheStartOfAMotionIsSmoothedAsTheMeshThatItIs) {
  open_sphere();
  act(SetTask{Task::smooth});
  act(Step{});
  const double energy = session.history.front().energy;
  const std::vector<Vec3> smoothed = shown();
  open_sphere();
  set({"field", "shear:0.5", "step", "0.5"});
  act(Move{});
  act(Seek{0, {}});
  EXPECT_NE(session.current->energy->total, energy);
  act(SetTask{Task::smooth});
  act(Step{});
  EXPECT_EQ(shown(), smoothed);
  EXPECT_EQ(session.timeline.current()->rows.front().energy, energy);
}

TEST_F(MotionTest, WithoutAMeshThePapersSphereMoves) {
  set({"field", "paper:0.02", "preset", "none"});
  act(Move{1});
  ASSERT_TRUE(session.document);
  EXPECT_EQ(session.document->mesh().vertex_count(), 5832U);
  EXPECT_EQ(session.current->iteration, 1U);
}

TEST_F(MotionTest, TheErrorIsKnownOfAPlainSphereAndItsCommandIsAdvects) {
  open_sphere();
  set({"field", "paper:0.2", "step", "0.05"});
  act(Move{});
  EXPECT_TRUE(session.moment().error);
  EXPECT_LT(session.moment().error->max, 1e-3);
  EXPECT_EQ(
      command_line(session),
      "isorelax advect -o sphere-200-moved --sphere 200:0.15:0.5,0.75,0.5 --field paper:0.2 --step 0.05");
}

}  // namespace
}  // namespace isorelax::model
