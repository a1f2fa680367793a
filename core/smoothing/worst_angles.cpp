#include "smoothing/worst_angles.h"

#include <algorithm>
#include <cmath>

namespace isorelax {

/// The cotangent opposite an edge is (sum of the squares of all three - 2 its own square) / (4 area), the
/// smallest angle opposite the shortest one.
ISORELAX_VECTOR_CLONES
void measure_angles(const EdgeBatch& e, AngleBatch& out) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double ax = e.e1x.at[i], ay = e.e1y.at[i], az = e.e1z.at[i];
    const double bx = e.e2x.at[i], by = e.e2y.at[i], bz = e.e2z.at[i];
    const double cx = bx - ax, cy = by - ay, cz = bz - az;
    const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const double aa = ax * ax + ay * ay + az * az;
    const double bb = bx * bx + by * by + bz * bz;
    const double cc = cx * cx + cy * cy + cz * cz;
    const double inverse = 0.5 / std::sqrt(nx * nx + ny * ny + nz * nz);
    const double sum = aa + bb + cc;
    const double ab = aa < bb ? aa : bb, ab_above = aa < bb ? bb : aa;
    const double shortest = ab < cc ? ab : cc, longest = ab_above < cc ? cc : ab_above;
    out.smallest_cot.at[i] = (sum - 2 * shortest) * inverse;
    out.largest_cot.at[i] = (sum - 2 * longest) * inverse;
  }
}

WorstAngles WorstAngles::of(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                            std::span<const std::uint8_t> flags) {
  WorstAngles worst{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  EdgeBatch edges;
  AngleBatch angles;
  for (std::size_t first = 0; first < triangles.size(); first += kLanes) {
    const BatchIds ids = BatchIds::of_range(first, triangles.size());
    edges.load(positions, triangles, ids);
    measure_angles(edges, angles);
    for (unsigned i = 0; i < ids.count; ++i) {
      if (flags[ids.at[i]] == 0) continue;
      worst.smallest_cot = std::max(worst.smallest_cot, angles.smallest_cot.at[i]);
      worst.largest_cot = std::min(worst.largest_cot, angles.largest_cot.at[i]);
    }
  }
  return worst;
}

}  // namespace isorelax
