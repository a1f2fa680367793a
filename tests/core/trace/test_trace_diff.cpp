#include <gtest/gtest.h>

#include "core/trace/recorded.h"
#include "trace/position_delta.h"
#include "trace/trace_diff.h"

namespace isorelax::test {
namespace {

TEST(TraceDiff, FindsNothingInOneRunDoneTwice) {
  const TraceDifference found = compare_traces(record().trace, record().trace);
  EXPECT_TRUE(found.none());
  EXPECT_TRUE(found.settings.empty());
  EXPECT_EQ(found.common_iterations, 6U);
  EXPECT_EQ(found.distance_at_end, 0);
}

TEST(TraceDiff, NamesTheFirstIterationAndVertexThatPart) {
  const Recorded recorded = record();
  Trace other = recorded.trace;
  // One coordinate of vertex 17 differs in its last bit from iteration 4 on.
  std::vector<Vec3> moved = recorded.positions[4];
  moved[17].y() = std::nextafter(moved[17].y(), 10.0);
  other.iterations[3].delta = encode_delta(recorded.positions[3], moved);
  const TraceDifference found = compare_traces(recorded.trace, other);
  ASSERT_TRUE(found.parting.has_value());
  EXPECT_EQ(found.parting->iteration, 4U);
  EXPECT_EQ(found.parting->vertex, 17U);
  EXPECT_EQ(found.parting->vertices, 1U);
  EXPECT_EQ(found.parting->second, moved[17]);
  EXPECT_GT(found.parting->largest, 0);
  EXPECT_FALSE(found.none());
}

TEST(TraceDiff, TellsSettingsAndLengthsApart) {
  const TraceDifference found = compare_traces(record(6).trace, record(4).trace);
  EXPECT_FALSE(found.parting.has_value());
  EXPECT_FALSE(found.none());
  EXPECT_EQ(found.common_iterations, 4U);
  ASSERT_EQ(found.settings.size(), 2U);
  EXPECT_EQ(found.settings[0].name, "arguments");
  EXPECT_EQ(found.settings[1].name, "iterations");
}

TEST(TraceDiff, DoesNotCompareDifferentMeshes) {
  const TraceDifference found = compare_traces(record(2, 1).trace, record(2, 2).trace);
  EXPECT_FALSE(found.same_triangles);
  EXPECT_FALSE(found.none());
}

}  // namespace
}  // namespace isorelax::test
