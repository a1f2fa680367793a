#include "smoothing/worst_note.h"

#include <vector>

#include "quality/triangle_metrics.h"
#include "smoothing/sentences.h"

namespace isorelax {
namespace {

/// Degrees below which a smallest angle is a reason to ask.
constexpr double kSmall = 15;

}  // namespace

std::optional<std::string> note_on_worst(const SmoothingProblem& problem, std::span<const Vec3> positions) {
  double smallest = kSmall;
  Index worst = kNone;
  for (Index t = 0; t < problem.triangle_count(); ++t) {
    const TriangleMetrics metrics = measure_triangle(positions, problem.triangles[t]);
    if (metrics.degenerate || !(metrics.min_angle_deg < smallest)) continue;
    smallest = metrics.min_angle_deg;
    worst = t;
  }
  if (worst == kNone) return {};
  std::vector<Index> corners, ridges;
  for (const Index v : problem.triangles[worst]) {
    const VertexClass kind = problem.classes.classes[v];
    if (kind == VertexClass::corner) corners.push_back(v);
    if (kind == VertexClass::ridge) ridges.push_back(v);
  }
  if (corners.empty() && ridges.empty()) return {};
  std::string text = "the smallest angle, " + short_text(smallest) + " degrees, is in triangle " +
                     std::to_string(worst) + ", of which ";
  if (!corners.empty())
    text +=
        counted(corners.size(), "vertex is a corner (", "vertices are corners (") + list_ids(corners) + ")";
  if (!corners.empty() && !ridges.empty()) text += " and ";
  if (!ridges.empty())
    text += counted(ridges.size(), "is on a ridge (", "are on ridges (") + list_ids(ridges) + ")";
  return text + ": --features DEGREES keeps only what turns by more";
}

}  // namespace isorelax
