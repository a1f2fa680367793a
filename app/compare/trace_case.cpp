#include "compare/trace_case.h"

#include "render/camera.h"
#include "trace/trace_diff.h"
#include "trace/trace_file.h"

namespace isorelax::compare {
namespace {

void add_ends(const Trace& a, const Trace& b, Case& result) {
  const auto add = [&](const char* key, const char* label, double of_a, double of_b) {
    result.figures.push_back({key, label, of_a, of_b});
  };
  const auto energy = [](const Trace& trace) {
    return trace.iterations.empty() ? 0 : trace.iterations.back().after.energy;
  };
  const auto quality = [](const Trace& trace) {
    return trace.iterations.empty() ? trace.quality : trace.iterations.back().quality;
  };
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  add("iterations", "Iterations", count(a.iterations.size()), count(b.iterations.size()));
  add("energy", "Energy at the end", energy(a), energy(b));
  add("min_angle_deg", "Smallest angle, degrees", quality(a).min_angle_deg, quality(b).min_angle_deg);
  add("max_angle_deg", "Largest angle, degrees", quality(a).max_angle_deg, quality(b).max_angle_deg);
  add("mean_min_angle_deg", "Mean smallest angle, degrees", quality(a).mean_min_angle_deg,
      quality(b).mean_min_angle_deg);
}

void add_parting(const TraceDifference& found, Case& result) {
  result.figures.push_back(
      {"common_iterations", "Iterations that both have", static_cast<double>(found.common_iterations), {}});
  if (!found.parting) {
    result.notes.push_back("The same to the bit for " + std::to_string(found.common_iterations) +
                           " iterations.");
    return;
  }
  const TraceParting& at = *found.parting;
  result.figures.push_back(
      {"parting_iteration", "Iteration at which they part", static_cast<double>(at.iteration), {}});
  result.figures.push_back({"parting_vertex", "First vertex that differs there", double(at.vertex), {}});
  result.figures.push_back(
      {"parting_vertices", "Vertices that differ there", static_cast<double>(at.vertices), {}});
  result.notes.push_back("They part at " + parting_text(at) + ".");
}

}  // namespace

Case compare_trace_files(const std::filesystem::path& a, const std::filesystem::path& b,
                         double displacement) {
  const Trace first = read_trace(a);
  const Trace second = read_trace(b);
  const TraceDifference found = compare_traces(first, second);
  Case result;
  result.name = result.b = b.string();
  result.a = a.string();
  for (const TraceSetting& setting : found.settings)
    result.notes.push_back(setting.name + ": " + setting.first + " | " + setting.second);
  add_ends(first, second, result);
  if (!found.same_triangles) {
    result.failure = "the runs have different triangles: their iterations cannot be compared";
    return result;
  }
  if (!found.same_length) result.failure = "one run has more iterations than the other";
  add_parting(found, result);
  const double length = render::bounds_of(first.positions).diagonal();
  const double apart = found.distance_at_end / (length > 0 ? length : 1);
  result.verdicts.push_back({"max-displacement",
                             "largest distance of a vertex between the ends, of the diagonal", apart,
                             displacement, false, apart <= displacement});
  return result;
}

}  // namespace isorelax::compare
