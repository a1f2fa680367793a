#include "motion/edge_middles.h"

#include "mesh/parallel.h"

namespace isorelax {

EdgeMiddles::EdgeMiddles(std::span<const Triangle> triangles, const Topology& topology, unsigned threads)
    : threads_(threads) {
  for (Corner corner = 0; corner < 3 * triangles.size(); ++corner) {
    const Corner other = topology.opposite(corner);
    if (other != kNone && other < corner) continue;  // has its turn there
    const Triangle& t = triangles[corner / 3];
    edges_.push_back({t[next(corner % 3)], t[previous(corner % 3)], corner});
  }
  middles_.resize(edges_.size());
  mapped_.resize(edges_.size());
  heights_.resize(edges_.size());
}

void EdgeMiddles::measure(const FlowMap& map, std::span<const MaterialPoint> points,
                          std::span<const Vec3> positions) {
  const MaterialSurface& surface = map.surface();
  parallel_for_blocks(edges_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [a, b, corner] = edges_[e];
      const Vec3 way = 0.5 * (surface.point(points[b]) - surface.point(points[a]));
      const auto& frame = surface.frame(points[a].triangle);
      middles_[e] = surface.walk(points[a], Eigen::Vector2d(way.dot(frame[0]), way.dot(frame[1])));
      mapped_[e] = map.map(middles_[e]);
      heights_[e] = mapped_[e].position - 0.5 * (positions[a] + positions[b]);
    }
  });
}

}  // namespace isorelax
