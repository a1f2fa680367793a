#include "smoothing/pins.h"

#include <algorithm>

namespace isorelax {
namespace {

template <typename Predicate>
std::vector<Index> vertices_where(std::size_t count, const Predicate& holds) {
  std::vector<Index> found;
  for (Index v = 0; v < count; ++v)
    if (holds(v)) found.push_back(v);
  return found;
}

/// The groups of elements of one kind.
class Groups {
 public:
  explicit Groups(const std::vector<Attribute>& values) {
    for (const Attribute& attribute : values)
      if (attribute.width == 1 && (attribute.name == kPhysicalGroup || attribute.name == kGeometricEntity))
        groups_.push_back(&attribute);
  }
  [[nodiscard]] bool empty() const { return groups_.empty(); }
  [[nodiscard]] bool same(std::size_t a, std::size_t b) const {
    return std::ranges::all_of(groups_,
                               [&](const Attribute* group) { return group->values[a] == group->values[b]; });
  }

 private:
  std::vector<const Attribute*> groups_;
};

void mark_lines(const LowerElements& lines, const Topology& topology, std::vector<std::uint8_t>& marked) {
  const Groups groups(lines.values);
  if (groups.empty()) return;
  std::vector<Index> first(topology.vertex_count(), kNone);  // line at each vertex
  for (std::size_t end = 0; end < lines.vertices.size(); ++end) {
    const Index v = lines.vertices[end];
    const auto line = static_cast<Index>(end / 2);
    if (first[v] == kNone) first[v] = line;
    if (!topology.is_boundary(v) || !groups.same(first[v], line)) marked[v] = 1;
  }
}

void mark_triangles(const TriangleMesh& mesh, const Topology& topology, std::vector<std::uint8_t>& marked) {
  const Groups groups(mesh.attributes.face);
  if (groups.empty()) return;
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Corner other = topology.opposite(c);
    if (other == kNone || groups.same(c / 3, other / 3)) continue;
    for (const unsigned k : {next(c % 3), previous(c % 3)}) marked[mesh.triangles[c / 3][k]] = 1;
  }
}

}  // namespace

std::vector<Index> marked_vertices(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<std::uint8_t> marked(mesh.positions.size(), 0);
  const LowerElements& points = mesh.attributes.points;
  if (!Groups(points.values).empty())
    for (const Index v : points.vertices) marked[v] = 1;
  mark_lines(mesh.attributes.lines, topology, marked);
  mark_triangles(mesh, topology, marked);
  return vertices_where(marked.size(), [&](Index v) { return marked[v] != 0; });
}

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
