#include "trace/trace_diff.h"

#include <algorithm>

#include "io/text_out.h"
#include "trace/trace_parts.h"

namespace isorelax {
namespace {

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

/// How the parts differ that both have, and which ones only one has. Where nothing is known of them in one,
/// nothing is said.
void compare_parts(const Trace& first, const Trace& second, std::vector<TraceSetting>& settings) {
  if (first.parts.empty() || second.parts.empty()) return;
  for (std::size_t k = 0; k < std::max(first.parts.size(), second.parts.size()); ++k) {
    const TracePart* a = k < first.parts.size() ? &first.parts[k] : nullptr;
    const TracePart* b = k < second.parts.size() ? &second.parts[k] : nullptr;
    if (a != nullptr && b != nullptr && *a == *b) continue;
    TraceSetting setting{"part " + std::to_string(k + 1), a != nullptr ? part_text(*a) : "none",
                         b != nullptr ? part_text(*b) : "none"};
    if (setting.first == setting.second) {
      if (a->holds == b->holds) continue;  // the start differs, which is told elsewhere
      setting.second += ", others";
    }
    settings.push_back(std::move(setting));
  }
}

}  // namespace

std::string parting_text(const TraceParting& parting) {
  const auto place = [](const Vec3& p) {
    return "(" + digits_of(p.x()) + ", " + digits_of(p.y()) + ", " + digits_of(p.z()) + ")";
  };
  return "iteration " + std::to_string(parting.iteration) + ", vertex " + std::to_string(parting.vertex) +
         ": " + place(parting.first) + " against " + place(parting.second) + "; " +
         std::to_string(parting.vertices) + " vertices differ there, by up to " + digits_of(parting.largest);
}

bool TraceDifference::none() const {
  return same_triangles && same_length && !parting;
}

std::optional<TraceParting> find_parting(std::span<const Vec3> first, std::span<const Vec3> second,
                                         std::size_t iteration) {
  std::optional<TraceParting> parting;
  for (Index v = 0; v < first.size(); ++v) {
    if (same_bits({&first[v], 1}, {&second[v], 1})) continue;
    if (!parting) parting = TraceParting{iteration, v, 0, first[v], second[v], 0};
    ++parting->vertices;
    parting->largest = std::max(parting->largest, (first[v] - second[v]).norm());
  }
  return parting;
}

TraceDifference compare_traces(const Trace& first, const Trace& second) {
  TraceDifference found;
  const auto setting = [&](const char* name, const std::string& a, const std::string& b) {
    const auto said = [](const std::string& text) { return text.empty() ? "none" : text; };
    if (a != b) found.settings.push_back({name, said(a), said(b)});
  };
  setting("program", first.program, second.program);
  setting("input", first.input, second.input);
  setting("arguments", first.arguments_text(), second.arguments_text());
  setting("files read", listed(first.resources), listed(second.resources));
  compare_parts(first, second, found.settings);
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
