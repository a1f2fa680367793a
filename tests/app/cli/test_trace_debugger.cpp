#include <gtest/gtest.h>

#include <algorithm>

#include "app/cli/program.h"
#include "cli/smooth_run.h"
#include "generate/generate.h"
#include "io/mesh_file.h"
#include "model/command.h"
#include "trace/trace_file.h"

namespace isorelax::cli {
namespace {

/// Runs of the program, opened in a session as the editor has it.
class TraceDebugger : public ::testing::Test {
 protected:
  void SetUp() override { session.engine.set_plan_reader(read_plan); }

  [[nodiscard]] std::string make(ShapeKind kind, const GenerateOptions& options) const {
    (void)write_mesh(workspace.path("in.off"), generate(kind, options));
    return workspace.path("in.off");
  }
  /// Smooths with these words, and records it.
  [[nodiscard]] std::string record(const std::string& in, const std::string& words) const {
    std::string trace = workspace.path("run.trace");
    const test::Outcome outcome = test::run_program(
        "smooth " + in + " --quiet -o " + workspace.path("o.off") + " --trace " + trace + " " + words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return trace;
  }
  void act(const model::Command& command) {
    model::execute(session, command);
    model::finish(session);
  }
  [[nodiscard]] const model::Branch& branch() const { return *session.timeline.current(); }
  [[nodiscard]] const Trace& trace() const { return branch().recording->trace(); }

  /// Looks into every step of the present branch, the last one first.
  void look_into_all_steps() {
    ASSERT_EQ(branch().not_redone, "");
    ASSERT_GT(session.timeline.last(), 0U);
    act(model::SetStepBudget{0});  // none is kept
    for (unsigned k = session.timeline.last(); k > 0; --k) {
      act(model::Seek{k, {}});
      if (k == session.timeline.last()) act(model::SelectVertex{40});
      ASSERT_TRUE(session.inspection.step) << k << ": " << session.messages.back().text;
      ASSERT_EQ(session.inspection.step->at.iteration, k);
      EXPECT_EQ(session.inspection.step->mismatch, "") << k;
      ASSERT_TRUE(session.inspection.vertex && session.inspection.check);
      EXPECT_EQ(session.inspection.vertex->after, session.current->positions()[40]) << k;
      EXPECT_EQ(session.inspection.check->wrong, 0U) << k;
    }
  }
  /// Runs on from here as a branch.
  void continue_with(double mu, unsigned iterations) {
    model::SmoothingSettings settings = session.smoothing;
    settings.mu_a = mu;
    settings.tolerance = 0;
    settings.iterations = iterations;
    act(model::SetSmoothing{settings, "mu"});
    act(model::Run{});
  }
  void open_and_look(const std::string& trace) {
    act(model::OpenFile{trace});
    ASSERT_FALSE(session.timeline.empty()) << session.messages.back().text;
    look_into_all_steps();
  }

  test::Workspace workspace;
  model::Session session;
};

const GenerateOptions kSmall{.triangles = 150};

TEST_F(TraceDebugger, LooksIntoStepsMadeWithWordsThatTheEditorHasNoSettingsFor) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  for (const char* words : {"--weights 1,1", "--pin boundary --boundary free", "--surface tangent",
                            "--solver jacobi --relaxation 0.5", "--method laplacian --weighting uniform",
                            "--method angle-based --guard off", "--untangle off --boundary-corner 60"}) {
    open_and_look(record(square, std::string(words) + " --iterations 5"));
    EXPECT_NE(session.messages.back().text.find("no setting for --"), std::string::npos) << words;
  }
  const std::string torus = make(ShapeKind::torus, {.triangles = 200, .jitter = 0.3});
  open_and_look(record(torus, "--size-field curvature --mu 0.5 --iterations 6"));
  EXPECT_EQ(session.smoothing.mu_a, 0.5) << "the other words are settings";
}

TEST_F(TraceDebugger, LooksIntoTheStepsOfAPolish) {
  const std::string square = make(ShapeKind::random_square, {.triangles = 60});
  open_and_look(record(square, "--polish worst --iterations 3 --tolerance 0.1"));
  EXPECT_EQ(trace().parts.back().kind, PartKind::polish);
}

TEST_F(TraceDebugger, LooksIntoStepsOfAllExponentsThatARunGoesThrough) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  open_and_look(record(square, "--exponent 8 --tolerance 0.01 --iterations 40"));
  EXPECT_EQ(trace().parts.size(), 3U);
  EXPECT_EQ(session.history.back().series, 2U) << "every exponent has a curve of its own";
  EXPECT_EQ(session.history.size(), 1U + session.timeline.last() + 2);
}

TEST_F(TraceDebugger, LooksIntoTheStepsAfterUntangling) {
  open_and_look(
      record(make(ShapeKind::hexagonal_square, {.triangles = 150, .tangle = 0.05}), "--iterations 6"));
  EXPECT_TRUE(trace().parts.front().from_base);
  act(model::Seek{1, {}});
  act(model::StepStage{1});
  ASSERT_TRUE(session.inspection.step && session.inspection.step->before_state);
  EXPECT_EQ(session.inspection.step->before_state->quality().inverted, 0U)
      << "the inside of the first step is drawn on the untangled mesh";
  act(model::SetStage{});
  act(model::Seek{0, {}});
  EXPECT_GT(session.current->quality().inverted, 0U) << "the start is the mesh as it was";
  EXPECT_NE(session.inspection.step->made_with.find("untangled first"), std::string::npos);
  // A branch goes on with the surface that untangling made.
  act(model::Seek{3, {}});
  continue_with(0.5, 3);
  const std::string saved = workspace.path("branch.trace");
  act(model::SaveTrace{saved});
  EXPECT_EQ(test::run_program("trace replay " + saved).status, 0);
  open_and_look(saved);
  ASSERT_EQ(trace().parts.size(), 2U);
  EXPECT_EQ(trace().parts[0].base, trace().parts[1].base);
  EXPECT_FALSE(trace().parts[1].from_base);
}

TEST_F(TraceDebugger, LooksIntoStepsOfARunThatHeldVertices) {
  const std::string torus = make(ShapeKind::torus, {.triangles = 400, .jitter = 0.3});
  open_and_look(record(torus, "--max-deviation 0.012 --iterations 6"));
  EXPECT_FALSE(trace().parts.front().holds == SurfaceHolds{});
}

TEST_F(TraceDebugger, SaysWhatIsMissingWhereAFileHasChanged) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  const std::string pins = workspace.write("pins.txt", "40 41\n");
  open_and_look(record(square, "--pin " + pins + " --iterations 3"));
  (void)workspace.write("pins.txt", "42\n");
  act(model::OpenFile{workspace.path("run.trace")});
  EXPECT_NE(branch().not_redone.find("pins.txt"), std::string::npos) << branch().not_redone;
  act(model::Seek{2, {}});
  EXPECT_EQ(session.current->iteration, 2U) << "its positions are there all the same";
}

TEST_F(TraceDebugger, ABranchSavedIsReplayedAndLookedIntoPartByPart) {
  open_and_look(record(make(ShapeKind::random_square, kSmall), "--weights 1,1 --iterations 4"));
  for (const double mu : {0.5, 0.8}) {  // a branch of a branch
    act(model::Seek{session.timeline.last() - 1, {}});
    continue_with(mu, 3);
  }
  act(model::Step{});  // goes on afresh
  EXPECT_EQ(session.timeline.last(), 9U);
  const std::vector<Vec3> end(session.current->positions().begin(), session.current->positions().end());
  const std::string saved = workspace.path("branch.trace");
  act(model::SaveTrace{saved});

  const test::Outcome replay = test::run_program("trace replay " + saved);
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  EXPECT_NE(replay.out.find("9 iterations"), std::string::npos) << replay.out;
  const test::Outcome shown = test::run_program("trace show " + saved);
  EXPECT_NE(shown.out.find("from iteration 4: exponent 2, arguments --solver"), std::string::npos)
      << shown.out;
  open_and_look(saved);
  EXPECT_GE(trace().parts.size(), 3U);
  act(model::Seek{9, {}});
  EXPECT_TRUE(std::ranges::equal(session.current->positions(), end));

  Trace wrong = read_trace(saved);
  wrong.parts[1].exponent = 3;
  write_trace(saved, wrong);
  const test::Outcome differs = test::run_program("trace replay " + saved);
  EXPECT_EQ(differs.status, 1);
  EXPECT_NE(differs.out.find("parts at iteration 4"), std::string::npos) << differs.out;
}

TEST_F(TraceDebugger, ARunThatAPredicateBrokeOffIsReplayedAsFarAsItWent) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  const std::string trace = record(square, "--break 'iteration == 4'");
  EXPECT_EQ(test::run_program("trace replay " + trace).status, 0);
  open_and_look(trace);
  // In a polish, and in an attempt that was given up for the vertices that it took too far.
  const std::string torus = make(ShapeKind::torus, {.triangles = 400, .jitter = 0.3});
  for (const char* words : {"--polish worst --iterations 3 --break 'iteration == 5'",
                            "--polish mean --iterations 3 --break 'iteration == 5'",
                            "--max-deviation 0.01 --iterations 12 --break 'energy < 1650'"}) {
    const test::Outcome replay = test::run_program("trace replay " + record(torus, words));
    EXPECT_EQ(replay.status, 0) << words << ": " << replay.out;
    EXPECT_NE(replay.out.find("done again in"), std::string::npos) << words;
  }
}

TEST_F(TraceDebugger, BreakpointsLookThroughARunThatWasOpened) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  act(model::OpenFile{record(square, "--weights 1,1 --iterations 8 --tolerance 0")});
  act(model::SetBreakpoints{
      {make_breakpoint("iteration == 5 && vertex(40).alpha > 0", model::BreakAction::stop)}});
  act(model::Run{});
  EXPECT_EQ(session.timeline.branches.size(), 1U) << "what is recorded is not run again";
  EXPECT_EQ(session.current->iteration, 5U);
}

TEST_F(TraceDebugger, ScriptsKnowTheWordsOfRunsToo) {
  const std::string square = make(ShapeKind::random_square, kSmall);
  (void)record(square, "--weights 1,1 --pin boundary --iterations 5");
  const std::string script = workspace.write(
      "a.script",
      "open run.trace\nseek 3\nvertex 70\nexpect vertex(70).alpha > 0 && vertex(70).gradient > 0\n");
  const test::Outcome outcome = test::run_program("script " + script);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

}  // namespace
}  // namespace isorelax::cli
