#include "motion/edge_middles.h"

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Whether a vertex is where it was at the start.
bool is_at_start(const MaterialSurface& surface, const MaterialPoint& point, Index vertex) {
  for (unsigned k = 0; k < 3; ++k)
    if (point.weights[k] == 1) return surface.triangles()[point.triangle][k] == vertex;
  return false;
}

/// Of a vertex that is still where it was at the start, on a crease as well, the point's triangle may lie on
/// the other side of a wall: no walk begins there.
MaterialPoint middle_of(const MaterialSurface& surface, const MiddledEdge& edge,
                        std::span<const MaterialPoint> points) {
  const bool a_is_left = !is_at_start(surface, points[edge.a], edge.a);
  const bool b_is_left = !is_at_start(surface, points[edge.b], edge.b);
  if (!a_is_left && !b_is_left) {
    MaterialPoint middle{edge.corner / 3, Vec3::Constant(0.5)};
    middle.weights[edge.corner % 3] = 0;
    return middle;
  }
  const MaterialPoint& from = points[a_is_left ? edge.a : edge.b];
  const MaterialPoint& to = points[a_is_left ? edge.b : edge.a];
  const Vec3 way = 0.5 * (surface.point(to) - surface.point(from));
  const auto& frame = surface.frame(from.triangle);
  return surface.walk(from, Eigen::Vector2d(way.dot(frame[0]), way.dot(frame[1])));
}

/// The part of a vector at a right angle to another: of a line, what it lacks.
Vec3 across(const Vec3& x, const Vec3& direction) {
  const double squared = direction.squaredNorm();
  return squared > 0 ? Vec3(x - direction.dot(x) / squared * direction) : x;
}

/// Its part along the surface's normal: a motion that stretches unevenly moves middles along the surface.
Vec3 along_normal(const Vec3& x, const Eigen::Matrix<double, 3, 2>& jacobian) {
  const Vec3 normal = jacobian.col(0).cross(jacobian.col(1));
  const double squared = normal.squaredNorm();
  return squared > 0 ? Vec3(normal.dot(x) / squared * normal) : x;
}

}  // namespace

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
  parallel_for_blocks(edges_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [a, b, corner] = edges_[e];
      middles_[e] = middle_of(map.surface(), edges_[e], points);
      mapped_[e] = map.map(middles_[e]);
      heights_[e] = mapped_[e].position - 0.5 * (positions[a] + positions[b]);
    }
  });
}

double EdgeMiddles::distance(const MaterialSurface& surface, std::size_t edge,
                             std::span<const Vec3> positions) const {
  const auto [a, b, corner] = edges_[edge];
  return surface.is_wall(corner) ? across(heights_[edge], positions[b] - positions[a]).norm()
                                 : along_normal(heights_[edge], mapped_[edge].jacobian).norm();
}

}  // namespace isorelax
