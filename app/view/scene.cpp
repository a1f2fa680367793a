#include "view/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mesh/topology.h"
#include "surface/vertex_class.h"
#include "view/measures.h"

namespace isorelax::view {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), static_cast<std::size_t>(std::max(0, length))};
}

std::string grouped(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, " ");
  return text;
}

/// Leaves only the triangles that are worse than the view's limit.
void keep_worse(const View& view, Depiction& made) {
  render::SceneMesh& mesh = made.scene.meshes.front();
  std::vector<std::uint8_t> marks;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_worse(view, mesh.face_values[t])) continue;
    made.triangles.push_back(mesh.triangles[t]);
    made.values.push_back(mesh.face_values[t]);
    if (!mesh.edge_marks.empty()) marks.push_back(mesh.edge_marks[t]);
  }
  made.scene.notes.push_back(grouped(made.triangles.size()) + " of " + grouped(mesh.triangles.size()) +
                             " triangles shown");
  // Between what is left one sees backs everywhere: that is no fault.
  mesh.backs_marked = false;
  mesh.triangles = made.triangles;
  mesh.face_values = made.values;
  made.marks = std::move(marks);
  mesh.edge_marks = made.marks;
  mesh.highlighted_faces.clear();  // its number was that among all
  // Other triangles whenever the values or the limit change.
  mesh.triangles_revision = render::kUnknownRevision;
  mesh.values_revision = render::kUnknownRevision;
}

/// Marks borders and creases on the edges, ridge vertices and corners with dots.
void show_classes(const Subject& subject, Depiction& made) {
  const Topology topology(subject.triangles, static_cast<Index>(subject.positions.size()));
  const VertexClasses found =
      classify_vertices(subject.positions, subject.triangles, topology, FeatureOptions{});
  made.marks = render::mark_boundary_edges(topology);
  for (const FeatureEdge& edge : found.creases) {
    for (const Corner corner : {edge.corner, topology.opposite(edge.corner)})
      if (corner != kNone) made.marks[corner / 3] |= render::kCreaseEdge[corner % 3];
  }
  render::SceneMesh& mesh = made.scene.meshes.front();
  mesh.edge_marks = made.marks;
  mesh.triangles_revision = render::kUnknownRevision;
  mesh.marked_edges.color = kBorderColor;
  mesh.crease_color = kCreaseColor;
  for (Index v = 0; v < found.classes.size(); ++v) {
    const bool corner = found.classes[v] == VertexClass::corner && !topology.corners_of(v).empty();
    if (corner)
      made.scene.markers.push_back({subject.positions[v], kCornerColor, 8});
    else if (found.classes[v] == VertexClass::ridge)
      made.scene.markers.push_back({subject.positions[v], kRidgeVertexColor, 5});
  }
}

void add_arrows(const View& view, const Subject& subject, render::Scene& scene) {
  const std::size_t count = std::min(subject.positions.size(), subject.against.size());
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3& from = subject.against[v];
    const Vec3 move = subject.positions[v] - from;
    if (move.squaredNorm() > 0) scene.arrows.items.push_back({from, from + view.arrow_scale * move});
  }
}

void select(Index triangle, render::Scene& scene) {
  render::SceneMesh& mesh = scene.meshes.front();
  if (triangle >= mesh.triangles.size()) return;
  mesh.highlighted_faces = {triangle};
  const Triangle& corners = mesh.triangles[triangle];
  render::Marker marker;
  marker.position =
      (mesh.positions[corners[0]] + mesh.positions[corners[1]] + mesh.positions[corners[2]]) / 3;
  scene.markers.push_back(marker);
}

}  // namespace

std::vector<std::string> report_lines(const QualityReport& report) {
  std::vector<std::string> lines{
      "Triangles\t" + grouped(report.triangles),
      "Smallest angle\t" + fixed(report.min_angle_deg, 2) + "°",
      "Mean smallest\t" + fixed(report.mean_min_angle_deg, 2) + "°",
      "Largest angle\t" + fixed(report.max_angle_deg, 2) + "°",
      "Below 30°\t" + fixed(100 * report.below_30_deg, 2) + " %",
      "Largest / least area\t" +
          (std::isfinite(report.area_max_over_min) ? fixed(report.area_max_over_min, 2) : "infinite")};
  if (report.inverted > 0) lines.push_back("Inverted\t" + grouped(report.inverted));
  if (report.degenerate > 0) lines.push_back("Degenerate\t" + grouped(report.degenerate));
  return lines;
}

Depiction depict(const View& view, const render::Coloring& coloring, const Subject& subject) {
  Depiction made;
  render::Scene& scene = made.scene;
  scene.pixels_per_point = view.points;
  scene.background = view.background;
  scene.transparent = view.transparent;
  scene.caption = subject.label;
  if (view.numbers && subject.report != nullptr) scene.notes = report_lines(*subject.report);
  render::SceneMesh& mesh = scene.meshes.emplace_back();
  mesh.positions = subject.positions;
  mesh.triangles = subject.triangles;
  mesh.face_values = subject.values;
  mesh.positions_revision = subject.positions_revision;
  mesh.triangles_revision = subject.triangles_revision;
  mesh.values_revision = subject.values_revision;
  mesh.faces_inward = subject.faces_inward;
  mesh.plane_normal = subject.plane_normal;
  mesh.coloring = coloring;
  mesh.shading = view.shading;
  mesh.wire.shown = view.wire;
  mesh.marked_edges.color = {205, 211, 222};
  mesh.marked_edges.width = 1.6;
  if (view.boundary) mesh.edge_marks = subject.boundary_marks;
  if (view.selected) select(*view.selected, scene);
  if (view.arrows) add_arrows(view, subject, scene);
  if (view.color == ColorBy::classes) show_classes(subject, made);
  if (view.only_worse_than && !mesh.face_values.empty()) keep_worse(view, made);
  return made;
}

}  // namespace isorelax::view
