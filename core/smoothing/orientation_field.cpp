#include "smoothing/orientation_field.h"

#include <algorithm>

#include "quality/inverted.h"
#include "smoothing/harmonic.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

constexpr int kSuspectRings = 2;
constexpr double kFoldDeg = 120;

}  // namespace

std::vector<Index> doubtful_triangles(const std::vector<Index>& inverted, std::span<const Vec3> x,
                                      std::span<const Triangle> triangles, const Topology& topology) {
  std::vector<Vec3> normals(x.size(), Vec3::Zero());
  std::vector<std::uint8_t> near(x.size(), 0);
  const auto area = [&](const Triangle& t) { return area_vector(x[t[0]], x[t[1]], x[t[2]]); };
  for (const Triangle& t : triangles)
    for (const Index v : t) normals[v] += area(t);
  for (const Index t : inverted)
    for (const Index v : triangles[t]) near[v] = 1;
  for (int ring = 0; ring < kSuspectRings; ++ring) {
    const std::vector<std::uint8_t> last = near;
    for (const Triangle& t : triangles)
      if (last[t[0]] + last[t[1]] + last[t[2]] > 0)
        for (const Index v : t) near[v] = 1;
  }
  const auto is_folded = [&](Index t) {
    double turn = 0;
    for (unsigned k = 0; k < 3; ++k)
      turn = std::max(turn, dihedral_turn_deg(x, triangles, topology, 3 * t + k));
    return turn > kFoldDeg;
  };
  std::vector<Index> all = inverted;
  for (Index t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    const auto opposed = std::count_if(corners.begin(), corners.end(),
                                       [&](Index v) { return area(corners).dot(normals[v]) < 0; });
    if (opposed == 0) continue;
    const bool close = near[corners[0]] + near[corners[1]] + near[corners[2]] == 3;
    if (close || opposed >= 2 || is_folded(t)) all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

OrientationField find_orientation(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, std::span<const Index> inverted,
                                  unsigned threads) {
  OrientationField field;
  if (const auto normal = plane_normal(positions, triangles, topology, threads)) {
    field.planar = true;
    field.normals.assign(triangles.size(), *normal);
    return field;
  }
  std::vector<std::uint8_t> doubtful(positions.size(), 0);
  for (const Index t : inverted)
    for (const Index v : triangles[t]) doubtful[v] = 1;
  field.vertex_normals.assign(positions.size(), Vec3::Zero());
  for (const Triangle& t : triangles) {
    const Vec3 area = area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
    for (const Index v : t)
      if (doubtful[v] == 0) field.vertex_normals[v] += area;
  }
  std::vector<Index> free;
  for (Index v = 0; v < positions.size(); ++v) {
    field.vertex_normals[v] = field.vertex_normals[v].stableNormalized();
    if (doubtful[v] != 0) free.push_back(v);
  }
  place_harmonically(field.vertex_normals, triangles, topology, free);
  for (const Index v : free) field.vertex_normals[v] = field.vertex_normals[v].stableNormalized();

  field.normals.resize(triangles.size());
  for (Index t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const bool sound = doubtful[a] + doubtful[b] + doubtful[c] == 0;
    const Vec3 normal =
        sound ? area_vector(positions[a], positions[b], positions[c])
              : Vec3(field.vertex_normals[a] + field.vertex_normals[b] + field.vertex_normals[c]);
    field.normals[t] = normal.stableNormalized();
  }
  return field;
}

}  // namespace isorelax
