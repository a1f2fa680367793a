#include "mesh/repair.h"

#include <algorithm>
#include <utility>

#include "mesh/orientation.h"
#include "mesh/validation.h"

namespace isorelax {
namespace {

/// Drops the elements at ascending `ids` from an array with `width` entries per element.
template <class T>
void drop(std::vector<T>& values, std::size_t width, const std::vector<Index>& ids) {
  if (values.empty()) return;
  std::size_t to = 0;
  auto next_dropped = ids.begin();
  for (std::size_t element = 0; element * width < values.size(); ++element) {
    if (next_dropped != ids.end() && *next_dropped == element) {
      ++next_dropped;
      continue;
    }
    for (std::size_t k = 0; k < width; ++k) values[to++] = std::move(values[element * width + k]);
  }
  values.resize(to);
}

void remove_triangles(TriangleMesh& mesh, const std::vector<Index>& ids) {
  drop(mesh.triangles, 1, ids);
  for (Attribute& attribute : mesh.attributes.face) drop(attribute.values, attribute.width, ids);
  for (CornerAttribute& attribute : mesh.attributes.corner) drop(attribute.indices, 3, ids);
  for (FaceLabels& labels : mesh.attributes.face_labels) drop(labels.face_label, 1, ids);
}

void turn_over(TriangleMesh& mesh, Index t) {
  std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  for (CornerAttribute& attribute : mesh.attributes.corner) {
    if (!attribute.indices.empty()) std::swap(attribute.indices[3 * t + 1], attribute.indices[3 * t + 2]);
  }
  for (Attribute& attribute : mesh.attributes.face) {
    if (attribute.name != "normal" || attribute.values.empty()) continue;
    for (std::size_t k = 0; k < attribute.width; ++k) attribute.values[attribute.width * t + k] *= -1;
  }
}

}  // namespace

std::vector<Index> remove_degenerate_triangles(TriangleMesh& mesh) {
  std::vector<Index> ids;
  for (const DegenerateFinding& finding : find_degenerate_triangles(mesh)) ids.push_back(finding.triangle);
  remove_triangles(mesh, ids);
  return ids;
}

std::vector<Index> remove_duplicate_triangles(TriangleMesh& mesh) {
  std::vector<Index> ids;
  for (const DuplicateFinding& finding : find_duplicate_triangles(mesh)) ids.push_back(finding.triangle);
  remove_triangles(mesh, ids);
  return ids;
}

std::vector<Index> remove_isolated_vertices(TriangleMesh& mesh) {
  std::vector<Index> new_id(mesh.vertex_count(), kNone);
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t) new_id[v] = 0;
  }
  std::vector<Index> ids;
  Index kept = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (new_id[v] == kNone) {
      ids.push_back(v);
    } else {
      new_id[v] = kept++;
    }
  }
  for (Triangle& t : mesh.triangles) {
    for (Index& v : t) v = new_id[v];
  }
  drop(mesh.positions, 1, ids);
  for (Attribute& attribute : mesh.attributes.vertex) drop(attribute.values, attribute.width, ids);
  return ids;
}

std::vector<Index> orient_consistently(TriangleMesh& mesh) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const Orientation orientation = find_orientation(mesh.triangles, topology);
  std::vector<Index> ids;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (!orientation.turn[t] || !orientation.orientable[orientation.component[t]]) continue;
    turn_over(mesh, t);
    ids.push_back(t);
  }
  return ids;
}

}  // namespace isorelax
