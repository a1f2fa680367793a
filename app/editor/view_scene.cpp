#include "editor/view_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/quantity.h"

namespace isorelax::editor {
namespace {

std::optional<render::Quantity> quantity_of(model::Coloring coloring) {
  switch (coloring) {
    case model::Coloring::none:
      return std::nullopt;
    case model::Coloring::min_angle:
      return render::Quantity::min_angle;
    case model::Coloring::max_angle:
      return render::Quantity::max_angle;
    case model::Coloring::relative_area:
      return render::Quantity::area;
    case model::Coloring::energy:
      return render::Quantity::energy;
  }
  return std::nullopt;
}

render::Coloring coloring_of(const model::Session& session, render::Quantity quantity) {
  const model::ViewSettings& view = session.view;
  const model::ValueRange range = session.color_range();
  // The quantity's own scale over everything seen so far: its rules need only the extremes.
  const double ends[2] = {range.low, range.high};
  render::Coloring coloring = render::default_coloring(quantity, ends);
  const bool own_range = view.range_mode == model::RangeMode::run;
  const bool angle = quantity == render::Quantity::min_angle || quantity == render::Quantity::max_angle;
  if (view.range_mode == model::RangeMode::typed || (!own_range && angle))
    coloring.range = {range.low, range.high};
  if (coloring.range.low <= 0) coloring.scale = render::ValueScale::linear;
  if (!view.color_map.empty()) {
    coloring.map = render::parse_color_map(view.color_map);
  }
  if (view.reversed)
    coloring.direction = coloring.direction == render::MapDirection::forward ? render::MapDirection::reversed
                                                                             : render::MapDirection::forward;
  return coloring;
}

}  // namespace

render::Scene ViewScene::make(const model::Session& session, float pixels_per_point) {
  const model::MeshState& state = *session.current;
  const bool other_document = document_ != session.document;
  if (other_document) triangles_ = render::next_revision();
  if (geometry_ != state.geometry) positions_ = render::next_revision();
  if (geometry_ != state.geometry || energy_ != state.energy || coloring_ != session.view.coloring ||
      other_document)
    values_ = render::next_revision();
  document_ = session.document;
  geometry_ = state.geometry;
  energy_ = state.energy;
  coloring_ = session.view.coloring;

  render::Scene scene;
  scene.pixels_per_point = pixels_per_point;
  render::SceneMesh& mesh = scene.meshes.emplace_back();
  mesh.positions = state.positions();
  mesh.triangles = document_->mesh().triangles;
  mesh.edge_marks = document_->boundary_marks;
  mesh.face_values = state.values(coloring_);
  mesh.positions_revision = positions_;
  mesh.triangles_revision = triangles_;
  mesh.values_revision = values_;
  mesh.shading =
      session.view.shading == model::Shading::flat ? render::Shading::flat : render::Shading::smooth;
  mesh.wire.shown = session.view.wire;
  mesh.marked_edges.color = {205, 211, 222};
  mesh.marked_edges.width = 1.6;
  if (const auto quantity = quantity_of(coloring_); quantity && !mesh.face_values.empty()) {
    mesh.coloring = coloring_of(session, *quantity);
    if (session.view.legend) scene.legend = render::make_legend(*quantity, mesh.coloring, mesh.face_values);
  }
  if (session.selected_triangle) {
    const Index t = *session.selected_triangle;
    mesh.highlighted_faces = {t};
    const Triangle& corners = mesh.triangles[t];
    render::Marker marker;
    marker.position =
        (mesh.positions[corners[0]] + mesh.positions[corners[1]] + mesh.positions[corners[2]]) / 3;
    scene.markers.push_back(marker);
  }
  return scene;
}

render::Camera look_at_triangle(const render::Camera& camera, const model::Session& session, Index triangle) {
  const auto x = session.current->positions();
  const Triangle& t = session.document->mesh().triangles[triangle];
  const Vec3& a = x[t[0]];
  const Vec3& b = x[t[1]];
  const Vec3& c = x[t[2]];
  render::Camera result = camera;
  result.target = (a + b + c) / 3;
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  if (longest > 0) result.extent = 9 * longest;
  const Vec3 normal = area_vector(a, b, c);
  if (session.document->plane_normal || normal.norm() == 0) return result;
  const Vec3 n = normal.normalized();
  constexpr double kDegrees = 180 / std::numbers::pi;
  const bool y_up = camera.up == render::UpAxis::y;
  result.azimuth_deg = kDegrees * (y_up ? std::atan2(n.x(), n.z()) : std::atan2(n.x(), -n.y()));
  result.elevation_deg =
      std::clamp(kDegrees * std::asin(std::clamp(y_up ? n.y() : n.z(), -1.0, 1.0)), -80.0, 80.0);
  return result;
}

}  // namespace isorelax::editor
