#include <gtest/gtest.h>

#include "core/trace/recorded.h"
#include "mesh/error.h"
#include "quality/report.h"
#include "trace/position_delta.h"

namespace isorelax::test {
namespace {

TEST(Recorder, GivesBackEveryPositionInBothDirections) {
  const Recorded recorded = record();
  ASSERT_EQ(recorded.trace.iterations.size(), 6U);
  TraceCursor cursor(recorded.trace);
  for (const std::size_t k : {3U, 6U, 0U, 5U, 4U, 1U, 6U}) {
    EXPECT_EQ(cursor.go_to(k), recorded.positions[k]) << k;
    EXPECT_EQ(cursor.iteration(), k);
  }
  EXPECT_THROW(cursor.go_to(7), Error);
}

TEST(Recorder, KeepsTotalsAndQualityOfEachIteration) {
  const Recorded recorded = record();
  const Trace& trace = recorded.trace;
  for (std::size_t k = 1; k <= trace.iterations.size(); ++k) {
    const TraceIteration& one = trace.iterations[k - 1];
    EXPECT_LE(one.after.energy, one.before.energy);
    if (k > 1) {
      EXPECT_EQ(one.before.energy, trace.iterations[k - 2].after.energy);
    }
    const QualityReport report = measure_quality({recorded.positions[k], recorded.mesh.triangles, {}});
    EXPECT_EQ(one.quality.min_angle_deg, report.min_angle_deg);
    EXPECT_EQ(one.quality.mean_min_angle_deg, report.mean_min_angle_deg);
    EXPECT_GT(one.moved, 0U);
  }
}

TEST(Recorder, ARunThatBeginsAnewLeavesOnlyItsLastAttempt) {
  const Recorded recorded = record();
  TraceRecorder recorder({}, recorded.mesh);
  const StepRecord step;
  recorder.add(1, step, recorded.positions[4]);
  recorder.add(2, step, recorded.positions[5]);
  recorder.add(1, step, recorded.positions[1]);
  ASSERT_EQ(recorder.trace().iterations.size(), 1U);
  TraceCursor cursor(recorder.trace());
  EXPECT_EQ(cursor.go_to(1), recorded.positions[1]);
}

TEST(Delta, KeepsSignedZerosAndTheSmallestNumbers) {
  const std::vector<Vec3> from{{0.0, -0.0, 5e-324}, {1, 2, 3}};
  std::vector<Vec3> to{{-0.0, 0.0, -5e-324}, {1, 2, 1e308}};
  std::vector<Vec3> walker = from;
  const std::string delta = encode_delta(from, to);
  ASSERT_TRUE(apply_delta(delta, walker));
  EXPECT_TRUE(std::signbit(walker[0].x()));
  EXPECT_FALSE(std::signbit(walker[0].y()));
  EXPECT_EQ(walker, to);
  ASSERT_TRUE(apply_delta(delta, walker));
  EXPECT_TRUE(std::signbit(walker[0].y()));
  std::vector<Vec3> one(1);
  EXPECT_FALSE(apply_delta(delta, one));
}

TEST(Delta, OfAStandstillTakesNextToNothing) {
  const std::vector<Vec3> positions(10000, Vec3(1.0 / 3, 2.0 / 7, -1e-3));
  EXPECT_LT(encode_delta(positions, positions).size(), 200U);
}

}  // namespace
}  // namespace isorelax::test
