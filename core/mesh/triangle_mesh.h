#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/attributes.h"

namespace isorelax {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Number of a vertex or a triangle, from 0, in file order.
using Index = std::uint32_t;

/// "No such element": the neighbour across a boundary edge, a missing attribute index.
inline constexpr Index kNone = 0xffffffffU;

/// The three vertices of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

/// A corner is 3 * triangle + k, k = 0, 1, 2.
using Corner = std::uint32_t;

constexpr unsigned next(unsigned k) {
  return k == 2 ? 0 : k + 1;
}
constexpr unsigned previous(unsigned k) {
  return k == 0 ? 2 : k - 1;
}

/// Triangles in space and what their file said about them beyond geometry.
///
/// Invariant kept by every reader and generator: all indices are below positions.size() and all positions are
/// finite. Nothing else is promised: a triangle may repeat a vertex, edges may have three triangles;
/// `validate` tells. Vertex order is the file's.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  MeshAttributes attributes;

  [[nodiscard]] Index vertex_count() const { return static_cast<Index>(positions.size()); }
  [[nodiscard]] Index triangle_count() const { return static_cast<Index>(triangles.size()); }
};

/// Whether two meshes can be compared vertex by vertex.
inline bool same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions.size() == b.positions.size() && a.triangles == b.triangles;
}

/// Normal of triangle (a, b, c) with the length of twice its area.
inline Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

}  // namespace isorelax
