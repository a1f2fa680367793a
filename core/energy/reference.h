#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// The triangle that one triangle of the mesh ought to look like: the cotangents of its angles and twice its
/// area.
struct ReferenceTriangle {
  std::array<double, 3> cot;  ///< cot(alpha_k) at corner k
  double d1;                  ///< twice the area, length units squared
};

/// cot(60 deg) = 1 / sqrt(3).
inline constexpr double kEquilateralCot = 0.57735026918962576451;

/// Equilateral triangle with doubled area d1 > 0.
constexpr ReferenceTriangle equilateral_reference(double d1) {
  return {{kEquilateralCot, kEquilateralCot, kEquilateralCot}, d1};
}

/// Reference triangle with the angles and the area of (a, b, c). The cotangents are infinite where d1 is 0.
ReferenceTriangle reference_from_points(const Vec3& a, const Vec3& b, const Vec3& c);

/// One reference triangle for each triangle of a mesh (the paper's virtual mesh M_1; method Sec. 8). The
/// triangles need not fit together. Equilateral references store no cotangents: they are the fast path.
class ReferenceMesh {
 public:
  /// All equilateral with the mean area of the given triangles. Throws MeshError if there is no area at all.
  static ReferenceMesh equilateral_mean_area(std::span<const Vec3> positions,
                                             std::span<const Triangle> triangles);
  /// All equilateral with this edge length. Throws UsageError unless it is positive and finite.
  static ReferenceMesh equilateral_edge(double edge_length, Index triangle_count);
  /// All equilateral, each with its own doubled area > 0.
  static ReferenceMesh equilateral_areas(std::vector<double> doubled_areas);
  /// Angles and areas of the given triangles themselves. A triangle without area (has_no_area) gets the
  /// equilateral one of mean area; its number is listed in `replaced()`.
  static ReferenceMesh of_mesh(std::span<const Vec3> positions, std::span<const Triangle> triangles);

  /// The same with the triangles in another order: `order[0]` first.
  [[nodiscard]] ReferenceMesh in_order(std::span<const Index> order) const;

  [[nodiscard]] Index triangle_count() const { return count_; }
  [[nodiscard]] bool is_equilateral() const { return cot_.empty(); }
  /// One equilateral reference serves all triangles.
  [[nodiscard]] bool is_uniform() const { return d1_.size() == 1 && is_equilateral(); }
  /// Twice the area of triangle t's reference.
  [[nodiscard]] double d1(Index t) const { return d1_.size() == 1 ? d1_[0] : d1_[t]; }
  [[nodiscard]] ReferenceTriangle operator[](Index t) const {
    return is_equilateral() ? equilateral_reference(d1(t)) : ReferenceTriangle{cot_[t], d1(t)};
  }
  /// Triangles for which a degenerate reference was replaced; none in another order.
  [[nodiscard]] std::span<const Index> replaced() const { return replaced_; }

 private:
  ReferenceMesh() = default;
  Index count_ = 0;
  std::vector<double> d1_;  // one for all, or one for each
  std::vector<std::array<double, 3>> cot_;
  std::vector<Index> replaced_;
};

}  // namespace isorelax
