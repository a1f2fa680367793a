#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/trace/recorded.h"
#include "core/two_sheets.h"
#include "generate/generate.h"
#include "mesh/error.h"
#include "trace/position_delta.h"
#include "trace/redo.h"
#include "trace/trace_diff.h"
#include "trace/trace_file.h"
#include "trace/trace_parts.h"

namespace isorelax::test {
namespace {

/// A mesh with thrown vertices, which is untangled first, run with stages of exponents and a polish.
Trace record_bounded() {
  GenerateOptions shape;
  shape.triangles = 150;
  shape.tangle = 0.05;
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, shape);
  TraceRecorder recorder({}, mesh);
  ProblemOptions options;
  options.exponent = 4;
  (void)run_bounded(
      mesh.positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return make_newton(problem); },
      {.iterations = 40, .tolerance = 0.02}, {},
      [&](unsigned k, const StepRecord& step, auto now) { return recorder.add(k, step, now), true; },
      PolishOptions{.iterations = 5}, [&](const RunPart& part, auto now) { recorder.begin_part(part, now); });
  return recorder.trace();
}

RunPlan plan(const RunWords& /*words*/, const TriangleMesh& /*mesh*/) {
  return {{}, [](const SmoothingProblem& problem) { return make_newton(problem); }, {.iterations = 5}};
}

/// A trace of a few iterations with all that parts can hold.
Trace with_parts() {
  Trace trace = record(2).trace;
  trace.parts.resize(2);
  trace.parts[0].base = trace.iterations[0].delta;
  trace.parts[0].from_base = true;
  trace.parts[0].holds = {{3, 5}, 0.25, true, true};
  trace.parts[1].done = 1;
  trace.parts[1].exponent = 8;
  trace.parts[1].kind = PartKind::polish;
  trace.parts[1].words = RunWords{{"--mu", "0.5"}, {{"held.txt", hash_of("1")}}};
  return trace;
}

TEST(TraceParts, SayHowEveryStepOfABoundedRunIsMadeAgain) {
  const Trace trace = record_bounded();
  ASSERT_GE(trace.parts.size(), 3U) << "two exponents and a polish";
  EXPECT_TRUE(trace.parts[0].from_base) << "it was untangled first";
  EXPECT_EQ(trace.parts[0].exponent, 2);
  EXPECT_EQ(trace.parts[1].exponent, 4);
  EXPECT_EQ(trace.parts.back().kind, PartKind::polish);
  EXPECT_EQ(part_of(trace, 1), trace.parts.data());
  EXPECT_EQ(part_of(trace, trace.parts[1].done + 1), &trace.parts[1]);
  EXPECT_FALSE(replay_parts(trace, plan));
}

TEST(TraceParts, RunsThatAreKeptFromCrossingThemselvesAreReplayed) {
  // A shell that is thinner than its sides may move.
  TriangleMesh mesh = generate(ShapeKind::sphere, {.seed = 5, .triangles = 400, .jitter = 0.6});
  add_copy(mesh, true, [](const Vec3& x) { return 0.99 * x; });
  TraceRecorder recorder({}, mesh);
  (void)run_bounded(
      mesh.positions, mesh.triangles, {},
      [](const SmoothingProblem& problem) { return make_newton(problem); }, {.iterations = 5}, {0.01},
      [&](unsigned k, const StepRecord& step, auto now) { return recorder.add(k, step, now), true; }, {},
      [&](const RunPart& part, auto now) { recorder.begin_part(part, now); });
  ASSERT_EQ(recorder.trace().parts.size(), 1U);
  EXPECT_TRUE(recorder.trace().parts[0].holds.apart);
  EXPECT_FALSE(replay_parts(recorder.trace(), plan));
  Trace changed = recorder.trace();
  changed.parts[0].holds.apart = false;
  EXPECT_TRUE(replay_parts(changed, plan));
}

TEST(TraceParts, AreNeededAndTheirReplayNamesTheFirstStepThatDiffers) {
  const Trace trace = record_bounded();
  const auto first_difference = [&](const std::function<void(Trace&)>& change) {
    Trace changed = trace;
    change(changed);
    const auto parting = replay_parts(changed, plan);
    return parting ? parting->iteration : 0;
  };
  EXPECT_EQ(first_difference([](Trace& t) { t.parts[0].exponent = 1; }), 1U);
  EXPECT_EQ(first_difference([](Trace& t) { t.parts[0].from_base = false; }), 1U);
  EXPECT_EQ(first_difference([](Trace& t) { t.parts[1].exponent = 2; }), trace.parts[1].done + 1);
  EXPECT_EQ(first_difference([](Trace& t) { t.parts.back().kind = PartKind::solver; }),
            trace.parts.back().done + 1);
  EXPECT_EQ(first_difference([](Trace& t) { t.parts[0].holds.still = {30, 31, 40, 41, 50}; }), 1U);
}

TEST(TraceParts, StandInTheFileAsTheyWere) {
  Trace trace = with_parts();
  trace.interrupted = true;
  const Trace back = parse_trace(trace_bytes(trace), "t");
  EXPECT_EQ(back.parts, trace.parts);
  EXPECT_TRUE(back.interrupted);
  EXPECT_TRUE(compare_traces(back, trace).settings.empty());
  EXPECT_EQ(base_of(back, back.parts[0]), base_of(trace, trace.parts[0]));
  EXPECT_NE(base_of(back, back.parts[0]), back.positions);
  EXPECT_EQ(words_of(back, back.parts[0]), static_cast<const RunWords&>(trace));
  EXPECT_EQ(part_text(back.parts[0]),
            "from iteration 1: untangled first, exponent 2, 2 vertices held, kept within 0.25 on the fits, "
            "kept from crossing itself");
  EXPECT_EQ(part_text(back.parts[1]), "from iteration 2: polish, exponent 8, arguments --mu 0.5");
}

TEST(TraceParts, SayWhatTheWordsDoNot) {
  Trace trace = with_parts();
  EXPECT_TRUE(says_more_than_words(trace, trace.parts[0]));
  TracePart plain;
  EXPECT_FALSE(says_more_than_words(trace, plain));
  plain.exponent = 1;
  EXPECT_TRUE(says_more_than_words(trace, plain)) << "a run that found the usual one unfit";
  trace.arguments = {"--exponent", "1"};
  EXPECT_FALSE(says_more_than_words(trace, plain));
}

TEST(TraceParts, ADifferenceOfTheirsIsTold) {
  const Trace trace = with_parts();
  Trace other = trace;
  other.parts[0].holds.still = {3, 6};
  other.parts.pop_back();
  const auto settings = compare_traces(trace, other).settings;
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0].name, "part 1");
  EXPECT_NE(settings[0].first, settings[0].second) << "as many are held, but others";
  EXPECT_EQ(settings[1].second, "none");
}

TEST(TraceParts, DamageOfTheirsIsRefusedWithItsPlace) {
  const std::string good = trace_bytes(with_parts());
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x04);
    EXPECT_THROW((void)parse_trace(bytes, "t"), InputError) << at;
  }
  const auto complaint = [](const std::function<void(Trace&)>& change) -> std::string {
    Trace trace = with_parts();
    change(trace);
    try {
      (void)parse_trace(trace_bytes(trace), "t");
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::function<void(Trace&)>& change : std::vector<std::function<void(Trace&)>>{
           [](Trace& t) { t.parts[0].done = 1; }, [](Trace& t) { t.parts[1].done = 0; },
           [](Trace& t) { t.parts[1].done = 3; }, [](Trace& t) { t.parts[0].holds.still = {100000}; },
           [](Trace& t) { t.parts[1].exponent = 0.5; }, [&](Trace& t) { t.parts[1].exponent = nan; },
           [&](Trace& t) { t.parts[1].holds.distance = nan; },
           [](Trace& t) { t.parts[1].holds.distance = -1; }}) {
    const std::string text = complaint(change);
    EXPECT_NE(text.find("byte "), std::string::npos) << text;
    EXPECT_NE(text.find("of the run"), std::string::npos) << text;
  }
}

TEST(TraceParts, FilesOfTheFirstVersionHaveNone) {
  Trace trace = record(2).trace;
  std::string bytes = trace_bytes(trace);
  bytes[kTraceMagic.size()] = 1;  // they knew no "parts" in the head; one too many is not looked at
  const Trace back = parse_trace(bytes, "t");
  EXPECT_TRUE(back.parts.empty());
  EXPECT_TRUE(compare_traces(back, trace).none());
  EXPECT_EQ(part_of(back, 1), nullptr);
}

TEST(TraceParts, FilesOfTheSecondVersionKeepTheirDistanceEverywhereOrNowhere) {
  const std::string folder = ISORELAX_SOURCE_DIR "/tests/core/trace/recorded/";
  const Trace free = read_trace(folder + "version_2.trace");
  ASSERT_EQ(free.parts.size(), 1U);
  EXPECT_TRUE(free.parts[0].holds == SurfaceHolds{});
  const Trace limited = read_trace(folder + "version_2_limited.trace");
  ASSERT_EQ(limited.parts.size(), 1U);
  EXPECT_GT(limited.parts[0].holds.distance, 0);
  EXPECT_TRUE(std::isfinite(limited.parts[0].holds.distance));
  EXPECT_TRUE(parse_trace(trace_bytes(limited), "t").parts == limited.parts);
}

TEST(TraceParts, FilesOfTheThirdVersionDoNotTellWhatMadeTheirSteps) {
  const Trace trace = read_trace(ISORELAX_SOURCE_DIR "/tests/core/trace/recorded/version_3.trace");
  ASSERT_EQ(trace.iterations.size(), 4U);
  ASSERT_EQ(trace.parts.size(), 1U);
  for (const TraceIteration& iteration : trace.iterations) EXPECT_EQ(iteration.kind, StepKind::unknown);
  EXPECT_EQ(trace.iterations.back().quality.inverted, 0U);
  EXPECT_GT(trace.iterations.back().quality.min_angle_deg, trace.quality.min_angle_deg);
}

TEST(TraceParts, AnAttemptThatBeginsAnewDropsThoseOfTheOneBefore) {
  const Recorded recorded = record();
  TraceRecorder recorder({}, recorded.mesh);
  const StepRecord step;
  RunPart first, second, again;
  second.done = 1;
  second.exponent = 4;
  again.holds.still = {4};
  recorder.begin_part(first, recorded.positions[0]);
  recorder.add(1, step, recorded.positions[1]);
  recorder.begin_part(second, recorded.positions[1]);
  recorder.add(2, step, recorded.positions[2]);
  recorder.begin_part(again, recorded.positions[0]);
  EXPECT_TRUE(recorder.trace().iterations.empty()) << "even if it makes no step";
  recorder.add(1, step, recorded.positions[3]);
  ASSERT_EQ(recorder.trace().parts.size(), 1U);
  EXPECT_EQ(recorder.trace().parts[0].holds.still, again.holds.still);
  TraceCursor cursor(recorder.trace());
  EXPECT_EQ(cursor.go_to(1), recorded.positions[3]);
}

}  // namespace
}  // namespace isorelax::test
