#include <gtest/gtest.h>

#include "core/trace/recorded.h"
#include "mesh/error.h"
#include "trace/predicate.h"

namespace isorelax::test {
namespace {

class PredicateTest : public ::testing::Test {
 protected:
  PredicateTest() {
    step.alpha = {1, 0.05};
    step.displacement = {{3, 4, 0}, {1, 0, 0}};
    step.gradient = {{0, 0, 2}, {0, 0, 0}};
    step.limits = {0, kLimitFold};
    numbers.before.energy = 10;
    numbers.after.energy = 9;
    numbers.quality = {4.5, 150, 40, 2};
    numbers.limits[4] = 1;
  }
  [[nodiscard]] Moment moment() const {
    return {.iteration = 40,
            .numbers = numbers,
            .record = step,
            .positions = positions,
            .triangles = triangles,
            .inverted_at_start = 2,
            .stop = false};
  }
  [[nodiscard]] bool holds(const std::string& text) const { return Predicate(text).holds(moment()); }
  [[nodiscard]] std::string values(const std::string& text) const { return Predicate(text).values(moment()); }

  std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Triangle> triangles{{0, 1, 2}};
  TraceIteration numbers;
  StepRecord step;
};

TEST_F(PredicateTest, ReadsTheNumbersOfTheIteration) {
  EXPECT_TRUE(holds("min_angle < 5"));
  EXPECT_FALSE(holds("min_angle<4.5"));
  EXPECT_TRUE(holds("iteration == 40"));
  EXPECT_TRUE(holds("inverted == 2"));
  EXPECT_FALSE(holds("folded > 0"));
  EXPECT_FALSE(holds("energy_rose"));
  EXPECT_FALSE(holds("class_changed"));
  EXPECT_FALSE(holds("stop"));
  EXPECT_TRUE(holds("limited_fold == 1"));
}

TEST_F(PredicateTest, ReadsVerticesAndTriangles) {
  EXPECT_TRUE(holds("vertex(1).alpha < 0.1"));
  EXPECT_FALSE(holds("vertex(0).alpha < 0.1"));
  EXPECT_TRUE(holds("vertex(0).move == 5 && vertex(0).gradient == 2"));
  EXPECT_TRUE(holds("vertex(1).limits == 16"));
  EXPECT_TRUE(holds("triangle(0).min_angle == 45 || triangle( 0 ).min_angle > 44.99"));
}

TEST_F(PredicateTest, NothingHoldsOfWhatIsNotThere) {
  EXPECT_FALSE(holds("vertex(812).x < 1"));
  EXPECT_FALSE(holds("vertex(812).x >= 1"));
  EXPECT_FALSE(holds("vertex(812).x"));
}

TEST_F(PredicateTest, ShowsWhatAMeshDoesNotHaveAtItsPlace) {
  const Predicate predicate("vertex(2).x > 0 && triangle( 4 ).area < 1");
  EXPECT_NO_THROW(predicate.check(3, 5));
  const auto column = [&](std::size_t vertices, std::size_t faces) {
    try {
      predicate.check(vertices, faces);
    } catch (const PredicateError& error) {
      return error.column();
    }
    return std::size_t{0};
  };
  EXPECT_EQ(column(2, 5), 8U);
  EXPECT_EQ(column(3, 4), 30U);
}

TEST_F(PredicateTest, TellsWhatItsNamesStandFor) {
  EXPECT_EQ(values("iteration == 41 || vertex( 1 ).limits > 20 || iteration < 2"),
            "iteration = 40, vertex(1).limits = 16");
  EXPECT_EQ(values("1 < 2"), "");
}

TEST_F(PredicateTest, BindsAsInC) {
  EXPECT_TRUE(holds("1 + 2 * 3 == 7"));
  EXPECT_TRUE(holds("(1 + 2) * 3 == 9"));
  EXPECT_TRUE(holds("1 || 0 && 0"));
  EXPECT_TRUE(holds("!(1 > 2) && -1 < 0"));
  EXPECT_TRUE(holds("8 / 4 / 2 == 1"));
  EXPECT_TRUE(holds("energy - energy_before == -1"));
}

TEST_F(PredicateTest, ShowsAMistakeAtItsPlace) {
  // 0: no mistake.
  const auto column = [](const std::string& text) -> unsigned long {
    try {
      const Predicate predicate(text);
      return 0;
    } catch (const UsageError& error) {
      const std::string line = error.what();
      const std::string before = text + ": column ";
      EXPECT_EQ(line.rfind(before, 0), 0U) << line;
      return std::stoul(line.substr(before.size()));
    }
  };
  EXPECT_EQ(column("min_angle < 5"), 0U);
  EXPECT_EQ(column("min_angl < 5"), 1U);
  EXPECT_EQ(column("min_angle < "), 13U);
  EXPECT_EQ(column("energy_rose && (folded > 0"), 27U);
  EXPECT_EQ(column("vertex(812).alfa < 1"), 13U);
  EXPECT_EQ(column("vertex(x).alpha"), 8U);
  EXPECT_EQ(column("min_angle 5"), 11U);
  EXPECT_EQ(column(""), 1U);
  EXPECT_EQ(column(std::string(5000, '(')), 201U);
  EXPECT_THROW(Predicate("min_angle <"), UsageError);
}

TEST_F(PredicateTest, EveryNameOfTheReferenceIsOne) {
  const std::string reference = Predicate::reference();
  std::size_t at = 0;
  std::size_t names = 0;
  while (at < reference.size()) {
    const std::size_t end = reference.find('\n', at);
    std::string word = reference.substr(at + 2, reference.find(' ', at + 2) - at - 2);
    if (const auto id = word.find("ID"); id != std::string::npos) word.replace(id, 2, "0");
    EXPECT_NO_THROW(Predicate{word}) << word;
    at = end + 1;
    ++names;
  }
  EXPECT_GT(names, 30U);
}

}  // namespace
}  // namespace isorelax::test
