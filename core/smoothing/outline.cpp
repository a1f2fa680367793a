#include "smoothing/outline.h"

namespace isorelax {

bool runs_straight(const Vec3& before, const Vec3& at, const Vec3& behind, double rounding) {
  const Vec3 in = at - before, out = behind - at;
  return in.dot(out) > 0 && in.cross(out).norm() <= rounding * (in + out).norm();
}

bool changes_outline(const SmoothingProblem& problem, std::span<const Vec3> positions, Index vertex,
                     double rounding) {
  if (!problem.topology.is_boundary(vertex) || problem.mobility[vertex] == Mobility::none) return false;
  const auto slides = problem.border.find(vertex);
  if (slides == problem.border.end()) return true;
  const auto& [before, behind] = slides->second;
  return !runs_straight(positions[before], positions[vertex], positions[behind], rounding);
}

}  // namespace isorelax
