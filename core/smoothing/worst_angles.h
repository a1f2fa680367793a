#pragma once

#include <limits>
#include <span>
#include <vector>

#include "smoothing/triangle_batch.h"

namespace isorelax {

/// The worst angles of some triangles, by their cotangents: cheap, and monotonous over all angles.
struct WorstAngles {
  double smallest_cot = std::numeric_limits<double>::infinity();  ///< larger for a smaller angle
  double largest_cot = -std::numeric_limits<double>::infinity();  ///< smaller for a larger angle

  /// Those of the triangles whose flag is set.
  static WorstAngles of(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                        std::span<const std::uint8_t> flags);
};

/// Cotangents of the smallest and the largest angle of eight triangles; infinite or not a number for one
/// without area.
struct AngleBatch {
  Lanes smallest_cot, largest_cot;
};
void measure_angles(const EdgeBatch& edges, AngleBatch& out);

}  // namespace isorelax
