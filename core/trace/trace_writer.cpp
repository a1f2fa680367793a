#include <cstring>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "trace/position_delta.h"
#include "trace/trace_file.h"

namespace isorelax {
namespace {

template <typename T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

void append_packed(std::string& bytes, std::string_view name, std::uint64_t size, std::string_view packed) {
  const std::size_t start = bytes.size();
  bytes.append(name);
  append(bytes, size);
  append(bytes, std::uint64_t{packed.size()});
  bytes.append(packed);
  append(bytes, fnv1a(std::string_view(bytes).substr(start)));
}

void append_part(std::string& bytes, std::string_view name, std::string_view content) {
  append_packed(bytes, name, content.size(), compress(content));
}

void put_words(nlohmann::ordered_json& json, const RunWords& words) {
  json["arguments"] = words.arguments;
  json["resources"] = nlohmann::ordered_json::array();
  for (const TraceResource& file : words.resources)
    json["resources"].push_back({{"path", file.path}, {"hash", file.hash}});
}

/// A file name may hold bytes that are not text.
std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string head(const Trace& trace) {
  nlohmann::ordered_json json;
  json["program"] = trace.program;
  json["input"] = trace.input;
  put_words(json, trace);
  json["vertices"] = trace.positions.size();
  json["triangles"] = trace.triangles.size();
  json["iterations"] = trace.iterations.size();
  json["parts"] = trace.parts.size();
  json["min_angle_deg"] = trace.quality.min_angle_deg;
  json["max_angle_deg"] = trace.quality.max_angle_deg;
  json["mean_min_angle_deg"] = trace.quality.mean_min_angle_deg;
  json["inverted"] = trace.quality.inverted;
  json["interrupted"] = trace.interrupted;
  json["stopped"] = trace.stopped;
  json["stopped_because"] = trace.stopped_because;
  return text_of(json);
}

std::string content_of(const TracePart& part) {
  std::string bytes;
  append(bytes, std::uint64_t{part.done});
  append(bytes, part.exponent);
  append(bytes, part.holds.distance);
  append(bytes, (part.kind == PartKind::polish ? kTracePartPolish : std::uint64_t{0}) |
                    (part.from_base ? kTracePartFromBase : std::uint64_t{0}) |
                    (part.words ? kTracePartWords : std::uint64_t{0}) |
                    (part.holds.on_fits ? kTracePartOnFits : std::uint64_t{0}) |
                    (part.holds.apart ? kTracePartApart : std::uint64_t{0}));
  append(bytes, std::uint64_t{part.holds.still.size()});
  for (const Index v : part.holds.still) append(bytes, v);
  if (part.words) {
    nlohmann::ordered_json json;
    put_words(json, *part.words);
    bytes += text_of(json);
  }
  return bytes;
}

}  // namespace

std::string trace_bytes(const Trace& trace) {
  std::string bytes(kTraceMagic);
  append(bytes, kTraceVersion);
  append_part(bytes, "HEAD", head(trace));
  std::string mesh;
  mesh.reserve(trace.positions.size() * sizeof(Vec3) + trace.triangles.size() * sizeof(Triangle));
  for (const Vec3& p : trace.positions)
    for (const double x : p) append(mesh, x);
  for (const Triangle& t : trace.triangles) append(mesh, t);
  append_part(bytes, "MESH", mesh);
  for (const TracePart& part : trace.parts) {
    append_part(bytes, "PART", content_of(part));
    append_packed(bytes, "BASE", part.base.empty() ? 0 : trace.positions.size() * sizeof(Vec3), part.base);
  }
  for (const TraceIteration& iteration : trace.iterations) {
    std::string numbers;
    visit_numbers(iteration, [&](std::string_view, const auto& value) { append(numbers, value); });
    append_part(bytes, "STEP", numbers);
    append_packed(bytes, "MOVE", trace.positions.size() * sizeof(Vec3), iteration.delta);
  }
  append_part(bytes, "DONE", "");
  return bytes;
}

void write_trace(const std::filesystem::path& path, const Trace& trace) {
  write_file_atomically(path, trace_bytes(trace));
}

}  // namespace isorelax
