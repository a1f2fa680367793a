#include <gtest/gtest.h>

#include <functional>

#include "app/temporary_mesh.h"
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

}  // namespace
}  // namespace isorelax::model
