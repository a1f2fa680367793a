#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/trace/recorded.h"
#include "mesh/error.h"
#include "trace/position_delta.h"
#include "trace/trace_diff.h"
#include "trace/trace_export.h"
#include "trace/trace_file.h"

namespace isorelax::test {
namespace {

TEST(TraceFile, HoldsTheWholeRun) {
  Recorded recorded = record();
  recorded.trace.resources = {{"held.txt", hash_of("1 2 3")}};
  const Trace back = parse_trace(trace_bytes(recorded.trace), "t");
  EXPECT_EQ(back.program, recorded.trace.program);
  EXPECT_EQ(back.input, recorded.trace.input);
  EXPECT_EQ(back.arguments, recorded.trace.arguments);
  EXPECT_EQ(back.resources, recorded.trace.resources);
  EXPECT_EQ(back.stopped_because, recorded.trace.stopped_because);
  EXPECT_EQ(back.quality, recorded.trace.quality);
  EXPECT_TRUE(compare_traces(back, recorded.trace).none());
  for (std::size_t k = 0; k < back.iterations.size(); ++k) {
    visit_numbers(back.iterations[k], [&](std::string_view name, const auto& value) {
      visit_numbers(recorded.trace.iterations[k], [&](std::string_view other, const auto& expected) {
        if (other == name) {
          EXPECT_EQ(static_cast<double>(value), static_cast<double>(expected)) << name;
        }
      });
    });
  }
}

TEST(TraceFile, RefusesEveryFlippedByteWithItsPlace) {
  const std::string bytes = trace_bytes(record(2).trace);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    try {
      (void)parse_trace(damaged, "run.trace");
      ADD_FAILURE() << "byte " << at << " does not matter";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("run.trace: byte ", 0), 0U) << error.what();
    }
  }
}

TEST(TraceFile, RefusesEveryTruncationAndWhatFollowsTheEnd) {
  const std::string bytes = trace_bytes(record(2).trace);
  for (std::size_t size = 0; size < bytes.size(); size += size < 300 ? 1 : 37)
    EXPECT_THROW((void)parse_trace(bytes.substr(0, size), "t"), InputError) << size;
  EXPECT_THROW((void)parse_trace(bytes + "x", "t"), InputError);
  EXPECT_THROW((void)parse_trace("OFF\n1 2 3\n", "t"), InputError);
  std::string later = bytes;
  later[kTraceMagic.size()] = kTraceVersion + 1;
  try {
    (void)parse_trace(later, "t");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("version " + std::to_string(kTraceVersion + 1)),
              std::string::npos);
  }
}

/// The file with another head, its checksum made to fit.
std::string with_head(const std::string& bytes, const std::function<void(nlohmann::json&)>& change) {
  const auto number_at = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto as_bytes = [](std::uint64_t value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
  };
  const std::size_t start = kTraceMagic.size() + sizeof kTraceVersion;
  const std::uint64_t length = number_at(start + 12);
  std::string head;
  EXPECT_TRUE(decompress(std::string_view(bytes).substr(start + 20, length), number_at(start + 4), head));
  nlohmann::json json = nlohmann::json::parse(head);
  change(json);
  const std::string packed = compress(json.dump());
  const std::string part = "HEAD" + as_bytes(json.dump().size()) + as_bytes(packed.size()) + packed;
  return bytes.substr(0, start) + part + as_bytes(fnv1a(part)) + bytes.substr(start + 28 + length);
}

TEST(TraceFile, RefusesCountsWhoseSizesOverflow) {
  const Trace trace = record(2).trace;
  const std::string bytes = trace_bytes(trace);
  EXPECT_NO_THROW((void)parse_trace(with_head(bytes, [](nlohmann::json&) {}), "t"));
  // 2^61 and 2^64 - 1 vertices, of 24 bytes each, and as many triangles, of 12, as make up for them.
  const std::uint64_t vertices = trace.positions.size(), triangles = trace.triangles.size();
  for (const auto& [lie, others] :
       {std::pair(std::uint64_t{1} << 61U, triangles + 2 * vertices),
        std::pair(~std::uint64_t{0}, triangles + 2 * vertices + 2), std::pair(vertices, triangles << 60U)}) {
    const std::string damaged = with_head(bytes, [lied = lie, made_up = others](nlohmann::json& json) {
      json["vertices"] = lied;
      json["triangles"] = made_up;
    });
    EXPECT_THROW((void)parse_trace(damaged, "t"), InputError) << lie;
  }
  const std::string negative = with_head(bytes, [](nlohmann::json& json) { json["vertices"] = -1; });
  EXPECT_THROW((void)parse_trace(negative, "t"), InputError);
}

TEST(TraceFile, RefusesPositionsThatAreNotFinite) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Trace trace = record(2).trace;
    trace.positions[5].y() = x;
    EXPECT_THROW((void)parse_trace(trace_bytes(trace), "t"), InputError) << x;
  }
}

TEST(TraceFile, TellsWhatMadeEachStep) {
  Trace trace = record(3).trace;
  trace.iterations[0].kind = StepKind::even_out;
  trace.iterations[2].kind = StepKind::raise_mean;
  const Trace back = parse_trace(trace_bytes(trace), "t");
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(back.iterations[k].kind, trace.iterations[k].kind) << k;
  EXPECT_NE(trace_csv(back).find(",even out\n"), std::string::npos);
  EXPECT_NE(trace_json(back).find("\"kind\": \"mean angle\""), std::string::npos);
  trace.iterations[1].kind = static_cast<StepKind>(kStepKinds);
  EXPECT_THROW((void)parse_trace(trace_bytes(trace), "t"), InputError);
}

TEST(TraceFile, IsSmallerThanItsPositions) {
  const Recorded recorded = record(20);
  EXPECT_LT(trace_bytes(recorded.trace).size(),
            recorded.positions.size() * recorded.mesh.positions.size() * sizeof(Vec3));
}

}  // namespace
}  // namespace isorelax::test
