#include "view/measures.h"

#include <cmath>
#include <limits>

#include "energy/reference.h"
#include "energy/triangle_energy.h"
#include "io/mesh_file.h"
#include "io/text_in.h"
#include "mesh/error.h"
#include "mesh/parallel.h"
#include "quality/triangle_metrics.h"

namespace isorelax::view {
namespace {

double parse_edge(const std::string& text) {
  double edge = 0;
  if (!read_number(text, edge))
    throw UsageError("energy reference 'equilateral:" + text + "' has no edge length");
  return edge;
}

ReferenceMesh reference_of(const std::string& reference, std::span<const Vec3> positions,
                           std::span<const Triangle> triangles) {
  constexpr std::string_view kEdge = "equilateral:";
  if (reference == "equilateral") return ReferenceMesh::equilateral_mean_area(positions, triangles);
  if (reference.starts_with(kEdge))
    return ReferenceMesh::equilateral_edge(parse_edge(reference.substr(kEdge.size())),
                                           static_cast<Index>(triangles.size()));
  const TriangleMesh mesh = read_mesh(reference).mesh;
  if (mesh.positions.size() != positions.size())
    throw MeshError(reference + ": has " + std::to_string(mesh.positions.size()) +
                    " vertices, the mesh that it is to be a reference for has " +
                    std::to_string(positions.size()));
  return ReferenceMesh::of_mesh(mesh.positions, triangles);
}

std::vector<double> energies(const EnergyTerms& terms, std::span<const Vec3> positions,
                             std::span<const Triangle> triangles) {
  // Against triangles of its own mean area the energy has no unit.
  std::vector<Vec3> resized;
  if (terms.reference == "equilateral") resized = resized_if_extreme(positions);
  if (!resized.empty()) positions = resized;
  const ReferenceMesh reference = reference_of(terms.reference, positions, triangles);
  std::vector<double> values(triangles.size(), std::numeric_limits<double>::infinity());
  parallel_for_blocks(triangles.size(), 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const std::array<Vec3, 3> x{positions[triangles[t][0]], positions[triangles[t][1]],
                                  positions[triangles[t][2]]};
      if (area_vector(x[0], x[1], x[2]).norm() > 0)
        values[t] = evaluate_energy(x, reference[static_cast<Index>(t)], {terms.shape, terms.area}).energy;
    }
  });
  return values;
}

}  // namespace

std::vector<double> measure(ColorBy color, const EnergyTerms& energy, std::span<const Vec3> positions,
                            std::span<const Triangle> triangles) {
  switch (color) {
    case ColorBy::min_angle:
      return face_metric(FaceMetric::min_angle, positions, triangles);
    case ColorBy::max_angle:
      return face_metric(FaceMetric::max_angle, positions, triangles);
    case ColorBy::area:
      return face_metric(FaceMetric::relative_area, positions, triangles);
    case ColorBy::energy:
      return energies(energy, positions, triangles);
    case ColorBy::none:
    case ColorBy::classes:
      break;
  }
  return {};
}

std::vector<double> change(std::span<const double> now, std::span<const double> then) {
  std::vector<double> values(now.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t t = 0; t < now.size() && t < then.size(); ++t)
    if (std::isfinite(now[t]) && std::isfinite(then[t])) values[t] = now[t] - then[t];
  return values;
}

bool is_worse(const View& view, double value) {
  const double limit = *view.only_worse_than;
  if (view.difference) return view.color == ColorBy::min_angle ? -value > limit : value > limit;
  if (view.color == ColorBy::min_angle) return value < limit;
  if (view.color == ColorBy::area) return value > limit || value * limit < 1;
  return value > limit;
}

}  // namespace isorelax::view
