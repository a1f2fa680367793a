#include "mesh/validation.h"

#include <algorithm>
#include <numeric>

#include "mesh/degenerate.h"
#include "mesh/orientation.h"
#include "mesh/topology.h"

namespace isorelax {
namespace {

bool repeats_a_vertex(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

EdgeFinding finding_at(const TriangleMesh& mesh, std::span<const Corner> corners) {
  const Triangle& t = mesh.triangles[corners[0] / 3];
  const auto [a, b] = std::minmax(t[next(corners[0] % 3)], t[previous(corners[0] % 3)]);
  EdgeFinding finding{a, b, {}};
  for (const Corner c : corners) finding.triangles.push_back(c / 3);
  return finding;
}

std::vector<EdgeFinding> find_inconsistent_edges(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<EdgeFinding> found;
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Corner beyond = topology.opposite(c);
    if (beyond == kNone || beyond < c || consistent_across(mesh.triangles, topology, c)) continue;
    const Corner both[2] = {c, beyond};
    found.push_back(finding_at(mesh, both));
  }
  return found;
}

struct ComponentTally {
  long corners_of_edges = 0;  // sides on edges with two triangles: two per edge
  long boundary_edges = 0;
  long crowded_edges = 0;
  bool manifold = true;
};

std::vector<ComponentFinding> find_components(const TriangleMesh& mesh, const Topology& topology,
                                              const Orientation& orientation,
                                              const std::vector<BoundaryLoop>& loops,
                                              const std::vector<EdgeFinding>& crowded) {
  std::vector<ComponentFinding> components(orientation.component_count);
  std::vector<ComponentTally> tallies(orientation.component_count);
  for (Corner c = 0; c < 3 * mesh.triangles.size(); ++c) {
    ComponentTally& tally = tallies[orientation.component[c / 3]];
    tally.corners_of_edges += topology.opposite(c) != kNone ? 1 : 0;
    tally.boundary_edges += topology.is_boundary_edge(c) ? 1 : 0;
  }
  for (const Index id : orientation.component) ++components[id].triangles;
  for (const BoundaryLoop& loop : loops) ++components[orientation.component[loop.triangle]].boundary_loops;
  for (const EdgeFinding& edge : crowded) ++tallies[orientation.component[edge.triangles[0]]].crowded_edges;
  std::vector<Index> around;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    around.clear();
    for (const Corner c : topology.corners_of(v)) around.push_back(orientation.component[c / 3]);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const Index id : around) {
      ++components[id].vertices;
      // Where components only touch in a vertex each of them may still be sound by itself, but not told
      // apart.
      if ((topology.flags(v) & (kNonManifoldVertex | kRepeatedVertex)) != 0) tallies[id].manifold = false;
    }
  }
  for (std::size_t id = 0; id < components.size(); ++id) {
    ComponentFinding& component = components[id];
    const ComponentTally& tally = tallies[id];
    const long edges = tally.corners_of_edges / 2 + tally.boundary_edges + tally.crowded_edges;
    component.orientable = orientation.orientable[id];
    component.euler_characteristic =
        static_cast<long>(component.vertices) - edges + static_cast<long>(component.triangles);
    if (tally.manifold && component.orientable) {
      component.genus =
          (2 - component.euler_characteristic - static_cast<long>(component.boundary_loops)) / 2;
    }
  }
  return components;
}

std::size_t count_edges(const Topology& topology, std::size_t crowded) {
  std::size_t paired = 0;
  std::size_t single = 0;
  for (Corner c = 0; c < 3 * topology.triangle_count(); ++c) {
    paired += topology.opposite(c) != kNone ? 1 : 0;
    single += topology.is_boundary_edge(c) ? 1 : 0;
  }
  return paired / 2 + single + crowded;
}

}  // namespace

std::vector<DegenerateFinding> find_degenerate_triangles(const TriangleMesh& mesh) {
  std::vector<DegenerateFinding> found;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[t];
    if (repeats_a_vertex(v)) {
      found.push_back({t, DegenerateReason::repeated_vertex});
    } else if (has_no_area(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]])) {
      found.push_back({t, DegenerateReason::zero_area});
    }
  }
  return found;
}

std::vector<DuplicateFinding> find_duplicate_triangles(const TriangleMesh& mesh) {
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::vector<Index> order(sorted.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b; });
  std::vector<DuplicateFinding> found;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i + 1;
    for (; j < order.size() && sorted[order[j]] == sorted[order[i]]; ++j)
      found.push_back({order[j], order[i]});
    i = j;
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  return found;
}

ValidationReport validate(const TriangleMesh& mesh) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const Orientation orientation = find_orientation(mesh.triangles, topology);
  ValidationReport report;
  report.vertices = mesh.positions.size();
  report.triangles = mesh.triangles.size();
  for (const auto& corners : crowded_edges(mesh.triangles, topology)) {
    report.non_manifold_edges.push_back(finding_at(mesh, corners));
  }
  report.inconsistent_edges = find_inconsistent_edges(mesh, topology);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if ((topology.flags(v) & kNonManifoldVertex) != 0) report.non_manifold_vertices.push_back(v);
    if ((topology.flags(v) & kIsolatedVertex) != 0) report.isolated_vertices.push_back(v);
  }
  report.degenerate = find_degenerate_triangles(mesh);
  report.duplicates = find_duplicate_triangles(mesh);
  report.boundary = boundary_loops(mesh.triangles, topology);
  report.components =
      find_components(mesh, topology, orientation, report.boundary, report.non_manifold_edges);
  report.edges = count_edges(topology, report.non_manifold_edges.size());
  report.euler_characteristic = static_cast<long>(report.vertices - report.isolated_vertices.size()) -
                                static_cast<long>(report.edges) + static_cast<long>(report.triangles);
  report.closed = !mesh.triangles.empty() && report.boundary.empty();
  report.oriented = report.inconsistent_edges.empty();
  report.orientable = std::all_of(report.components.begin(), report.components.end(),
                                  [](const ComponentFinding& c) { return c.orientable; });
  if (!report.components.empty()) report.genus = 0;
  for (const ComponentFinding& component : report.components) {
    report.genus =
        report.genus && component.genus ? std::optional(*report.genus + *component.genus) : std::nullopt;
  }
  return report;
}

}  // namespace isorelax
