#include "smoothing/renumbered_problem.h"

#include <algorithm>

namespace isorelax {
namespace {

class Renumberer {
 public:
  explicit Renumberer(const SmoothingProblem& problem)
      : p_(problem), vertex_(inverse(vertices())), triangle_(inverse(triangles())) {}

  [[nodiscard]] SmoothingProblem run() const {
    const std::vector<Triangle> moved = moved_triangles();
    Topology topology(moved, p_.vertex_count());
    VertexClasses classes = moved_classes(moved, topology);
    return {.triangles = moved,
            .topology = std::move(topology),
            .reference = p_.reference.in_order(triangles()),
            .weights = p_.weights,
            .exponent = p_.exponent,
            .classes = std::move(classes),
            .mobility = in_order(vertices(), p_.mobility),
            .fixed_limits = in_order(vertices(), p_.fixed_limits),
            .treated = in_order(triangles(), p_.treated),
            .border = moved_border(),
            .plane_normal = p_.plane_normal,
            .surface = p_.surface,
            .anchors = in_order(vertices(), p_.anchors),
            .near = moved_near(moved),
            .apart = p_.apart,
            .initial_normals = in_order(triangles(), p_.initial_normals),
            .surrounding_normals = moved_normals(),
            .worst_angles = p_.worst_angles,
            .numbering = {},
            .mean_edge_length = p_.mean_edge_length,
            .threads = p_.threads,
            .notes = {},
            .sliding = {}};
  }

 private:
  [[nodiscard]] std::span<const Index> vertices() const { return p_.numbering.vertices; }
  [[nodiscard]] std::span<const Index> triangles() const { return p_.numbering.triangles; }

  /// Corners keep their places in their triangles.
  [[nodiscard]] std::vector<Triangle> moved_triangles() const {
    std::vector<Triangle> moved = in_order(triangles(), p_.triangles);
    for (Triangle& t : moved)
      for (Index& v : t) v = vertex_[v];
    return moved;
  }

  [[nodiscard]] VertexClasses moved_classes(std::span<const Triangle> moved, const Topology& topology) const {
    VertexClasses classes;
    classes.classes = in_order(vertices(), p_.classes.classes);
    for (const FeatureEdge& e : p_.classes.creases) {
      const Corner one = 3 * triangle_[e.corner / 3] + e.corner % 3;
      const Corner corner = std::min(one, topology.opposite(one));
      const Triangle& t = moved[corner / 3];
      classes.creases.push_back({{t[next(corner % 3)], t[previous(corner % 3)]}, corner});
    }
    std::ranges::sort(classes.creases, {}, &FeatureEdge::corner);
    return classes;
  }

  [[nodiscard]] std::unordered_map<Index, Vec3> moved_normals() const {
    std::unordered_map<Index, Vec3> normals;
    for (const auto& [t, normal] : p_.surrounding_normals) normals[triangle_[t]] = normal;
    return normals;
  }

  [[nodiscard]] std::unordered_map<Index, std::array<Index, 2>> moved_border() const {
    std::unordered_map<Index, std::array<Index, 2>> border;
    for (const auto& [v, ends] : p_.border) border[vertex_[v]] = {vertex_[ends[0]], vertex_[ends[1]]};
    return border;
  }

  [[nodiscard]] std::optional<NearSurface> moved_near(std::span<const Triangle> moved) const {
    if (!p_.near) return {};
    std::vector<Vec3> positions = in_order(vertices(), p_.near->positions);
    auto surface = p_.surface ? p_.near->surface : std::make_shared<ClosestPointIndex>(positions, moved);
    return NearSurface{p_.near->distance, std::move(positions), std::move(surface), p_.near->on_fits};
  }

  const SmoothingProblem& p_;
  std::vector<Index> vertex_, triangle_;  // new numbers
};

}  // namespace

SmoothingProblem renumbered(const SmoothingProblem& problem) {
  return Renumberer(problem).run();
}

}  // namespace isorelax
