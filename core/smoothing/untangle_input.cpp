#include <algorithm>

#include "mesh/error.h"
#include "quality/inverted.h"
#include "smoothing/orientation_field.h"
#include "smoothing/problem.h"

namespace isorelax {
namespace {

/// On a surface, one in so many triangles has to be upside down. A few in a scan are its sharp folds: turning
/// them moves corners and leaves the surface, which costs more than it brings.
constexpr std::size_t kOnePerTriangles = 200;

/// What may move however upside down its triangles are: inside of a sound two-sided surface.
std::vector<std::uint8_t> inner_vertices(const Topology& topology) {
  std::vector<std::uint8_t> movable(topology.vertex_count(), 0);
  for (Index v = 0; v < topology.vertex_count(); ++v) movable[v] = topology.flags(v) == 0 ? 1 : 0;
  return movable;
}

/// A fold looks like a crease: only what no inverted triangle touches is known to be one.
void hold_features(std::vector<std::uint8_t>& movable, std::span<const Vec3> positions,
                   std::span<const Triangle> triangles, const Topology& topology,
                   const ProblemOptions& options) {
  std::vector<std::uint8_t> folded(positions.size(), 0);
  const auto inverted = inverted_triangles(positions, triangles, topology, options.threads);
  if (inverted.empty()) return;
  for (const Index t : doubtful_triangles(inverted, positions, triangles, topology))
    for (const Index v : triangles[t]) folded[v] = 1;
  const VertexClasses classes =
      classify_vertices(positions, triangles, topology, options.features, options.threads);
  for (Index v = 0; v < positions.size(); ++v) {
    if (folded[v] == 0 && classes.classes[v] != VertexClass::smooth) movable[v] = 0;
  }
}

}  // namespace

UntangleResult untangle_input(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options) {
  if (options.untangle == UntangleRule::off) return {};
  const Topology topology(triangles, static_cast<Index>(positions.size()));
  std::vector<std::uint8_t> movable = inner_vertices(topology);
  for (const Index v : options.pinned) {
    if (v < movable.size()) movable[v] = 0;
  }
  if (!plane_normal(positions, triangles, topology, options.threads)) {
    const std::size_t inverted = inverted_triangles(positions, triangles, topology, options.threads).size();
    if (kOnePerTriangles * inverted < triangles.size()) return {inverted, inverted, {}};
    hold_features(movable, positions, triangles, topology, options);
  }
  return untangle(positions, triangles, topology, movable, options.threads);
}

}  // namespace isorelax
