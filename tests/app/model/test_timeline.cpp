#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/model/session_fixture.h"
#include "io/mesh_file.h"
#include "model/arguments.h"
#include "model/command.h"
#include "trace/trace_file.h"

namespace isorelax::model {
namespace {

class TimelineTest : public SessionFixture {
 protected:
  void open(std::size_t triangles = 400) { act(OpenFile{folder.make_square(triangles)}); }
  void run(unsigned iterations) {
    set([&](SmoothingSettings& s) {
      s.iterations = iterations;
      s.tolerance = 0;
    });
    act(model::Run{});
  }
};

TEST_F(TimelineTest, ARunIsRecordedAndEveryIterationComesBackToTheBit) {
  open();
  std::vector<std::vector<Vec3>> seen{shown()};
  for (int k = 0; k < 12; ++k) {
    act(Step{});
    seen.push_back(shown());
  }
  ASSERT_EQ(timeline().branches.size(), 1U) << "steps with one setting are one run";
  EXPECT_EQ(timeline().last(), 12U);
  for (const unsigned k : {3U, 12U, 0U, 7U, 8U}) {
    act(Seek{k, {}});
    EXPECT_EQ(session.current->iteration, k);
    EXPECT_EQ(shown(), seen[k]) << k;
  }
  act(Seek{99, {}});
  EXPECT_EQ(session.current->iteration, 12U) << "no further than there is";
}

TEST_F(TimelineTest, TheStartAndASavedIterationAreTheStatesTheyWere) {
  open();
  run(4);
  act(Seek{2, {}});
  act(SaveFile{folder / "two.off"});
  act(Seek{4, {}});
  EXPECT_TRUE(session.has_unsaved_changes());
  act(Seek{2, {}});
  EXPECT_FALSE(session.has_unsaved_changes()) << "the file holds this iteration";
  act(Seek{0, {}});
  EXPECT_EQ(session.current->geometry, session.original->geometry);
}

TEST_F(TimelineTest, OtherSettingsBeginABranchAndSeekingGoesBetweenBranches) {
  open();
  run(6);
  const std::vector<Vec3> straight = shown();
  act(Seek{3, {}});
  const std::vector<Vec3> fork = shown();
  set([](SmoothingSettings& s) { s.mu_a = 0.5; });
  run(4);
  ASSERT_EQ(timeline().branches.size(), 2U);
  EXPECT_EQ(timeline().branches[1].start, 3U);
  EXPECT_EQ(timeline().branches[1].parent, 0U);
  EXPECT_EQ(timeline().branches[1].tip(), 7U);
  EXPECT_NE(timeline().branches[1].name.find("0.50"), std::string::npos) << timeline().branches[1].name;
  const std::vector<Vec3> forked = shown();
  EXPECT_NE(forked, straight);
  act(Seek{3, {}});
  EXPECT_EQ(shown(), fork) << "the branch shares what came before it";
  act(Seek{2, {}});
  act(Seek{6, 0});
  EXPECT_EQ(shown(), straight);
  EXPECT_EQ(session.smoothing.mu_a, 0) << "a branch brings its settings";
  act(Seek{7, 1});
  EXPECT_EQ(shown(), forked);
  EXPECT_EQ(session.smoothing.mu_a, 0.5);
  EXPECT_EQ(session.history.size(), 3U + 1 + 1 + 4) << "rows to the fork, both energies there, and on";
}

TEST_F(TimelineTest, WhatIsRecordedIsNotRunAgain) {
  open();
  run(6);
  const std::vector<Vec3> end = shown();
  act(Seek{2, {}});
  run(4);
  EXPECT_EQ(timeline().branches.size(), 1U);
  EXPECT_EQ(timeline().last(), 6U);
  EXPECT_EQ(shown(), end);
  act(Seek{1, {}});
  run(7);
  EXPECT_EQ(timeline().last(), 8U) << "five recorded ones and two more";
}

TEST_F(TimelineTest, UndoLeavesTheRecordingAndRedoFindsItsPlace) {
  open();
  run(5);
  act(Undo{});
  EXPECT_EQ(timeline().cursor.iteration, 0U);
  EXPECT_EQ(timeline().last(), 5U);
  act(Redo{});
  EXPECT_EQ(timeline().cursor.iteration, 5U);
  act(Seek{2, {}});
  EXPECT_EQ(session.current->iteration, 2U);
}

TEST_F(TimelineTest, ASelectedVertexIsExplainedAtEveryIteration) {
  open();
  run(4);
  const Index v = 130;
  act(SelectVertex{v});
  ASSERT_TRUE(session.inspection.vertex);
  const auto last = shown();
  EXPECT_EQ(session.inspection.vertex->after, last[v]);
  EXPECT_LT(session.inspection.vertex->share_error, kShareErrorLimit);
  act(Seek{2, {}});
  EXPECT_EQ(session.inspection.vertex->after, shown()[v]);
  ASSERT_TRUE(session.inspection.path);
  EXPECT_EQ(session.inspection.path->positions.size(), 5U);
  EXPECT_EQ(session.inspection.path->positions[4], last[v]);
  act(SelectTriangle{7});
  EXPECT_FALSE(session.inspection.vertex);
  ASSERT_TRUE(session.inspection.triangle);
  EXPECT_EQ(session.inspection.triangle->triangle, 7U);
  act(SelectVertex{1000000});
  EXPECT_NE(session.messages.back().text.find("no vertex"), std::string::npos);
}

TEST_F(TimelineTest, BeforeAnythingWasRunTheFirstStepIsExplained) {
  open();
  act(SelectVertex{130});
  ASSERT_TRUE(session.inspection.vertex);
  const Vec3 predicted = session.inspection.vertex->after;
  act(Step{});
  EXPECT_EQ(shown()[130], predicted);
}

TEST_F(TimelineTest, WithoutMemoryForRecordsStepsAreDoneAgainToTheBit) {
  for (const Solver solver : {Solver::jacobi, Solver::newton, Solver::lbfgs, Solver::automatic}) {
    open();
    set([&](SmoothingSettings& s) { s.solver = solver; });
    run(7);
    act(Pause{});
    run(5);  // paused and continued
    act(Seek{9, {}});
    act(SelectVertex{130});
    const auto kept = session.inspection.step->record;
    act(SetStepBudget{0});
    act(Seek{11, {}});
    act(Seek{9, {}});
    ASSERT_TRUE(session.inspection.step);
    EXPECT_EQ(session.inspection.step->mismatch, "");
    EXPECT_NE(session.inspection.step->record, kept) << "it was not kept";
    EXPECT_EQ(session.inspection.step->record->alpha, kept->alpha);
    EXPECT_EQ(session.inspection.step->record->displacement, kept->displacement);
    act(SetStepBudget{StepStore::kDefaultBudget});
  }
}

TEST_F(TimelineTest, StagesGoThroughAStepAndOverItsEnds) {
  open();
  run(2);
  act(Seek{1, {}});
  act(StepStage{1});
  ASSERT_TRUE(timeline().cursor.stage);
  EXPECT_EQ(timeline().cursor.stage->kind, StageKind::gradient);
  ASSERT_TRUE(session.inspection.step && session.inspection.step->before_state);
  EXPECT_EQ(session.inspection.step->before_state->iteration, 0U) << "inside a step the mesh is not moved";
  const unsigned passes =
      timeline().branches[0].steps[0].fold_passes + timeline().branches[0].steps[0].energy_passes;
  for (unsigned k = 0; k < 2 + passes; ++k) act(StepStage{1});
  EXPECT_EQ(timeline().cursor.stage->kind, passes > 0 ? StageKind::control : StageKind::proposed);
  act(StepStage{1});
  EXPECT_EQ(timeline().cursor.stage->kind, StageKind::moved);
  act(StepStage{1});
  EXPECT_EQ(timeline().cursor.iteration, 2U);
  EXPECT_EQ(timeline().cursor.stage->kind, StageKind::gradient);
  act(StepStage{-1});
  EXPECT_EQ(timeline().cursor.iteration, 1U);
  EXPECT_EQ(timeline().cursor.stage->kind, StageKind::moved);
}

TEST_F(TimelineTest, ABreakpointStopsARunAndALogOnlyTells) {
  open();
  act(SetBreakpoints{{make_breakpoint("iteration == 3", BreakAction::stop),
                      make_breakpoint("moved > 0", BreakAction::log)}});
  run(10);
  EXPECT_EQ(session.current->iteration, 3U);
  EXPECT_EQ(session.broken_by, "iteration == 3");
  EXPECT_EQ(session.hits.size(), 4U);
  act(model::Run{});
  EXPECT_EQ(timeline().last(), 10U) << "a stopped run goes on";
  session.hits.clear();
  act(Seek{0, {}});
  run(8);
  EXPECT_EQ(session.current->iteration, 3U) << "also over what is recorded";
  EXPECT_EQ(timeline().branches.size(), 1U);
}

TEST_F(TimelineTest, TheEndOfARunIsFoundWhereItIsRecorded) {
  open();
  run(4);
  act(SetBreakpoints{{make_breakpoint("stop", BreakAction::stop)}});
  act(Seek{0, {}});
  act(model::Run{});
  EXPECT_EQ(session.broken_by, "stop");
  EXPECT_EQ(timeline().cursor.iteration, 4U);
  // Where the run goes on after what is recorded, its end is another one.
  act(Seek{1, {}});
  run(6);
  EXPECT_EQ(session.broken_by, "stop");
  EXPECT_EQ(timeline().cursor.iteration, 7U);
}

TEST_F(TimelineTest, OnlyTheNewestHitsAreKept) {
  open(30);
  const std::vector<Breakpoint> logs(300, make_breakpoint("iteration > 0", BreakAction::log));
  act(SetBreakpoints{logs});
  run(5);
  EXPECT_EQ(session.hits.size(), 1000U);
  EXPECT_EQ(session.hits.back().iteration, 5U);
}

TEST_F(TimelineTest, AMistakeInABreakpointHasItsPlace) {
  const Breakpoint bad = make_breakpoint("min_angle < fife", BreakAction::stop);
  EXPECT_FALSE(bad.predicate);
  EXPECT_EQ(bad.mistake_column, 13U);
  EXPECT_NE(bad.mistake.find("fife"), std::string::npos);
}

TEST_F(TimelineTest, APinnedVertexStaysAndSaysSo) {
  open();
  act(TogglePin{130});
  const std::vector<Vec3> before = shown();
  run(3);
  EXPECT_EQ(shown()[130], before[130]);
  act(SelectVertex{130});
  EXPECT_NE(session.inspection.vertex->limits & kLimitPinned, 0);
  act(TogglePin{130});
  EXPECT_TRUE(session.smoothing.pinned.empty());
}

TEST_F(TimelineTest, ATraceIsSavedAndOpenedWithEverythingInIt) {
  open();
  run(5);
  act(SelectVertex{130});
  const VertexExplanation before = *session.inspection.vertex;
  const std::vector<Vec3> end = shown();
  act(SaveTrace{folder / "run.trace"});
  Session other;
  execute(other, OpenFile{folder / "run.trace"});
  finish(other);
  ASSERT_EQ(other.timeline.branches.size(), 1U) << other.messages.back().text;
  EXPECT_EQ(other.timeline.last(), 5U);
  EXPECT_EQ(other.history.size(), 6U);
  execute(other, Seek{5, {}});
  finish(other);
  EXPECT_TRUE(std::ranges::equal(other.current->positions(), end));
  execute(other, SelectVertex{130});
  finish(other);
  ASSERT_TRUE(other.inspection.vertex);
  EXPECT_EQ(other.inspection.step->mismatch, "");
  EXPECT_EQ(other.inspection.vertex->alpha, before.alpha);
  EXPECT_EQ(other.inspection.vertex->gradient, before.gradient);
  EXPECT_EQ(other.smoothing.iterations, 5U);
}

TEST_F(TimelineTest, ADamagedTraceIsRefusedAndTheDocumentStays) {
  open();
  run(3);
  act(SaveTrace{folder / "run.trace"});
  std::string bytes;
  {
    std::ifstream file(folder / "run.trace", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  std::ofstream(folder / "bad.trace", std::ios::binary) << bytes;
  const DocumentPtr document = session.document;
  act(OpenFile{folder / "bad.trace"});
  EXPECT_EQ(session.document, document);
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
  EXPECT_NE(session.messages.back().text.find("byte"), std::string::npos) << session.messages.back().text;
}

TEST_F(TimelineTest, ARunOfAnotherMeshIsNotAdded) {
  open();
  run(2);
  act(SaveTrace{folder / "run.trace"});
  act(AddTrace{folder / "run.trace"});
  EXPECT_EQ(timeline().branches.size(), 2U);
  act(CompareBranches{0, 1});
  ASSERT_TRUE(session.comparison);
  EXPECT_TRUE(session.comparison->difference.none());
  act(OpenFile{folder.make_square(100, "other.off")});
  act(AddTrace{folder / "run.trace"});
  EXPECT_TRUE(timeline().empty());
  EXPECT_EQ(session.messages.back().kind, MessageKind::error);
}

TEST_F(TimelineTest, WhatIsFoundOutAboutOneMeshIsNotTakenForAnother) {
  open();
  run(3);
  act(SaveTrace{folder / "one.trace"});
  // Asked while the same file, which is another document now, is being read.
  execute(session, OpenFile{folder / "square.off"});
  execute(session, SelectVertex{3});
  execute(session, SetStage{Stage{}});
  execute(session, ShowBranches{{0}});
  execute(session, CompareBranches{0, 0});
  execute(session, AddTrace{folder / "one.trace"});
  finish(session);
  EXPECT_FALSE(session.inspection.step);
  EXPECT_FALSE(session.comparison);
  EXPECT_TRUE(timeline().empty());
  EXPECT_EQ(session.current->iteration, 0U);
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  EXPECT_NE(session.messages.back().text.find("another mesh was opened"), std::string::npos);
  EXPECT_FALSE(session.is_seeking());
}

TEST_F(TimelineTest, TwoBranchesPartWhereTheyForked) {
  open();
  run(4);
  act(Seek{2, {}});
  set([](SmoothingSettings& s) { s.boundary = BoundaryRule::slide; });
  run(2);
  act(CompareBranches{0, 1});
  ASSERT_TRUE(session.comparison);
  ASSERT_TRUE(session.comparison->difference.parting);
  EXPECT_EQ(session.comparison->difference.parting->iteration, 3U);
}

TEST_F(TimelineTest, TheThreeMethodsStandSideBySide) {
  open();
  set([](SmoothingSettings& s) {
    s.iterations = 3;
    s.tolerance = 0;
  });
  act(Teach{});
  ASSERT_EQ(timeline().branches.size(), 3U);
  EXPECT_EQ(timeline().branches[0].settings.method, Method::laplacian);
  EXPECT_EQ(timeline().branches[2].settings.method, Method::near_isometry);
  EXPECT_EQ(session.shown_branches, (std::vector<unsigned>{0, 1}));
  ASSERT_EQ(session.other_states.size(), 2U);
  EXPECT_EQ(session.other_states[0]->iteration, 3U);
  const auto at_three = session.other_states[0]->geometry;
  act(Seek{1, {}});
  EXPECT_NE(session.other_states[0]->geometry, at_three) << "they share the timeline";
}

TEST_F(TimelineTest, AComparisonOfMethodsIsTakenBackAtOnce) {
  open();
  run(2);
  const Cursor before = timeline().cursor;
  const auto positions = shown();
  act(Teach{});
  const std::size_t runs = timeline().branches.size();
  ASSERT_GT(runs, 2U);
  act(Undo{});
  EXPECT_EQ(timeline().branches.size(), 1U);
  EXPECT_TRUE(session.shown_branches.empty());
  EXPECT_TRUE(session.other_states.empty());
  EXPECT_EQ(timeline().cursor, before);
  EXPECT_EQ(shown(), positions);
  EXPECT_EQ(session.smoothing.method, Method::near_isometry);
  act(Redo{});
  EXPECT_EQ(timeline().branches.size(), runs);
  EXPECT_EQ(session.shown_branches.size(), 2U);
  EXPECT_EQ(session.other_states.size(), 2U);
  act(Seek{3, 1U});
  EXPECT_EQ(session.current->iteration, 3U);
  // What began in one of them since goes with it, though it is undone itself.
  set([](SmoothingSettings& s) { s.boundary = BoundaryRule::slide; });
  run(2);
  ASSERT_EQ(timeline().branches.size(), runs + 1);
  while (timeline().branches.size() > 1 && session.undo.next_undo() != nullptr) act(Undo{});
  EXPECT_EQ(timeline().branches.size(), 1U);
  while (session.undo.next_redo() != nullptr) act(Redo{});
  EXPECT_EQ(timeline().branches.size(), runs + 1);
  act(Seek{4, static_cast<unsigned>(runs)});
  EXPECT_EQ(session.current->iteration, 4U);
}

TEST_F(TimelineTest, AComparisonOfMethodsThatWasStoppedIsTakenBackAsWell) {
  open();
  set([](SmoothingSettings& s) {
    s.iterations = 100000;
    s.tolerance = 0;
  });
  execute(session, Teach{});
  while (timeline().empty() || timeline().branches.back().steps.empty()) execute(session, Collect{});
  execute(session, Pause{});
  finish(session);
  ASSERT_FALSE(timeline().empty());
  act(Undo{});
  EXPECT_TRUE(timeline().empty());
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  ASSERT_NE(session.undo.next_undo(), nullptr);
  EXPECT_EQ(session.undo.next_undo()->label, "test") << "nothing is left of it";
}

TEST_F(TimelineTest, ARunCanBeRemovedAndComesBack) {
  open();
  run(4);
  set([](SmoothingSettings& s) { s.solver = Solver::jacobi; });
  act(Seek{0, {}});
  act(model::Run{});
  act(Seek{2, {}});
  set([](SmoothingSettings& s) { s.boundary = BoundaryRule::slide; });
  act(model::Run{});
  ASSERT_EQ(timeline().branches.size(), 3U);
  const auto last = shown();
  EXPECT_NE(why_kept(session, 1), "") << "the third began at a step of it";
  act(RemoveRun{1});
  EXPECT_EQ(timeline().branches.size(), 3U);
  EXPECT_NE(session.messages.back().text.find("3  "), std::string::npos) << session.messages.back().text;
  // The second began at the start, which needs no step of the first.
  act(RemoveRun{0});
  ASSERT_EQ(timeline().branches.size(), 2U);
  EXPECT_EQ(timeline().cursor.branch, 1U);
  EXPECT_EQ(shown(), last);
  act(Seek{1, {}});
  EXPECT_EQ(session.current->iteration, 1U);
  act(Undo{});
  ASSERT_EQ(timeline().branches.size(), 3U);
  EXPECT_EQ(timeline().branches[1].parent, 0U);
  EXPECT_EQ(timeline().branches[2].parent, 1U);
  act(Redo{});
  act(RemoveRun{1});
  EXPECT_EQ(timeline().cursor.branch, 0U) << "where it began";
  EXPECT_EQ(timeline().cursor.iteration, 2U);
  act(RemoveRun{0});
  EXPECT_TRUE(timeline().empty());
  EXPECT_EQ(session.current->geometry, session.original->geometry);
  while (session.undo.next_undo() != nullptr) act(Undo{});
  while (session.undo.next_redo() != nullptr) act(Redo{});
  EXPECT_TRUE(timeline().empty());
}

TEST_F(TimelineTest, PositionsOfAnyFileAreNotLost) {
  open();
  run(4);
  act(SaveFile{folder / "four.off"});
  act(Seek{0, {}});
  EXPECT_FALSE(session.has_unsaved_changes()) << "the mesh as opened is on disk";
  EXPECT_FALSE(session.would_lose_work());
  act(Seek{3, {}});
  EXPECT_TRUE(session.has_unsaved_changes());
  act(Seek{4, {}});
  EXPECT_FALSE(session.has_unsaved_changes());
  // Where it was written over, it is not.
  act(SaveFile{folder / "square.off"});
  act(Seek{0, {}});
  EXPECT_TRUE(session.has_unsaved_changes());
}

TEST_F(TimelineTest, ABranchIsNamedByAllThatTheRunWhichItLeavesDoesOtherwise) {
  open();
  run(3);
  set([](SmoothingSettings& s) {
    s.solver = Solver::jacobi;
    s.mu_a = 0.5;
  });
  act(Seek{2, {}});
  act(Step{});
  EXPECT_EQ(timeline().branches[1].name, "\xCE\xBC\xE2\x82\x90 0.50, jacobi");
  // At iteration 1 it is the first run that is left, which has the automatic solver and no weight on areas.
  act(Seek{1, {}});
  set([](SmoothingSettings& s) { s.mu_a = 0; });
  act(Step{});
  EXPECT_EQ(timeline().branches[2].name, "jacobi");
}

TEST_F(TimelineTest, NothingCutsAMethodShortThatIsCompared) {
  open();
  set([](SmoothingSettings& s) {
    s.iterations = 40;
    s.tolerance = 0;
  });
  act(Step{});
  execute(session, Teach{});
  while (!session.is_running()) execute(session, Collect{});
  execute(session, Seek{0, 0U});
  EXPECT_NE(session.messages.back().text.find("being compared"), std::string::npos);
  finish(session);
  ASSERT_EQ(timeline().branches.size(), 3U);
  EXPECT_EQ(timeline().branches[1].tip(), 41U);
  EXPECT_EQ(timeline().branches[2].tip(), 41U);
  // Pause does end it, and then all can be done again.
  act(Seek{0, 0U});
  execute(session, Teach{});
  execute(session, Pause{});
  finish(session);
  act(Seek{3, 1U});
  EXPECT_EQ(timeline().cursor.branch, 1U);
}

TEST_F(TimelineTest, RunsChangePlacesAndNoneStandsBesideItself) {
  open();
  set([](SmoothingSettings& s) {
    s.iterations = 3;
    s.tolerance = 0;
  });
  act(Teach{});
  act(Seek{2, 0U});
  EXPECT_EQ(timeline().cursor.branch, 0U);
  EXPECT_EQ(session.shown_branches, (std::vector<unsigned>{2, 1}));
  EXPECT_EQ(session.other_states.size(), 2U);
  act(ShowBranches{{0, 1, 1}});
  EXPECT_EQ(session.shown_branches, (std::vector<unsigned>{1}));
}

TEST_F(TimelineTest, ARunThatHasEndedShowsItsEndBesideLongerOnes) {
  open();
  run(6);
  const auto at_six = shown();
  act(Seek{0, {}});
  set([](SmoothingSettings& s) {
    s.method = Method::laplacian;
    s.iterations = 2;
  });
  act(model::Run{});
  act(Seek{6, {}});
  EXPECT_EQ(session.shared_iteration(), 2U) << "alone it has no more than its own";
  act(ShowBranches{{0}});
  EXPECT_EQ(session.shared_last(), 6U);
  act(Seek{6, {}});
  EXPECT_EQ(session.shared_iteration(), 6U);
  EXPECT_EQ(session.current->iteration, 2U);
  ASSERT_EQ(session.other_states.size(), 1U);
  EXPECT_TRUE(std::ranges::equal(session.other_states[0]->positions(), at_six));
  act(StepBack{});
  act(StepBack{});
  EXPECT_EQ(session.shared_iteration(), 4U);
  act(Step{});
  EXPECT_EQ(session.shared_iteration(), 5U) << "no new one while those beside it have more";
  act(Seek{session.shared_iteration(), 0U});
  EXPECT_EQ(session.current->iteration, 5U);
  act(Seek{1, {}});
  EXPECT_EQ(session.shared_iteration(), 1U);
}

TEST_F(TimelineTest, WorstTrianglesComeByAnyMetric) {
  open();
  for (std::size_t k = 0; k < kWorstBy; ++k) {
    if (static_cast<WorstBy>(k) == WorstBy::inverted) continue;
    act(SetWorstBy{static_cast<WorstBy>(k)});
    act(SelectNextWorst{});
    ASSERT_TRUE(session.selected_triangle) << title(session.worst_by);
    const Index first = *session.selected_triangle;
    act(SelectNextWorst{});
    EXPECT_NE(session.selected_triangle, first);
    EXPECT_EQ(session.rank_of_worst(), 2U);
  }
}

TEST_F(TimelineTest, ATriangleIsNoLongerOneOfTheWorstOnceTheMeshIsAnother) {
  open();
  act(SelectNextWorst{});
  act(SelectNextWorst{});
  EXPECT_EQ(session.rank_of_worst(), 2U);
  act(Step{});
  EXPECT_TRUE(session.selected_triangle);
  EXPECT_EQ(session.rank_of_worst(), 0U);
  act(SelectNextWorst{});
  EXPECT_EQ(session.rank_of_worst(), 1U) << "from the worst on";
}

TEST_F(TimelineTest, RunsBesideFollowUndoAndReset) {
  open();
  act(Step{});
  act(Step{});
  act(Seek{0, {}});
  SmoothingSettings settings = session.smoothing;
  settings.method = Method::laplacian;
  act(SetSmoothing{settings, "Solver"});
  act(Step{});
  act(ShowBranches{{0}});
  act(Reset{});
  ASSERT_EQ(session.other_states.size(), 1U);
  EXPECT_EQ(session.other_states[0]->iteration, 0U);
  act(Undo{});
  ASSERT_EQ(session.other_states.size(), 1U);
  EXPECT_EQ(session.other_states[0]->iteration, 1U);
  while (session.timeline.cursor.branch != 0 && session.undo.next_undo() != nullptr) act(Undo{});
  EXPECT_EQ(session.timeline.cursor.branch, 0U);
  EXPECT_TRUE(session.shown_branches.empty()) << "a run does not stand beside itself";
}

TEST_F(TimelineTest, AFoldedCornerIsFoundAmongAllTriangles) {
  open();
  TriangleMesh mesh = session.document->mesh();
  const Index v = 130;
  Vec3 far = Vec3::Zero();  // over the far side of one of its triangles
  const Corner c = session.document->topology.corners_of(v)[0];
  const Triangle& t = mesh.triangles[c / 3];
  for (const Index corner : t)
    if (corner != v) far += mesh.positions[corner];
  mesh.positions[v] = far - mesh.positions[v];
  (void)write_mesh(folder / "folded.off", mesh);
  act(OpenFile{folder / "folded.off"});
  act(SetWorstBy{WorstBy::inverted});
  unsigned found = 0;
  for (act(SelectNextWorst{}); session.selected_triangle; act(SelectNextWorst{})) {
    ++found;
    const Triangle& at = mesh.triangles[*session.selected_triangle];
    EXPECT_TRUE(std::ranges::find(at, v) != at.end()) << "all of them are around the moved vertex";
  }
  EXPECT_GT(found, 0U);
}

TEST(StepStore, ARecordingHasNoStepsOfOneThatIsGone) {
  StepStore store;
  auto recording = std::make_unique<Recording>();
  store.add(recording->number(), 1, std::make_shared<StepRecord>());
  EXPECT_TRUE(store.find(recording->number(), 1));
  recording.reset();
  recording = std::make_unique<Recording>();  // at the same address, as like as not
  EXPECT_FALSE(store.find(recording->number(), 1));
}

TEST_F(TimelineTest, TheWordsOfSettingsReadBackAsTheSettings) {
  SmoothingSettings settings;
  settings.solver = Solver::lbfgs;
  settings.exponent = 4;
  settings.mu_a = 0.1;
  settings.reference = ReferenceKind::edge_length;
  settings.edge_length = 0.25;
  settings.boundary = BoundaryRule::slide;
  settings.features = FeatureRule::angle;
  settings.feature_deg = 42;
  settings.pinned = {3, 17};
  settings.iterations = 7;
  settings.tolerance = 0;
  const auto words = to_words(settings);
  ASSERT_TRUE(from_words(words));
  EXPECT_EQ(*from_words(words), settings);
  EXPECT_FALSE(from_words(std::vector<std::string>{"--unheard-of", "1"}));
  EXPECT_FALSE(from_words(std::vector<std::string>{"--mu", "much"}));
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--mu", "7"},
                                             {"--mu", "-0.1"},
                                             {"--mu", "nan"},
                                             {"--exponent", "0.5"},
                                             {"--tolerance", "-1"},
                                             {"--features", "200"},
                                             {"--reference", "equilateral:0"}})
    EXPECT_FALSE(from_words(wrong)) << wrong[0] << " " << wrong[1];
}

}  // namespace
}  // namespace isorelax::model
