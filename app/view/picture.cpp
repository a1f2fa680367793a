#include "view/picture.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "io/mesh_file.h"
#include "mesh/error.h"
#include "mesh/topology.h"
#include "quality/inverted.h"
#include "render/overlay.h"
#include "surface/deviation.h"
#include "view/measures.h"
#include "view/panels.h"

namespace isorelax::view {
namespace {

/// A mesh with what the picture needs to know of it.
struct Prepared {
  std::vector<double> values;
  std::vector<std::uint8_t> boundary;
  bool faces_inward = false;
  std::optional<Vec3> plane_normal;
  std::optional<QualityReport> report;
  std::size_t inverted = 0;
};

bool has_values(const View& view) {
  return view.color != ColorBy::none && view.color != ColorBy::classes;
}

void require_sense(const View& view, const Exhibits& exhibits) {
  if (exhibits.meshes.empty()) throw UsageError("there is no mesh to show");
  const bool needs_start = view.difference || view.arrows;
  if (needs_start && exhibits.against == nullptr)
    throw UsageError("differences and arrows need a mesh to start from (--against)");
  if ((view.difference || view.only_worse_than) && !has_values(view))
    throw UsageError(
        "differences and the filter of worse triangles need colours by angle, max-angle, area or energy");
  if (!needs_start) return;
  for (std::size_t i = 0; i < exhibits.meshes.size(); ++i) {
    if (same_triangles(*exhibits.meshes[i], *exhibits.against)) continue;
    const std::string against = view.against.empty() ? "the mesh" : view.against;
    throw MeshError((i < view.meshes.size() ? view.meshes[i] : "a mesh") +
                    ": has other vertices or triangles than " + against + " that it is shown against");
  }
}

std::vector<double> values_of(const View& view, const TriangleMesh& mesh, const std::string& file) {
  try {
    return measure(view.color, view.energy, mesh.positions, mesh.triangles);
  } catch (const MeshError& error) {
    throw MeshError(file + ": " + error.what());
  }
}

/// What the colours of mesh i say.
std::vector<double> values_of(const View& view, const Exhibits& exhibits, std::size_t i) {
  const TriangleMesh& mesh = *exhibits.meshes[i];
  if (!has_values(view) || mesh.triangles.empty()) return {};
  std::vector<double> values = values_of(view, mesh, i < view.meshes.size() ? view.meshes[i] : "the mesh");
  if (!view.difference) return values;
  return change(values, values_of(view, *exhibits.against, view.against));
}

std::vector<Prepared> prepare(const View& view, const Exhibits& exhibits) {
  require_sense(view, exhibits);
  std::vector<Prepared> all;
  for (std::size_t i = 0; i < exhibits.meshes.size(); ++i) {
    const TriangleMesh* mesh = exhibits.meshes[i];
    Prepared& made = all.emplace_back();
    made.values = values_of(view, exhibits, i);
    if (mesh->triangles.empty()) continue;
    made.faces_inward = faces_inward(mesh->positions, mesh->triangles);
    const Topology topology(mesh->triangles, mesh->vertex_count());
    made.plane_normal = plane_normal(mesh->positions, mesh->triangles, topology);
    if (view.boundary) made.boundary = render::mark_boundary_edges(topology);
    if (view.numbers) made.report = measure_quality(*mesh);
    if (view.legend) made.inverted = inverted_triangles(mesh->positions, mesh->triangles, topology).size();
  }
  return all;
}

std::vector<double> all_values(const std::vector<Prepared>& prepared) {
  std::vector<double> all;
  for (const Prepared& one : prepared) all.insert(all.end(), one.values.begin(), one.values.end());
  return all;
}

std::size_t all_inverted(const std::vector<Prepared>& prepared) {
  std::size_t count = 0;
  for (const Prepared& one : prepared) count += one.inverted;
  return count;
}

double points_of(const View& view) {
  return view.points > 0 ? view.points : std::min(view.size.width, view.size.height) / 720.0;
}

/// All of the picture that is no mesh.
render::Scene legend_scene(const View& view, const render::Coloring& coloring, std::span<const double> values,
                           std::size_t inverted) {
  render::Scene scene;
  scene.background = view.background;
  scene.transparent = view.transparent;
  scene.pixels_per_point = points_of(view);
  if (view.legend && view.color != ColorBy::none) scene.legend = legend_of(view, coloring, values, inverted);
  return scene;
}

Panels panels_of(const View& view, const render::Scene& legend, std::size_t count) {
  const int width = static_cast<int>(std::ceil(render::legend_share(legend, view.size) * view.size.height));
  return arrange(view.size, count, width);
}

/// The label of mesh i: as given, or its file's name where there are several.
std::string label_of(const View& view, std::size_t i, std::size_t count) {
  if (i < view.labels.size()) return view.labels[i];
  if (count < 2 || i >= view.meshes.size()) return {};
  return std::filesystem::path(view.meshes[i]).filename().string();
}

/// What captions need at the bottom of a cell beyond the margin, as a share of its height.
double room_for_captions(const View& view, std::size_t count, render::Scene scene, render::PictureSize cell,
                         double margin) {
  for (std::size_t i = 0; i < count && scene.caption.empty(); ++i) scene.caption = label_of(view, i, count);
  const double free = margin * std::min(cell.width, cell.height) / cell.height;
  return std::max(0.0, render::caption_share(scene, cell) - free);
}

View resolved(const View& view, const Exhibits& exhibits, const std::vector<Prepared>& prepared,
              Arrangement arrangement) {
  View fixed = view;
  const std::vector<double> values = all_values(prepared);
  const render::Coloring coloring = coloring_of(view, values);
  if (has_values(view)) fixed.range = {RangeRule::ends, coloring.range};
  const auto* text = std::get_if<std::string>(&view.camera);
  if (text == nullptr) return fixed;
  const render::Scene legend = legend_scene(view, coloring, values, all_inverted(prepared));
  const std::size_t count = arrangement == Arrangement::side_by_side ? exhibits.meshes.size() : 1;
  const Panels panels = panels_of(view, legend, count);
  render::FitOptions fitting;
  if (count == 1) fitting.right = render::legend_share(legend, view.size);
  fitting.bottom = room_for_captions(view, exhibits.meshes.size(), legend, panels.cell, fitting.margin);
  std::vector<Vec3> positions;
  for (const TriangleMesh* mesh : exhibits.meshes)
    positions.insert(positions.end(), mesh->positions.begin(), mesh->positions.end());
  fixed.camera = render::parse_camera(*text, positions, panels.cell, fitting);
  return fixed;
}

Subject subject_of(const View& view, const Exhibits& exhibits, const Prepared& prepared, std::size_t i) {
  Subject subject;
  subject.positions = exhibits.meshes[i]->positions;
  subject.triangles = exhibits.meshes[i]->triangles;
  subject.values = prepared.values;
  subject.boundary_marks = prepared.boundary;
  subject.faces_inward = prepared.faces_inward;
  subject.plane_normal = prepared.plane_normal;
  if (exhibits.against != nullptr) subject.against = exhibits.against->positions;
  if (prepared.report) subject.report = &*prepared.report;
  subject.label = label_of(view, i, exhibits.meshes.size());
  return subject;
}

}  // namespace

View resolve(const View& view, const Exhibits& exhibits, Arrangement arrangement) {
  return resolved(view, exhibits, prepare(view, exhibits), arrangement);
}

Studio::Studio(render::ContextKind context)
    : context_(render::OffscreenContext::create(context)), renderer_(context_->loader()) {}

Studio::~Studio() {
  context_->make_current();  // the renderer's objects are of this one
}

render::Image Studio::draw_scene(const render::Scene& scene, const render::Camera& camera,
                                 render::PictureSize size, int supersampling) {
  if (supersampling == 1) {
    renderer_.draw(scene, camera, size);
    render::Image image = renderer_.read_back();
    if (scene.transparent) unmultiply(image);
    return image;
  }
  // Text stays as sharp as it is: only what is behind it is drawn larger.
  render::Scene behind = scene;
  behind.legend.reset();
  behind.caption.clear();
  behind.notes.clear();
  behind.pixels_per_point *= supersampling;
  renderer_.draw(behind, camera, {size.width * supersampling, size.height * supersampling});
  render::Image large = renderer_.read_back();
  if (scene.transparent) unmultiply(large);
  render::Image image = shrunk(large, supersampling);
  overlay(scene, image);
  return image;
}

Picture Studio::draw(const View& view, const Exhibits& exhibits) {
  context_->make_current();
  const std::vector<Prepared> prepared = prepare(view, exhibits);
  Picture picture{{}, resolved(view, exhibits, prepared, Arrangement::side_by_side)};
  const View& fixed = picture.view;
  const std::vector<double> values = all_values(prepared);
  const render::Coloring coloring = coloring_of(fixed, values);
  const render::Scene legend = legend_scene(fixed, coloring, values, all_inverted(prepared));
  const std::size_t count = exhibits.meshes.size();
  const Panels panels = panels_of(fixed, legend, count);
  const auto& camera = std::get<render::Camera>(fixed.camera);
  // Behind everything: what cells and strip leave free.
  if (count > 1) picture.image = draw_scene(legend, camera, fixed.size, 1);
  for (std::size_t i = 0; i < count; ++i) {
    Depiction depiction = depict(fixed, coloring, subject_of(fixed, exhibits, prepared[i], i));
    depiction.scene.pixels_per_point = points_of(fixed);
    if (count == 1) depiction.scene.legend = legend.legend;
    render::Image cell = draw_scene(depiction.scene, camera, panels.cell, fixed.supersampling);
    if (count == 1)
      picture.image = std::move(cell);
    else
      place(cell, static_cast<int>(i) % panels.columns * panels.cell.width,
            static_cast<int>(i) / panels.columns * panels.cell.height, picture.image);
  }
  return picture;
}

render::PictureTexts texts_of(const View& view) {
  return {{"Software", "Isorelax"}, {kViewKeyword, to_json(view)}};
}

void write_picture(const std::filesystem::path& path, const Picture& picture) {
  write_png(path, picture.image, texts_of(picture.view));
}

View read_view(const std::filesystem::path& path) {
  if (path.extension() == ".png") {
    const render::PictureTexts texts = render::read_png_texts(path);
    const auto found = texts.find(kViewKeyword);
    if (found == texts.end())
      throw InputError(path.string(), "", "carries no view: it was not drawn by isorelax");
    return parse_view(found->second, path.string());
  }
  return parse_view(read_bytes(path), path.string());
}

}  // namespace isorelax::view
