#include "surface/feature_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

bool is_crease(const FeatureOptions& options, double turn_deg, std::array<double, 2> spread_deg) {
  const double both = std::min(spread_deg[0], spread_deg[1]);
  return (turn_deg >= options.ridge_angle_deg && both >= options.ridge_angle_deg) ||
         (turn_deg > options.sharp_edge_deg && both >= 0.5 * options.ridge_angle_deg);
}

std::vector<FeatureEdge> crease_edges(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                      const Topology& topology, const FeatureOptions& options,
                                      const VertexClasses& classes) {
  std::vector<FeatureEdge> edges;
  for (Corner c = 0; c < 3 * triangles.size(); ++c) {
    if (topology.opposite(c) == kNone || topology.opposite(c) < c) continue;
    const Index v = triangles[c / 3][next(c % 3)];
    const Index w = triangles[c / 3][previous(c % 3)];
    if (classes.classes[v] == VertexClass::smooth || classes.classes[w] == VertexClass::smooth) continue;
    const std::array<double, 2> spread = {classes.spread_deg[v], classes.spread_deg[w]};
    // No smaller angle makes a crease: most edges are done without one.
    if (std::min(spread[0], spread[1]) < 0.5 * options.ridge_angle_deg) continue;
    if (is_crease(options, dihedral_turn_deg(positions, triangles, topology, c), spread))
      edges.push_back({{v, w}, c});
  }
  return edges;
}

}  // namespace isorelax
