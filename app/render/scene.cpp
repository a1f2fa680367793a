#include "render/scene.h"

#include <atomic>

namespace isorelax::render {

Revision next_revision() {
  static std::atomic<Revision> last{kUnknownRevision};
  return ++last;
}

Bounds bounds_of(const Scene& scene) {
  Bounds all;
  bool empty = true;
  for (const SceneMesh& mesh : scene.meshes) {
    if (mesh.positions.empty()) continue;
    const Bounds bounds = bounds_of(mesh.positions);
    all.low = empty ? bounds.low : Vec3(all.low.cwiseMin(bounds.low));
    all.high = empty ? bounds.high : Vec3(all.high.cwiseMax(bounds.high));
    empty = false;
  }
  return all;
}

std::vector<std::uint8_t> mark_boundary_edges(const Topology& topology) {
  std::vector<std::uint8_t> marks(topology.triangle_count());
  for (Index t = 0; t < topology.triangle_count(); ++t)
    for (unsigned k = 0; k < 3; ++k)
      if (topology.is_boundary_edge(3 * t + k)) marks[t] |= kMarkedEdge[k];
  return marks;
}

}  // namespace isorelax::render
