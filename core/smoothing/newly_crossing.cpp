#include "smoothing/newly_crossing.h"

#include <algorithm>
#include <array>

#include "surface/crossings.h"

namespace isorelax {
namespace {

/// Whether one of the triangles that share a vertex with the first crossed one of those of the second.
bool cross_about(const SmoothingProblem& problem, std::span<const Vec3> x, const std::array<Index, 2>& pair) {
  const auto about = [&](Index t, const auto& look_at) {
    return std::ranges::any_of(problem.triangles[t], [&](Index v) {
      return std::ranges::any_of(problem.topology.corners_of(v), [&](Corner c) { return look_at(c / 3); });
    });
  };
  return about(pair[0], [&](Index s) {
    return about(pair[1], [&](Index t) { return do_cross(x, problem.triangles[s], problem.triangles[t]); });
  });
}

std::vector<Index> newly_overlapping(const SmoothingProblem& problem, std::span<const Vec3> from,
                                     std::span<const Vec3> to) {
  const auto borders = [&](std::span<const Vec3> x) {
    return crossing_borders(x, problem.triangles, problem.topology, *problem.plane_normal, problem.threads);
  };
  const auto pairs = borders(to);
  if (pairs.empty() || !borders(from).empty()) return {};
  std::vector<Index> found;
  for (const auto& [c, d] : pairs) found.insert(found.end(), {c / 3, d / 3});
  return found;
}

std::vector<Index> new_of(const SmoothingProblem& problem, std::span<const Vec3> from,
                          std::span<const std::array<Index, 2>> pairs) {
  std::vector<Index> found;
  for (const auto& pair : pairs)
    if (!cross_about(problem, from, pair)) found.insert(found.end(), pair.begin(), pair.end());
  return found;
}

}  // namespace

std::vector<Index> newly_crossing(const SmoothingProblem& problem, std::span<const Vec3> from,
                                  std::span<const Vec3> to) {
  if (problem.plane_normal) return newly_overlapping(problem, from, to);
  const auto& triangles = problem.triangles;
  return new_of(problem, from, crossing_pairs({to, triangles}, to, triangles, problem.threads));
}

std::vector<Index> newly_crossing(const SmoothingProblem& problem, std::span<const Index> some,
                                  std::span<const Vec3> from, std::span<const Vec3> to) {
  if (problem.plane_normal) return newly_overlapping(problem, from, to);
  const auto& triangles = problem.triangles;
  return new_of(problem, from, crossing_pairs_of(some, {to, triangles}, to, triangles, problem.threads));
}

}  // namespace isorelax
