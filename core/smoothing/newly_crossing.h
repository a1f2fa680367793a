#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"

namespace isorelax {

/// Triangles that cross others at `to`, each as often as it does, where none did at `from`: neither the two
/// nor any that share vertices with them, for others may cross where vertices slid along. In a plane those
/// whose border edges cross, if none did.
[[nodiscard]] std::vector<Index> newly_crossing(const SmoothingProblem& problem, std::span<const Vec3> from,
                                                std::span<const Vec3> to);

/// The same of pairs with at least one of `some`.
[[nodiscard]] std::vector<Index> newly_crossing(const SmoothingProblem& problem, std::span<const Index> some,
                                                std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace isorelax
