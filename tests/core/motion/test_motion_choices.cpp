#include <gtest/gtest.h>

#include "motion/motion_choices.h"
#include "motion/motion_share.h"

namespace isorelax {
namespace {

using Words = std::vector<std::string>;

MotionChoices choices_of(const Words& words) {
  MotionChoices choices;
  read_words(words, choices);
  return choices;
}

TEST(MotionChoices, WordsComeBackAsTheyWereAndDefaultsAreLeftOut) {
  EXPECT_TRUE(to_words(MotionChoices{}).empty());
  const Words all{"--sphere",       "100:0.5:0,1,0",
                  "--field",        "rigid:0,0,2@1,0,0+0,-1,0.5",
                  "--until",        "2.5",
                  "--step",         "0.1",
                  "--tolerance",    "1e-06",
                  "--method",       "face-offsetting",
                  "--preset",       "paper",
                  "--redistribute", "tangent",
                  "--solver",       "newton",
                  "--iterations",   "4",
                  "--mu",           "0.25",
                  "--reference",    "equilateral",
                  "--every",        "3",
                  "--only-below",   "20",
                  "--threads",      "2"};
  EXPECT_EQ(to_words(choices_of(all)), all);
  Words bare;
  for (std::size_t k = 0; k < all.size(); ++k) bare.push_back(k % 2 == 0 ? all[k].substr(2) : all[k]);
  EXPECT_EQ(to_words(choices_of(bare)), all) << "names need no dashes";
  EXPECT_EQ(to_words(choices_of({"volume", "free"})), (Words{"--volume", "free"}));
}

TEST(MotionChoices, EveryFieldIsWrittenAsItIsRead) {
  for (const char* text :
       {"paper:2", "enright:0.5", "rigid:1,2,3", "rigid:1,2,3@0,0,1", "rigid:0,0,0+1e+20,0,-1", "shear:-2",
        "normal:0.1*sin(t)", "expr:-y;x+1;", "file:a b.vtk"})
    EXPECT_EQ(to_text(parse_field(text)), text);
  EXPECT_THROW((void)make_motion(parse_field("expr:-y;x+1;")), UsageError) << "the third is missing";
  EXPECT_EQ(parse_field("shear:2", parse_field("paper:7")).period, 7) << "what else was chosen is kept";
}

TEST(MotionChoices, MistakesNameTheirOption) {
  const auto complaint = [](const Words& words) {
    try {
      std::vector<std::string> notes;
      (void)motion_options_of(choices_of(words), notes);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint({"step", "0"}).find("--step 0: expected a number over 0"), std::string::npos);
  EXPECT_NE(complaint({"until", "nan"}).find("--until"), std::string::npos);
  EXPECT_NE(complaint({"every", "-1"}).find("--every -1: expected a whole number of 1"), std::string::npos);
  EXPECT_NE(complaint({"preset", "best"}).find("expected none, paper"), std::string::npos);
  EXPECT_NE(complaint({"solver", "newton"}).find("--solver is for tangent moves"), std::string::npos);
  EXPECT_NE(complaint({"reference", "equilateral:0"}).find("positive edge length"), std::string::npos);
  EXPECT_NE(complaint({"reference", "equilateral:0.02"}).find("for tangent moves"), std::string::npos);
  EXPECT_TRUE(complaint({"preset", "paper", "reference", "equilateral:0.02"}).empty());
  EXPECT_TRUE(complaint({"preset", "paper", "solver", "newton", "mu", "0.3"}).empty());
}

TEST(MotionShare, OfOffsetFacesUnderErrorControlIsAStepOfTheWholeMesh) {
  std::vector<std::string> notes;
  const MotionSetup setup = set_up_motion(
      choices_of({"sphere", "200", "field", "paper:0.5", "preset", "paper", "tolerance", "1e-6"}),
      std::nullopt, notes);
  ASSERT_EQ(setup.options.integration, Integration::face_offsetting);
  MovingSurface surface(setup.start, setup.motion, setup.options);
  surface.advance(setup.until);
  MovingState state = surface.state();
  surface.advance(setup.until);
  const double dt = surface.report().dt;
  MovingSurfaceOptions plain = setup.options;
  plain.redistribution = Redistribution::none;
  MovingSurface alone(setup.start, setup.motion, plain);
  state.next_step = dt;
  alone.restore(state, setup.until);
  alone.advance(setup.until);
  MotionShare share(setup);
  for (const Index v : {0U, 57U, 199U}) {
    const Vec3 moved = share.of(state.positions, surface.state().positions, {1, state.time, dt}, v);
    EXPECT_LT((state.positions[v] + moved - alone.state().positions[v]).norm(), 1e-15) << v;
  }
}

TEST(MotionShare, OfPureAdvectionIsTheWholeStepAndOfOthersTheMotionAlone) {
  for (const char* field : {"paper:0.5", "normal:0.2"}) {
    for (const char* preset : {"none", "paper", "balanced"}) {
      std::vector<std::string> notes;
      const MotionSetup setup =
          set_up_motion(choices_of({"sphere", "200", "field", field, "step", "0.05", "preset", preset}),
                        std::nullopt, notes);
      MovingSurface surface(setup.start, setup.motion, setup.options);
      surface.advance(setup.until);
      const std::vector<Vec3> before = surface.state().positions;
      const double time = surface.state().time;
      surface.advance(setup.until);
      const std::vector<Vec3>& after = surface.state().positions;
      MovingSurfaceOptions plain = setup.options;
      plain.redistribution = Redistribution::none;
      MovingSurface alone(setup.start, setup.motion, plain);
      MovingState state;
      state.step = 1;
      state.time = time;
      state.positions = before;
      alone.restore(state, setup.until);
      alone.advance(setup.until);
      MotionShare share(setup);
      for (const Index v : {0U, 57U, 199U}) {
        const Vec3 moved = share.of(before, after, {1, time, 0.05}, v);
        EXPECT_LT((before[v] + moved - alone.state().positions[v]).norm(), 1e-15) << field << " " << preset;
      }
    }
  }
}

}  // namespace
}  // namespace isorelax
