#include "editor/view_scene.h"

#include <algorithm>
#include <cmath>

#include "editor/session_view.h"
#include "mesh/angle.h"
#include "view/measures.h"

namespace isorelax::editor {
const render::Scene& ViewScene::make(const Shown& shown, const view::View& view) {
  const auto& [document, state, against] = shown;
  const bool other_document = document_ != document;
  const bool other_colors = color_ != view.color || difference_ != view.difference || against_ != against ||
                            energy_ != state->energy;
  if (other_document) triangles_ = render::next_revision();
  if (geometry_ != state->geometry) positions_ = render::next_revision();
  if (geometry_ != state->geometry || other_colors || other_document) values_ = render::next_revision();
  document_ = document;
  geometry_ = state->geometry;
  against_ = against;
  energy_ = state->energy;
  color_ = view.color;
  difference_ = view.difference;

  view::Subject subject;
  subject.positions = state->positions();
  subject.triangles = document_->mesh().triangles;
  subject.values = state->values(coloring_of(color_));
  subject.boundary_marks = document_->boundary_marks;
  subject.faces_inward = document_->faces_inward;
  subject.plane_normal = document_->plane_normal;
  if (against) subject.against = against->positions();
  subject.report = &state->quality();
  subject.positions_revision = positions_;
  subject.triangles_revision = triangles_;
  subject.values_revision = values_;
  if (difference_ && against) {
    change_ = view::change(subject.values, against->values(coloring_of(color_)));
    subject.values = change_;
  }
  const render::Coloring coloring = view::coloring_of(view, subject.values);
  depiction_ = view::depict(view, coloring, subject);
  const bool has_legend = view.color == view::ColorBy::classes || !subject.values.empty();
  if (view.legend && has_legend)
    depiction_.scene.legend = view::legend_of(view, coloring, subject.values, state->quality().inverted);
  return depiction_.scene;
}

namespace {

render::Camera look_along(render::Camera camera, const model::Session& session, const Vec3& normal) {
  if (session.document->plane_normal || normal.norm() == 0) return camera;
  // From outside, wherever the fronts look.
  const Vec3 n = (session.document->faces_inward ? -1 : 1) * normal.normalized();
  const bool y_up = camera.up == render::UpAxis::y;
  camera.azimuth_deg = kDegrees * (y_up ? std::atan2(n.x(), n.z()) : std::atan2(n.x(), -n.y()));
  camera.elevation_deg =
      std::clamp(kDegrees * std::asin(std::clamp(y_up ? n.y() : n.z(), -1.0, 1.0)), -80.0, 80.0);
  return camera;
}

}  // namespace

render::Camera look_at_vertex(const render::Camera& camera, const model::Session& session, Index vertex) {
  const auto x = session.current->positions();
  const auto& triangles = session.document->mesh().triangles;
  render::Camera result = camera;
  result.target = x[vertex];
  double longest = 0;
  Vec3 normal = Vec3::Zero();
  for (const Corner c : session.document->topology.corners_of(vertex)) {
    const Triangle& t = triangles[c / 3];
    normal += area_vector(x[t[0]], x[t[1]], x[t[2]]);
    for (const Index v : t) longest = std::max(longest, (x[v] - x[vertex]).norm());
  }
  if (longest > 0) result.extent = 8 * longest;
  return look_along(result, session, normal);
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
  return look_along(result, session, area_vector(a, b, c));
}

}  // namespace isorelax::editor
