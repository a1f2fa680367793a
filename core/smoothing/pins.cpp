#include "smoothing/pins.h"

namespace isorelax {
namespace {

template <typename Predicate>
std::vector<Index> vertices_where(std::size_t count, const Predicate& holds) {
  std::vector<Index> found;
  for (Index v = 0; v < count; ++v)
    if (holds(v)) found.push_back(v);
  return found;
}

}  // namespace

std::vector<Index> boundary_vertices(const Topology& topology) {
  return vertices_where(topology.vertex_count(), [&](Index v) {
    return (topology.flags(v) & (kBoundaryVertex | kNonManifoldVertex)) != 0;
  });
}

std::vector<Index> feature_vertices(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                    const Topology& topology, const FeatureOptions& options,
                                    unsigned threads) {
  const VertexClasses found = classify_vertices(positions, triangles, topology, options, threads);
  return vertices_where(positions.size(), [&](Index v) {
    return found.classes[v] == VertexClass::ridge || found.classes[v] == VertexClass::corner;
  });
}

std::vector<Index> vertices_in(const Box& box, std::span<const Vec3> positions) {
  return vertices_where(positions.size(), [&](Index v) {
    return (positions[v].array() >= box.low.array()).all() &&
           (positions[v].array() <= box.high.array()).all();
  });
}

}  // namespace isorelax
