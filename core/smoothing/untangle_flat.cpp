#include "smoothing/untangle_flat.h"

#include <cmath>
#include <map>

#include "mesh/disjoint_sets.h"
#include "quality/inverted.h"
#include "smoothing/untangle.h"

namespace isorelax {
namespace {

/// Sine of the angle between two planes up to which they are one: 0.02 degrees.
constexpr double kSamePlane = 3.5e-4;
/// Fewer triangles may be a facet of a curved face.
constexpr std::size_t kLeastInFace = 12;
/// Of a triangle with less area than this share of its longest edge squared, the plane is made of rounding.
constexpr double kNoPlane = 1e-9;

/// A flat face by itself, its vertices numbered anew.
struct FlatFace {
  std::vector<Index> vertices;  ///< of the surface
  std::vector<Triangle> triangles;
};

/// Unit normals; zero where a triangle has none.
std::vector<Vec3> unit_normals(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  std::vector<Vec3> normals;
  normals.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const Vec3 area = area_vector(x[a], x[b], x[c]);
    const double longest2 =
        std::max({(x[b] - x[a]).squaredNorm(), (x[c] - x[b]).squaredNorm(), (x[a] - x[c]).squaredNorm()});
    normals.push_back(area.norm() > kNoPlane * longest2 ? area.normalized() : Vec3::Zero());
  }
  return normals;
}

/// A triangle without area lies in the plane of any triangle beside it: it goes with the first.
std::map<Index, FlatFace> flat_faces(std::span<const Triangle> triangles, const Topology& topology,
                                     std::span<const Vec3> normals) {
  DisjointSets sets(triangles.size());
  std::vector<std::uint8_t> is_placed(triangles.size(), 0);
  for (Corner c = 0; c < 3 * triangles.size(); ++c) {
    const Corner other = topology.opposite(c);
    if (other == kNone) continue;
    const Index t = c / 3, beside = other / 3;
    if (normals[beside].isZero(0)) continue;
    if (normals[t].isZero(0) ? is_placed[t] != 0 : normals[t].cross(normals[beside]).norm() > kSamePlane)
      continue;
    is_placed[t] = 1;
    sets.join(t, beside);
  }
  std::map<Index, FlatFace> faces;
  for (Index t = 0; t < triangles.size(); ++t) faces[sets.find(t)].triangles.push_back(triangles[t]);
  std::erase_if(faces, [](const auto& face) { return face.second.triangles.size() < kLeastInFace; });
  return faces;
}

}  // namespace

FlatUntangling untangle_flat_faces(std::span<Vec3> positions, std::span<const Triangle> triangles,
                                   const Topology& topology, std::span<const std::uint8_t> movable,
                                   unsigned threads) {
  FlatUntangling result;
  result.touched.assign(positions.size(), 0);
  std::vector<Index> number(positions.size(), kNone);
  std::vector<Index> count(positions.size(), 0);  // of a vertex' triangles in the face
  for (auto& [name, face] : flat_faces(triangles, topology, unit_normals(positions, triangles))) {
    for (Triangle& t : face.triangles) {
      for (Index& v : t) {
        ++count[v];
        if (number[v] == kNone) {
          number[v] = static_cast<Index>(face.vertices.size());
          face.vertices.push_back(v);
        }
        v = number[v];
      }
    }
    std::vector<Vec3> x;
    std::vector<std::uint8_t> inside;
    for (const Index v : face.vertices) {
      x.push_back(positions[v]);
      inside.push_back(movable[v] != 0 && count[v] == topology.corners_of(v).size() ? 1 : 0);
    }
    const Topology own(face.triangles, static_cast<Index>(x.size()));
    // Edges that hardly turn may lead around a curved face all the same.
    const bool is_flat = plane_normal(x, face.triangles, own, threads).has_value();
    const UntangleResult untangled =
        is_flat ? untangle(x, face.triangles, own, inside, threads) : UntangleResult{};
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Index v = face.vertices[i];
      number[v] = kNone;
      count[v] = 0;
      if (untangled.before > 0 && untangled.after == 0) {
        result.touched[v] = 1;
        positions[v] = x[i];
        result.moved = true;
      }
    }
  }
  return result;
}

}  // namespace isorelax
