#include "energy/reference.h"

#include <cmath>
#include <utility>

#include "mesh/degenerate.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

double mean_doubled_area(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += area_vector(positions[t[0]], positions[t[1]], positions[t[2]]).norm();
  const double mean = sum / static_cast<double>(triangles.size());
  if (!(mean > 0) || !std::isfinite(mean)) throw MeshError("the mesh has no area to take a reference from");
  return mean;
}

}  // namespace

ReferenceTriangle reference_from_points(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double d1 = area_vector(a, b, c).norm();
  return {{(b - a).dot(c - a) / d1, (c - b).dot(a - b) / d1, (a - c).dot(b - c) / d1}, d1};
}

ReferenceMesh ReferenceMesh::equilateral_mean_area(std::span<const Vec3> positions,
                                                   std::span<const Triangle> triangles) {
  ReferenceMesh reference;
  reference.count_ = static_cast<Index>(triangles.size());
  reference.d1_ = {mean_doubled_area(positions, triangles)};
  return reference;
}

ReferenceMesh ReferenceMesh::equilateral_edge(double edge_length, Index triangle_count) {
  if (!(edge_length > 0) || !std::isfinite(edge_length)) {
    throw UsageError("the edge length of the reference must be positive and finite");
  }
  ReferenceMesh reference;
  reference.count_ = triangle_count;
  reference.d1_ = {0.5 * std::sqrt(3.0) * edge_length * edge_length};
  return reference;
}

ReferenceMesh ReferenceMesh::equilateral_areas(std::vector<double> doubled_areas) {
  ReferenceMesh reference;
  reference.count_ = static_cast<Index>(doubled_areas.size());
  reference.d1_ = std::move(doubled_areas);
  return reference;
}

ReferenceMesh ReferenceMesh::of_mesh(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  ReferenceMesh reference;
  reference.count_ = static_cast<Index>(triangles.size());
  reference.d1_.reserve(triangles.size());
  reference.cot_.reserve(triangles.size());
  const double mean = mean_doubled_area(positions, triangles);
  for (Index t = 0; t < reference.count_; ++t) {
    const Triangle& v = triangles[t];
    ReferenceTriangle own = reference_from_points(positions[v[0]], positions[v[1]], positions[v[2]]);
    if (has_no_area(positions[v[0]], positions[v[1]], positions[v[2]]) ||
        !std::isfinite(own.cot[0] + own.cot[1] + own.cot[2])) {
      own = equilateral_reference(mean);
      reference.replaced_.push_back(t);
    }
    reference.d1_.push_back(own.d1);
    reference.cot_.push_back(own.cot);
  }
  return reference;
}

ReferenceMesh ReferenceMesh::in_order(std::span<const Index> order) const {
  ReferenceMesh ordered;
  ordered.count_ = count_;
  if (d1_.size() == 1) ordered.d1_ = d1_;
  for (const Index t : order) {
    if (d1_.size() > 1) ordered.d1_.push_back(d1_[t]);
    if (!cot_.empty()) ordered.cot_.push_back(cot_[t]);
  }
  return ordered;
}

}  // namespace isorelax
