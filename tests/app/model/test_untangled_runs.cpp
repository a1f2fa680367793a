#include <gtest/gtest.h>

#include <algorithm>

#include "app/model/session_fixture.h"
#include "generate/generate.h"

namespace isorelax::model {
namespace {

/// Meshes that arrive with triangles upside down.
class UntangledRunTest : public SessionFixture {
 protected:
  void open() { SessionFixture::open(tangled); }
  [[nodiscard]] std::size_t inverted() const { return session.current->quality().inverted; }

  TriangleMesh tangled = generate(ShapeKind::random_square, {.seed = 3, .triangles = 400, .tangle = 0.2});
};

TEST_F(UntangledRunTest, OpeningSaysWhatARunWillDoAndARunDoesIt) {
  open();
  ASSERT_GT(inverted(), 50U);
  ASSERT_EQ(session.notes.size(), 1U);
  EXPECT_EQ(session.notes[0],
            std::to_string(inverted()) + " triangles lie upside down: a run turns all of them first");
  act(Step{});
  EXPECT_EQ(inverted(), 0U);
  EXPECT_LE(session.last_step->after.energy, session.last_step->before.energy);
}

TEST_F(UntangledRunTest, TheStatesAreThoseOfABoundedRunToTheBit) {
  open();
  act(model::Run{});
  EXPECT_EQ(shown(), smoothed(tangled, {.max = {}, .automatic = AutomaticLimit::widest}));
  ASSERT_TRUE(session.surface);
  EXPECT_FALSE(session.surface->is_over);
  EXPECT_LT(session.surface->deviation.max, 1e-12) << "it covers the same square";
}

TEST_F(UntangledRunTest, ItsFirstStepIsExplainedBeforeAndAfterItIsMade) {
  open();
  act(SetStepBudget{0});
  act(SelectVertex{100});
  ASSERT_TRUE(session.inspection.vertex);
  const VertexExplanation foreseen = *session.inspection.vertex;
  act(model::Run{});
  act(Seek{1, {}});
  ASSERT_TRUE(session.inspection.step && session.inspection.vertex);
  EXPECT_EQ(session.inspection.step->mismatch, "");
  EXPECT_EQ(session.inspection.vertex->before, foreseen.before);
  EXPECT_EQ(session.inspection.vertex->after, foreseen.after);
  EXPECT_EQ(session.current->positions()[100], foreseen.after);
}

TEST_F(UntangledRunTest, UndoBringsTheTangleBackAndBranchesStaySound) {
  open();
  const std::size_t before = inverted();
  act(model::Run{});
  act(Undo{});
  EXPECT_EQ(inverted(), before);
  act(Redo{});
  act(Seek{4, {}});
  SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.4;
  settings.iterations = 5;
  act(SetSmoothing{settings, "test"});
  ASSERT_TRUE(session.current->energy);
  act(model::Run{});
  EXPECT_EQ(inverted(), 0U);
  ASSERT_EQ(session.timeline.branches.size(), 2U);
  const std::vector<Vec3> end = shown();
  act(SaveTrace{folder / "run.trace"});
  Session other;
  execute(other, OpenFile{folder / "run.trace"});
  finish(other);
  EXPECT_EQ(other.current->quality().inverted, before);
  execute(other, SelectVertex{100});
  for (const unsigned k : {1U, 5U, 9U}) {
    execute(other, Seek{k, {}});
    finish(other);
    ASSERT_TRUE(other.inspection.step) << k;
    EXPECT_EQ(other.inspection.step->mismatch, "") << k;
  }
  EXPECT_TRUE(std::ranges::equal(other.current->positions(), end));
}

TEST_F(UntangledRunTest, ATypedDistanceMayForbidIt) {
  tangled = generate(ShapeKind::random_square, {.triangles = 100});
  const Topology topology(tangled.triangles, tangled.vertex_count());
  Index thrown = 0;
  while (topology.flags(thrown) != 0) ++thrown;
  tangled.positions[thrown] = Vec3(2, 2, 0);  // far outside: what it covers there would go with it
  open();
  ASSERT_GT(inverted(), 0U);
  SmoothingSettings settings = session.smoothing;
  settings.reach = Reach::typed;
  settings.max_deviation = 0.01;
  act(SetSmoothing{settings, "test"});
  act(model::Run{});
  EXPECT_EQ(session.current->positions()[thrown], tangled.positions[thrown]);
  settings.reach = Reach::widest;
  act(SetSmoothing{settings, "test"});
  act(Reset{});
  act(model::Run{});
  EXPECT_EQ(inverted(), 0U);
}

TEST_F(UntangledRunTest, ABranchFromTheStartBeginsAsItsOwnSettingsSay) {
  open();
  act(model::Run{});
  Index thrown = 0;
  const auto x = session.current->positions();
  while (x[thrown] == tangled.positions[thrown] || (x[thrown] - tangled.positions[thrown]).norm() < 0.1)
    ++thrown;
  act(Seek{0, {}});
  act(TogglePin{thrown});
  act(model::Run{});
  ASSERT_EQ(session.timeline.branches.size(), 2U);
  EXPECT_EQ(session.current->positions()[thrown], tangled.positions[thrown]) << "it is pinned";
  Session other;
  execute(other, OpenFile{folder / "mesh.off"});
  finish(other);
  execute(other, TogglePin{thrown});
  execute(other, model::Run{});
  finish(other);
  EXPECT_TRUE(std::ranges::equal(session.current->positions(), other.current->positions()));
}

TEST_F(UntangledRunTest, PinsOfAnotherMeshPlayNoPart) {
  open();
  act(TogglePin{200});
  tangled = generate(ShapeKind::random_square, {.seed = 4, .triangles = 40, .tangle = 0.3});
  open();
  EXPECT_TRUE(session.smoothing.pinned.empty());
  ASSERT_TRUE(session.current->energy) << session.notes.front();
}

TEST_F(UntangledRunTest, ATypedDistanceIsOneFromTheMeshAsOpened) {
  tangled = generate(ShapeKind::random_square, {.seed = 2, .triangles = 100});
  const Topology topology(tangled.triangles, tangled.vertex_count());
  Index thrown = 0;
  while (topology.flags(thrown) != 0) ++thrown;
  tangled.positions[thrown] = Vec3(1.05, 1.05, 0);
  open();
  SmoothingSettings settings = session.smoothing;
  settings.boundary = BoundaryRule::free;
  settings.reach = Reach::typed;
  settings.max_deviation = 0.06;
  act(SetSmoothing{settings, "test"});
  act(model::Run{});
  ProblemOptions options;
  options.boundary = BoundaryRule::free;
  EXPECT_EQ(shown(), smoothed(tangled, {.max = 0.06, .automatic = {}}, {}, options));
}

}  // namespace
}  // namespace isorelax::model
