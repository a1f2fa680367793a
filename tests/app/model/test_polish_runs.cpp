#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "app/model/session_fixture.h"
#include "generate/generate.h"
#include "model/arguments.h"

namespace isorelax::model {
namespace {

/// Runs that a last stage follows, and runs that keep a distance.
class PolishRunTest : public SessionFixture {
 protected:
  void open_torus() { open(torus); }

  TriangleMesh torus = generate(ShapeKind::torus, {.seed = 3, .triangles = 140, .jitter = 0.3});
};

TEST_F(PolishRunTest, APolishFollowsTheRunAsABranchOfItsOwn) {
  act(OpenFile{folder.make_square(400)});
  set([](SmoothingSettings& s) { s.polish = Polish::worst; });
  act(model::Run{});
  ASSERT_EQ(timeline().branches.size(), 2U);
  const Branch& polish = timeline().branches[1];
  EXPECT_EQ(polish.kind, PartKind::polish);
  EXPECT_EQ(polish.parent, 0U);
  EXPECT_EQ(polish.start, timeline().branches[0].tip());
  EXPECT_EQ(polish.name, "Polish, worst angles");
  EXPECT_EQ(timeline().cursor.branch, 1U);
  const double polished = session.current->quality().min_angle_deg;
  act(Undo{});
  EXPECT_EQ(session.current->iteration, polish.start) << "the polish is undone by itself";
  EXPECT_GT(polished, session.current->quality().min_angle_deg + 0.5);
}

TEST_F(PolishRunTest, TheStatesAreThoseOfABoundedRunToTheBit) {
  open_torus();
  set([](SmoothingSettings& s) {
    s.polish = Polish::worst;
    s.reach = Reach::nearest;
  });
  act(model::Run{});
  EXPECT_EQ(shown(), smoothed(torus, {.max = {}, .automatic = AutomaticLimit::nearest},
                              PolishOptions{.goal = PolishGoal::worst}));
}

TEST_F(PolishRunTest, OneStepIsNotPolishedAndAPolishGoesOnStepByStep) {
  act(OpenFile{folder.make_square(400)});
  set([](SmoothingSettings& s) {
    s.polish = Polish::worst;
    s.iterations = 15;
  });
  act(Step{});
  EXPECT_EQ(timeline().branches.size(), 1U);
  act(SetBreakpoints{{make_breakpoint("iteration == 20", BreakAction::stop)}});
  act(model::Run{});
  EXPECT_EQ(session.current->iteration, 20U) << "in the middle of the polish";
  ASSERT_EQ(timeline().branches.size(), 2U);
  act(Step{});
  EXPECT_EQ(session.current->iteration, 21U);
  act(model::Run{});
  EXPECT_EQ(timeline().branches.size(), 2U) << "one polish, broken off and continued";
  const std::vector<Vec3> broken_off = shown();
  act(Reset{});
  act(SetBreakpoints{{}});
  set([](SmoothingSettings& s) { s.iterations = 16; });
  session.timeline = {};
  act(model::Run{});
  EXPECT_EQ(shown(), broken_off);
}

TEST_F(PolishRunTest, ARunThatHasEndedIsPolishedWithoutAnotherStep) {
  act(OpenFile{folder.make_square(400)});
  act(model::Run{});
  const unsigned end = timeline().last();
  set([](SmoothingSettings& s) { s.polish = Polish::mean; });
  act(model::Run{});
  ASSERT_EQ(timeline().branches.size(), 2U);
  EXPECT_EQ(timeline().branches[1].start, end);
  EXPECT_EQ(timeline().branches[1].name, "Polish, mean");
  // Going back over it and on again makes nothing anew.
  const unsigned last = timeline().last();
  act(Seek{end, {}});
  act(model::Run{});
  EXPECT_EQ(session.current->iteration, last);
  EXPECT_EQ(timeline().branches.size(), 2U);
}

TEST_F(PolishRunTest, ItsStepsAreExplainedDoneAgainAndSaved) {
  act(OpenFile{folder.make_square(400)});
  act(SetStepBudget{0});
  set([](SmoothingSettings& s) { s.polish = Polish::both; });
  act(model::Run{});
  const unsigned start = timeline().branches[1].start;
  act(SelectVertex{130});
  for (const unsigned k : {start, start + 2, timeline().last()}) {
    act(Seek{k, {}});
    ASSERT_TRUE(session.inspection.step && session.inspection.vertex) << k;
    EXPECT_EQ(session.inspection.step->mismatch, "") << k;
  }
  act(SaveTrace{folder / "polished.trace"});
  Session other;
  execute(other, OpenFile{folder / "polished.trace"});
  finish(other);
  EXPECT_EQ(other.smoothing, session.smoothing);
  execute(other, SelectVertex{130});
  execute(other, Seek{start + 2, {}});
  finish(other);
  ASSERT_TRUE(other.inspection.step) << other.messages.back().text;
  EXPECT_EQ(other.inspection.step->mismatch, "");
  EXPECT_NE(other.inspection.step->made_with.find("polish"), std::string::npos);
}

TEST_F(PolishRunTest, EveryStepKeepsTheDistanceAndSaysWhomItHeldBack) {
  open_torus();
  double before = 1;
  for (const double limit : {0.01, 0.004}) {
    set([&](SmoothingSettings& s) {
      s.reach = Reach::typed;
      s.max_deviation = limit;
      s.polish = Polish::worst;
    });
    act(model::Run{});
    ASSERT_TRUE(session.surface && session.last_step);
    EXPECT_EQ(session.surface->limit, limit);
    EXPECT_LE(session.surface->deviation.max, limit);
    EXPECT_LT(session.surface->deviation.max, before);
    before = session.surface->deviation.max;
    act(Seek{2, {}});
    EXPECT_GT(session.last_step->limits[6], 0U) << "of Limit: surface";
    act(Reset{});
  }
}

TEST_F(PolishRunTest, WordsReadBackAsTheSettings) {
  SmoothingSettings settings;
  for (const Polish polish : {Polish::none, Polish::worst, Polish::mean, Polish::both}) {
    for (const Reach reach : {Reach::nearest, Reach::widest, Reach::any, Reach::typed}) {
      settings.polish = polish;
      settings.reach = reach;
      settings.max_deviation = reach == Reach::typed ? 0.0125 : SmoothingSettings().max_deviation;
      const auto words = to_words(settings);
      ASSERT_TRUE(from_words(words));
      EXPECT_EQ(*from_words(words), settings);
    }
  }
  for (const Method method : {Method::laplacian, Method::angle_based}) {
    settings.method = method;
    const auto words = to_words(settings);
    EXPECT_EQ(std::ranges::find(words, "--mu"), words.end())
        << "smooth knows none of a method without energy";
    EXPECT_EQ(*from_words(words), settings);
  }
  EXPECT_FALSE(from_words(std::vector<std::string>{"--polish", "all"}));
  EXPECT_FALSE(from_words(std::vector<std::string>{"--max-deviation", "far"}));
  EXPECT_FALSE(from_words(std::vector<std::string>{"--max-deviation", "-1"}));
}

TEST_F(PolishRunTest, WhatIsRecordedIsNotPolishedAnew) {
  act(OpenFile{folder.make_square(400)});
  for (const unsigned iterations : {1000U, 5U}) {
    set([&](SmoothingSettings& s) {
      s.polish = Polish::worst;
      s.iterations = iterations;
    });
    act(Reset{});
    act(model::Run{});
    const auto branches = timeline().branches.size();
    const std::vector<Vec3> polished = shown();
    const unsigned last = timeline().last();
    for (const char* point : {"", "min_angle < 0"}) {
      act(SetBreakpoints{{}});
      if (*point != 0) act(SetBreakpoints{{make_breakpoint(point, BreakAction::stop)}});
      act(Reset{});
      act(model::Run{});
      EXPECT_EQ(session.current->iteration, last) << iterations << point;
      EXPECT_EQ(shown(), polished);
      EXPECT_EQ(timeline().branches.size(), branches) << "the same runs";
    }
    act(SetBreakpoints{{}});
    act(model::Run{});
    act(Step{});
    EXPECT_EQ(timeline().last(), last) << "a polish that has ended makes no empty steps";
    session.timeline.cursor = {};
  }
}

TEST_F(PolishRunTest, NothingIsPolishedOnceSomethingElseIsAskedFor) {
  act(OpenFile{folder.make_square(400)});
  set([](SmoothingSettings& s) { s.polish = Polish::worst; });
  for (const Command& command : {Command(Pause{}), Command(Seek{2, {}}), Command(Undo{})}) {
    act(Reset{});
    session.timeline = {};
    execute(session, model::Run{});
    std::atomic<bool> ended = false;
    session.engine.post("", [&](const JobContext&) { ended = true; });
    while (!ended) std::this_thread::yield();
    execute(session, command);  // the solver has ended, but nobody has looked
    finish(session);
    EXPECT_EQ(timeline().branches.size(), 1U);
  }
}

TEST_F(PolishRunTest, NoStepIsShownWhileAPolishRuns) {
  act(OpenFile{folder.make_square(400)});
  act(SelectVertex{130});
  set([](SmoothingSettings& s) { s.polish = Polish::both; });
  execute(session, model::Run{});
  while (session.engine.busy()) {
    execute(session, Collect{});
    EXPECT_FALSE(session.is_running() && session.inspection.step);
  }
  finish(session);
  EXPECT_TRUE(session.inspection.step);
  EXPECT_TRUE(session.inspection.path) << "and the way of the vertex is known afterwards";
}

TEST_F(PolishRunTest, WhatIsNotInUseBeginsNoBranch) {
  act(OpenFile{folder.make_square(400)});
  act(Step{});
  set([](SmoothingSettings& s) {
    s.max_deviation = 0.1;
    s.edge_length = 3;
    s.feature_deg = 50;
  });
  EXPECT_TRUE(session.continues_branch());
  set([](SmoothingSettings& s) { s.reach = Reach::typed; });
  EXPECT_FALSE(session.continues_branch());
}

}  // namespace
}  // namespace isorelax::model
