#include "trace/trace_diff.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace isorelax {
namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

double largest_distance(std::span<const Vec3> first, std::span<const Vec3> second) {
  double largest = 0;
  for (std::size_t v = 0; v < first.size(); ++v) largest = std::max(largest, (first[v] - second[v]).norm());
  return largest;
}

std::string listed(const std::vector<TraceResource>& files) {
  std::string text;
  for (const TraceResource& file : files)
    text += (text.empty() ? "" : ", ") + file.path + " (" + file.hash + ")";
  return text;
}

}  // namespace

bool TraceDifference::none() const {
  return same_triangles && same_length && !parting;
}

std::optional<TraceParting> find_parting(std::span<const Vec3> first, std::span<const Vec3> second,
                                         std::size_t iteration) {
  std::optional<TraceParting> parting;
  for (Index v = 0; v < first.size(); ++v) {
    if (same_bits(first[v], second[v])) continue;
    if (!parting) parting = TraceParting{iteration, v, 0, first[v], second[v], 0};
    ++parting->vertices;
    parting->largest = std::max(parting->largest, (first[v] - second[v]).norm());
  }
  return parting;
}

TraceDifference compare_traces(const Trace& first, const Trace& second) {
  TraceDifference found;
  const auto setting = [&](const char* name, const std::string& a, const std::string& b) {
    if (a != b) found.settings.push_back({name, a, b});
  };
  setting("program", first.program, second.program);
  setting("input", first.input, second.input);
  setting("arguments", first.arguments_text(), second.arguments_text());
  setting("files read", listed(first.resources), listed(second.resources));
  setting("iterations", std::to_string(first.iterations.size()), std::to_string(second.iterations.size()));
  setting("stopped", first.stopped, second.stopped);
  found.same_length = first.iterations.size() == second.iterations.size();
  found.same_triangles =
      first.positions.size() == second.positions.size() && first.triangles == second.triangles;
  if (!found.same_triangles) return found;
  found.common_iterations = std::min(first.iterations.size(), second.iterations.size());
  TraceCursor a(first);
  TraceCursor b(second);
  for (std::size_t k = 0; k <= found.common_iterations; ++k) {
    a.go_to(k);
    b.go_to(k);
    if (!found.parting) found.parting = find_parting(a.positions(), b.positions(), k);
  }
  found.distance_at_end = largest_distance(a.positions(), b.positions());
  return found;
}

}  // namespace isorelax
