#pragma once

#include <span>
#include <vector>

#include "motion/flow_map.h"

namespace isorelax {

/// An edge of a mesh and one of its triangles: the corner opposite to the edge.
struct MiddledEdge {
  Index a = 0, b = 0;
  Corner corner = 0;
};

/// How far the surface stands off a mesh whose vertices are points on it: at the middle of every edge, from
/// the middle of the chord to the surface's own middle between the two points.
class EdgeMiddles {
 public:
  EdgeMiddles(std::span<const Triangle> triangles, const Topology& topology, unsigned threads);

  [[nodiscard]] std::span<const MiddledEdge> edges() const { return edges_; }
  /// Finds all heights; `positions` are those of the points.
  void measure(const FlowMap& map, std::span<const MaterialPoint> points, std::span<const Vec3> positions);
  /// From the chord to the surface, edge by edge.
  [[nodiscard]] std::span<const Vec3> heights() const { return heights_; }
  /// How far the chord's middle is from the surface: along its normal, or at a right angle to a crease or
  /// border. A motion that stretches unevenly moves the surface's own middle along it.
  [[nodiscard]] double distance(const MaterialSurface& surface, std::size_t edge,
                                std::span<const Vec3> positions) const;
  /// The surface's middles and where they are on the material surface.
  [[nodiscard]] const MappedPoint& mapped(std::size_t edge) const { return mapped_[edge]; }
  [[nodiscard]] const MaterialPoint& middle(std::size_t edge) const { return middles_[edge]; }

 private:
  unsigned threads_;
  std::vector<MiddledEdge> edges_;
  std::vector<MaterialPoint> middles_;
  std::vector<MappedPoint> mapped_;
  std::vector<Vec3> heights_;
};

}  // namespace isorelax
