#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A point of a triangulated surface and how far it is from the point that was asked about.
struct SurfacePoint {
  Index triangle = kNone;
  Vec3 barycentric = Vec3::Zero();  ///< weights of the triangle's corners: none negative, sum 1
  Vec3 point = Vec3::Zero();
  double distance = 0;
};

/// Point of triangle (a, b, c) closest to `p`; exact for every region of the triangle (face, edges, corners),
/// for triangles without area (then of its edges) and those that are one point. `triangle` stays kNone.
[[nodiscard]] SurfacePoint closest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                                     const Vec3& c);

/// The same of a mesh's triangle, which the result names.
[[nodiscard]] SurfacePoint closest_point_of_triangle(const Vec3& p, std::span<const Vec3> positions,
                                                     std::span<const Triangle> triangles, Index triangle);

/// A triangle (a, b, c) with what the barycentric coordinates of a foot are found from.
struct PreparedTriangle {
  PreparedTriangle(const Vec3& at_a, const Vec3& at_b, const Vec3& at_c);

  /// Of the foot of p in the plane.
  [[nodiscard]] Vec3 barycentric(const Vec3& p) const {
    const Vec3 ap = p - a;
    const double v = ap.dot(gradient_b), w = ap.dot(gradient_c);
    return {1 - v - w, v, w};
  }

  [[nodiscard]] Eigen::AlignedBox3d box() const {
    return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
  }

  Vec3 a, b, c;
  Vec3 gradient_b, gradient_c;  ///< of the coordinates of b and c in its plane; unused where it has no area
  bool has_area;
};

/// Finds the closest point of a set of triangles: a tree of boxes, each split at the median of the
/// triangles' centres, so that its depth is bounded whatever the mesh. Any triangles are accepted, flawed
/// ones too. Building is O(T log T), a query allocates nothing. Reading from several threads at once is safe.
class ClosestPointIndex {
 public:
  ClosestPointIndex() = default;
  /// Copies what it needs. Precondition: indices below positions.size(), coordinates finite.
  ClosestPointIndex(std::span<const Vec3> positions, std::span<const Triangle> triangles);

  /// The closest point; of triangles at exactly the same distance the one with the smallest number. `hint` is
  /// a triangle known to be near (the last answer, say): it makes the query cheaper and never changes the
  /// result. Without triangles, or for a point that is not a number: triangle kNone at infinite distance.
  [[nodiscard]] SurfacePoint closest(const Vec3& point, Index hint = kNone) const;
  /// closest_point_of_triangle of one of the triangles, to the same bits at less cost.
  [[nodiscard]] SurfacePoint closest_of(Index triangle, const Vec3& point) const;
  [[nodiscard]] const PreparedTriangle& prepared(Index triangle) const {
    return records_[record_of_[triangle]].corners;
  }
  /// Calls visit(triangle) for all whose own boxes meet this one, in no order.
  template <typename Visit>
  void for_each_in(const Eigen::AlignedBox3d& box, const Visit& visit) const;

 private:
  /// The boxes of both children side by side. A child with a count is a leaf: `count` records from `child`.
  struct Node {
    Eigen::Array<double, 3, 2, Eigen::RowMajor> low, high;
    std::array<std::uint32_t, 2> child;
    std::array<std::uint32_t, 2> count;
    std::uint32_t parent;  ///< its own number at the root
  };
  struct Record {
    PreparedTriangle corners;
    Index triangle;
    std::uint32_t node;  ///< that has the leaf for a child; unused where there is none
  };
  /// What the build sorts: a triangle's centre in units of the whole, where single precision is enough.
  struct Centre {
    std::array<float, 3> at;
    Index triangle;
  };
  struct Search;
  class Builder;

  /// Median splits halve the count: 2^32 triangles are 32 levels.
  static constexpr std::size_t kMaxDepth = 40;

  std::vector<Node> nodes_;      ///< the first is the root; empty where all triangles fit into one leaf
  std::vector<Record> records_;  ///< in the order of the leaves
  std::vector<std::uint32_t> record_of_;
};

template <typename Visit>
void ClosestPointIndex::for_each_in(const Eigen::AlignedBox3d& box, const Visit& visit) const {
  const auto look_at = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (box.intersects(records_[i].corners.box())) visit(records_[i].triangle);
  };
  if (nodes_.empty()) return look_at(0, records_.size());
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    for (unsigned side = 0; side < 2; ++side) {
      if ((node.low.col(side) > box.max().array()).any() || (node.high.col(side) < box.min().array()).any())
        continue;
      if (node.count[side] > 0) {
        look_at(node.child[side], node.child[side] + node.count[side]);
      } else {
        stack[depth++] = node.child[side];
      }
    }
  }
}

}  // namespace isorelax
