#include "surface/feature_edges.h"

#include <algorithm>
#include <cmath>

#include "mesh/angle.h"

namespace isorelax {

double dihedral_turn_deg(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                         const Topology& topology, Corner corner) {
  const Corner other = topology.opposite(corner);
  if (other == kNone) return 0;
  const Triangle& t = triangles[corner / 3];
  const Triangle& u = triangles[other / 3];
  const Vec3 a = area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
  Vec3 b = area_vector(positions[u[0]], positions[u[1]], positions[u[2]]);
  if (a.isZero(0) || b.isZero(0)) return 0;
  if (t[next(corner % 3)] == u[next(other % 3)]) b = -b;  // the two run along the edge the same way
  return angle_between_deg(a, b);
}

bool is_crease(const FeatureOptions& options, double turn_deg, std::array<double, 2> spread_deg) {
  const double both = std::min(spread_deg[0], spread_deg[1]);
  return (turn_deg >= options.ridge_angle_deg && both >= options.ridge_angle_deg) ||
         (turn_deg > options.sharp_edge_deg && both >= 0.5 * options.ridge_angle_deg);
}

}  // namespace isorelax
