#include "smoothing/worst_note.h"

#include <string_view>
#include <vector>

#include "mesh/degenerate.h"
#include "smoothing/angle_ring.h"
#include "smoothing/short_text.h"

namespace isorelax {
namespace {

/// Degrees below which a smallest angle is a reason to ask.
constexpr double kSmall = 15;

/// "3", "3 and 5" or "3, 5 and 8".
std::string list(std::span<const Index> vertices) {
  std::string text;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i > 0) text += i + 1 == vertices.size() ? " and " : ", ";
    text += std::to_string(vertices[i]);
  }
  return text;
}

}  // namespace

std::optional<std::string> note_on_worst(const SmoothingProblem& problem, std::span<const Vec3> positions) {
  double smallest = kSmall;
  Index worst = kNone;
  for (Index t = 0; t < problem.triangle_count(); ++t) {
    const auto& [a, b, c] = problem.triangles[t];
    if (has_no_area(positions[a], positions[b], positions[c])) continue;
    const double angle = angle_range(positions[a], positions[b], positions[c]).min;
    if (!(angle < smallest)) continue;
    smallest = angle;
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
                     std::to_string(worst) + ", of which";
  const auto tell = [&](const std::vector<Index>& vertices, std::string_view one, std::string_view more) {
    if (vertices.empty()) return;
    text += vertices.size() == 1 ? " vertex " : " vertices ";
    text += list(vertices);
    text += vertices.size() == 1 ? one : more;
  };
  tell(corners, " is kept as a corner", " are kept as corners");
  if (!corners.empty() && !ridges.empty()) text += " and";
  tell(ridges, " is kept on a ridge", " are kept on ridges");
  return text + " (--features DEGREES: of what turns by more only)";
}

}  // namespace isorelax
