#include "compare/mesh_case.h"

#include <cmath>

#include "mesh/error.h"
#include "mesh/topology.h"
#include "quality/report.h"
#include "render/camera.h"
#include "surface/deviation.h"
#include "surface/surface_distance.h"
#include "view/picture.h"

namespace isorelax::compare {
namespace {

/// "(1.5, 0, 2)".
std::string place(const Vec3& p) {
  return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ")";
}

void add_quality(const TriangleMesh& a, const TriangleMesh& b, Case& result) {
  const QualityReport x = measure_quality(a);
  const QualityReport y = measure_quality(b);
  const auto add = [&](const char* key, const char* label, double of_a, double of_b) {
    result.figures.push_back({key, label, of_a, of_b});
  };
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  add("vertices", "Vertices", count(x.vertices), count(y.vertices));
  add("triangles", "Triangles", count(x.triangles), count(y.triangles));
  add("min_angle_deg", "Smallest angle, degrees", x.min_angle_deg, y.min_angle_deg);
  add("max_angle_deg", "Largest angle, degrees", x.max_angle_deg, y.max_angle_deg);
  add("mean_min_angle_deg", "Mean smallest angle, degrees", x.mean_min_angle_deg, y.mean_min_angle_deg);
  add("below_20_deg", "Share with an angle below 20 degrees", x.below_20_deg, y.below_20_deg);
  add("below_30_deg", "Share with an angle below 30 degrees", x.below_30_deg, y.below_30_deg);
  add("above_120_deg", "Share with an angle above 120 degrees", x.above_120_deg, y.above_120_deg);
  add("area_max_over_min", "Largest over least area", x.area_max_over_min, y.area_max_over_min);
  add("area_std_over_mean", "Deviation of areas over their mean", x.area_std_over_mean, y.area_std_over_mean);
  add("shape_mean", "Mean shape", x.shape_mean, y.shape_mean);
  add("shape_max", "Worst shape", x.shape_max, y.shape_max);
  add("radius_ratio_min", "Least radius ratio", x.radius_ratio_min, y.radius_ratio_min);
  add("scaled_jacobian_min", "Least scaled Jacobian", x.scaled_jacobian_min, y.scaled_jacobian_min);
  add("aspect_ratio_max", "Largest aspect ratio", x.aspect_ratio_max, y.aspect_ratio_max);
  add("inverted", "Inverted triangles", count(x.inverted), count(y.inverted));
  add("degenerate", "Degenerate triangles", count(x.degenerate), count(y.degenerate));
}

struct Displacement {
  double max = 0;  ///< length units
  double rms = 0;
  Index vertex = 0;
  std::size_t moved = 0;
};

Displacement displacement_of(const TriangleMesh& a, const TriangleMesh& b) {
  Displacement found;
  double squares = 0;
  for (Index v = 0; v < a.vertex_count(); ++v) {
    const double squared = (b.positions[v] - a.positions[v]).squaredNorm();
    squares += squared;
    found.moved += a.positions[v] != b.positions[v];
    if (squared > found.max * found.max) {
      found.max = std::sqrt(squared);
      found.vertex = v;
    }
  }
  found.rms = std::sqrt(squares / static_cast<double>(a.positions.size()));
  return found;
}

void compare_moved(const TriangleMesh& a, const TriangleMesh& b, double diagonal, const MeshLimits& limits,
                   Case& result) {
  const Displacement moves = displacement_of(a, b);
  const Topology topology(a.triangles, a.vertex_count());
  const Deviation deviation = measure_deviation(a.positions, b.positions, a.triangles, topology);
  const auto add = [&](const char* key, const char* label, double value) {
    result.figures.push_back({key, label, value, {}});
  };
  add("displacement_max", "Largest displacement, of the diagonal", moves.max / diagonal);
  add("displacement_rms", "RMS displacement, of the diagonal", moves.rms / diagonal);
  add("displacement_max_vertex", "Vertex that moved farthest", moves.vertex);
  add("moved", "Vertices that moved", static_cast<double>(moves.moved));
  add("fixed", "Vertices that did not", static_cast<double>(a.positions.size() - moves.moved));
  add("deviation_b_to_a", "Largest distance from B to A, of the diagonal", deviation.max_to_original);
  add("deviation_a_to_b", "Largest distance from A to B, of the diagonal", deviation.max_to_new);
  add("deviation_rms", "RMS distance of both, of the diagonal", deviation.rms);
  add("normal_change_deg", "Largest turn of a normal, degrees", deviation.normal_change_deg);
  if (deviation.has_volume)
    add("volume_change", "Change of the enclosed volume, of it", deviation.volume_change);
  if (moves.moved == 0)
    result.notes.emplace_back("No vertex moved.");
  else
    result.notes.push_back("Vertex " + std::to_string(moves.vertex) + " moved farthest: from " +
                           place(a.positions[moves.vertex]) + " to " + place(b.positions[moves.vertex]) +
                           ".");
  result.verdicts.push_back({"max-displacement", "largest displacement of a vertex, of the diagonal",
                             moves.max / diagonal, limits.displacement, false,
                             moves.max / diagonal <= limits.displacement});
  result.verdicts.push_back({"max-deviation", "largest distance between the surfaces, of the diagonal",
                             deviation.max, limits.deviation, false,
                             !is_over_limit(deviation.max, limits.deviation)});
}

void compare_surfaces(const TriangleMesh& a, const TriangleMesh& b, double diagonal, const MeshLimits& limits,
                      Case& result) {
  const Topology around_a(a.triangles, a.vertex_count()), around_b(b.triangles, b.vertex_count());
  const IndexedSurface surface_a(a.positions, a.triangles, around_a);
  const IndexedSurface surface_b(b.positions, b.triangles, around_b);
  const auto [from_a, from_b] = measure_both_ways(surface_a, surface_b, 0);
  const FarPoint& there = from_a.farthest;
  const FarPoint& back = from_b.farthest;
  const double most = std::max(there.distance, back.distance) / diagonal;
  result.figures.push_back(
      {"hausdorff_a_to_b", "Hausdorff distance from A to B, of the diagonal", there.distance / diagonal, {}});
  result.figures.push_back(
      {"hausdorff_b_to_a", "Hausdorff distance from B to A, of the diagonal", back.distance / diagonal, {}});
  result.figures.push_back({"hausdorff", "Hausdorff distance, of the diagonal", most, {}});
  result.notes.emplace_back("The meshes have different triangles: only their surfaces are compared.");
  result.notes.push_back("Farthest from B is " + place(there.point) + " on A; farthest from A is " +
                         place(back.point) + " on B.");
  result.verdicts.push_back({"max-deviation", "largest distance between the surfaces, of the diagonal", most,
                             limits.deviation, false, most <= limits.deviation});
}

}  // namespace

Case compare_meshes(const NamedMesh& a, const NamedMesh& b, const MeshLimits& limits) {
  for (const NamedMesh& one : {a, b})
    if (one.mesh->triangles.empty()) throw MeshError(one.file + ": has no triangles");
  Case result;
  result.name = b.file;
  result.a = a.file;
  result.b = b.file;
  const double length = render::bounds_of(a.mesh->positions).diagonal();
  const double diagonal = length > 0 ? length : 1;
  result.figures.push_back({"diagonal", "Bounding-box diagonal of A", length, {}});
  if (same_triangles(*a.mesh, *b.mesh))
    compare_moved(*a.mesh, *b.mesh, diagonal, limits, result);
  else
    compare_surfaces(*a.mesh, *b.mesh, diagonal, limits, result);
  add_quality(*a.mesh, *b.mesh, result);
  return result;
}

void add_pictures(const NamedMesh& a, const NamedMesh& b, const MeshPictures& how, Case& result) {
  view::Studio studio(how.context);
  const bool numbers = how.view.color != view::ColorBy::none && how.view.color != view::ColorBy::classes;
  view::View wanted = how.view;
  if (numbers && same_triangles(*a.mesh, *b.mesh)) {
    // One camera for all three: that of the change, whose legend is the widest.
    view::View change = how.view;
    change.difference = true;
    change.range = {};
    wanted.camera = view::resolve(change, {{a.mesh, b.mesh}, a.mesh}, view::Arrangement::one_by_one).camera;
  }
  const view::View shared = view::resolve(wanted, {{a.mesh, b.mesh}}, view::Arrangement::one_by_one);
  std::vector<render::Image> images;
  for (const NamedMesh& one : {a, b}) {
    view::View own = shared;
    own.meshes = {one.file};
    const view::Picture picture = studio.draw(own, {{one.mesh}});
    const bool first = images.empty();
    (first ? result.view_a : result.view_b) = view::to_json(picture.view);
    result.pictures.push_back(
        {first ? "A" : "B", render::encode_png(picture.image, view::texts_of(picture.view))});
    images.push_back(picture.image);
  }
  if (!same_triangles(*a.mesh, *b.mesh)) {
    const ImageComparison seen = compare_images(images[0], images[1], 0);
    result.pictures.push_back(
        {"Perceptual difference of the pictures (FLIP)", render::encode_png(heat_map(images[0], seen.flip))});
    return;
  }
  view::View change = shared;
  change.meshes = {b.file};
  change.against = a.file;
  change.difference = numbers;
  change.arrows = true;
  if (numbers) change.range = {};
  const view::Picture picture = studio.draw(change, {{b.mesh}, a.mesh});
  result.pictures.push_back(
      {numbers ? "Change from A to B, arrows where vertices went" : "B, arrows where vertices went",
       render::encode_png(picture.image, view::texts_of(picture.view))});
}

}  // namespace isorelax::compare
