#pragma once

#include <optional>
#include <span>
#include <string>

#include "smoothing/problem.h"

namespace isorelax {

/// Where features hold the triangle with the smallest angle, if that is below 15 degrees: one or more of its
/// vertices are kept as corners or ridges.
[[nodiscard]] std::optional<std::string> note_on_worst(const SmoothingProblem& problem,
                                                       std::span<const Vec3> positions);

}  // namespace isorelax
