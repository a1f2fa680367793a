#include "cli/json.h"

#include <nlohmann/json.hpp>

#include "quality/triangle_metrics.h"

namespace isorelax::cli {
namespace {

Json edges_to_json(const std::vector<EdgeFinding>& edges) {
  Json list = Json::array();
  for (const EdgeFinding& edge : edges) {
    Json item;
    item["vertices"] = {edge.a, edge.b};
    item["triangles"] = edge.triangles;
    list.push_back(std::move(item));
  }
  return list;
}

Json optional_to_json(const std::optional<long>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json components_to_json(const std::vector<ComponentFinding>& components) {
  Json list = Json::array();
  for (const ComponentFinding& component : components) {
    Json item;
    item["triangles"] = component.triangles;
    item["vertices"] = component.vertices;
    item["boundary_loops"] = component.boundary_loops;
    item["euler_characteristic"] = component.euler_characteristic;
    item["genus"] = optional_to_json(component.genus);
    item["orientable"] = component.orientable;
    list.push_back(std::move(item));
  }
  return list;
}

Json loops_to_json(const std::vector<BoundaryLoop>& loops) {
  Json list = Json::array();
  for (const BoundaryLoop& loop : loops) {
    Json item;
    item["edges"] = loop.vertices.size() - (loop.closed ? 0 : 1);
    item["closed"] = loop.closed;
    item["vertices"] = loop.vertices;
    list.push_back(std::move(item));
  }
  return list;
}

}  // namespace

Json to_json(const QualityReport& report) {
  Json object;
  object["vertices"] = report.vertices;
  object["triangles"] = report.triangles;
  object["min_angle_deg"] = report.min_angle_deg;
  object["max_angle_deg"] = report.max_angle_deg;
  object["mean_min_angle_deg"] = report.mean_min_angle_deg;
  object["below_20_deg"] = report.below_20_deg;
  object["below_30_deg"] = report.below_30_deg;
  object["above_120_deg"] = report.above_120_deg;
  object["area_max_over_min"] = report.area_max_over_min;
  object["area_std_over_mean"] = report.area_std_over_mean;
  object["shape_mean"] = report.shape_mean;
  object["shape_max"] = report.shape_max;
  object["radius_ratio_min"] = report.radius_ratio_min;
  object["scaled_jacobian_min"] = report.scaled_jacobian_min;
  object["aspect_ratio_max"] = report.aspect_ratio_max;
  object["inverted"] = report.inverted;
  object["degenerate"] = report.degenerate;
  return object;
}

Json to_json(const ValidationReport& report) {
  Json object;
  object["vertices"] = report.vertices;
  object["triangles"] = report.triangles;
  object["edges"] = report.edges;
  object["components"] = components_to_json(report.components);
  object["boundary_loops"] = loops_to_json(report.boundary);
  object["euler_characteristic"] = report.euler_characteristic;
  object["genus"] = optional_to_json(report.genus);
  object["closed"] = report.closed;
  object["manifold"] = report.manifold();
  object["oriented"] = report.oriented;
  object["orientable"] = report.orientable;
  object["non_manifold_edges"] = edges_to_json(report.non_manifold_edges);
  object["non_manifold_vertices"] = report.non_manifold_vertices;
  object["inconsistent_edges"] = edges_to_json(report.inconsistent_edges);
  Json degenerate = Json::array();
  for (const DegenerateFinding& finding : report.degenerate) {
    Json item;
    item["triangle"] = finding.triangle;
    item["reason"] = finding.reason == DegenerateReason::zero_area ? "zero area" : "repeated vertex";
    degenerate.push_back(std::move(item));
  }
  object["degenerate_triangles"] = std::move(degenerate);
  Json duplicates = Json::array();
  for (const DuplicateFinding& finding : report.duplicates) {
    Json item;
    item["triangle"] = finding.triangle;
    item["same_as"] = finding.first;
    duplicates.push_back(std::move(item));
  }
  object["duplicate_triangles"] = std::move(duplicates);
  object["isolated_vertices"] = report.isolated_vertices;
  return object;
}

Json triangle_to_json(const TriangleMesh& mesh, Index triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const Vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
  const TriangleMetrics m = measure_triangle(mesh.positions, mesh.triangles[triangle]);
  Json object;
  object["triangle"] = triangle;
  object["vertices"] = {a, b, c};
  object["min_angle_deg"] = m.min_angle_deg;
  object["max_angle_deg"] = m.max_angle_deg;
  object["shape"] = m.shape;
  object["centroid"] = {middle.x(), middle.y(), middle.z()};
  return object;
}

std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace isorelax::cli
