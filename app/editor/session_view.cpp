#include "editor/session_view.h"

#include <array>
#include <cmath>
#include <string>

#include "io/text_out.h"
#include "view/scene.h"

namespace isorelax::editor {
namespace {

view::ColorBy color_of(model::Coloring coloring, const view::View& base) {
  switch (coloring) {
    case model::Coloring::none:
      break;
    case model::Coloring::min_angle:
      return view::ColorBy::min_angle;
    case model::Coloring::max_angle:
      return view::ColorBy::max_angle;
    case model::Coloring::relative_area:
      return view::ColorBy::area;
    case model::Coloring::energy:
      return view::ColorBy::energy;
  }
  // The session knows no colouring by classes: there it stands for none.
  return base.color == view::ColorBy::classes ? base.color : view::ColorBy::none;
}

/// Edge of the equilateral triangle that has the mean area of the mesh as opened: what the session measures
/// energies against while the mesh changes.
std::string mean_area_reference(const model::Session& session) {
  if (session.current->geometry == session.original->geometry) return "equilateral";
  const auto& x = session.original->geometry->positions;
  const auto& triangles = session.document->mesh().triangles;
  double area = 0;
  for (const Triangle& t : triangles) area += 0.5 * area_vector(x[t[0]], x[t[1]], x[t[2]]).norm();
  const double mean = area / static_cast<double>(triangles.size());
  return "equilateral:" + digits_of(std::sqrt(4 * mean / std::sqrt(3.0)));
}

/// Triangles of a moving surface are measured against its own reference.
view::EnergyTerms energy_of_motion(const model::Session& session, const MotionChoices& motion) {
  const double mu = motion.mu.value_or(MovingSurfaceOptions{}.weights.area);
  view::EnergyTerms terms{1 - mu, mu, motion.reference};
  if (motion.reference == "initial") terms.reference = session.document->path.string();
  if (motion.reference == "equilateral") terms.reference = mean_area_reference(session);
  return terms;
}

view::EnergyTerms energy_of(const model::Session& session) {
  if (const model::Branch* branch = session.moving()) return energy_of_motion(session, *branch->motion);
  const model::SmoothingSettings& settings = session.smoothing;
  view::EnergyTerms terms{1 - settings.mu_a, settings.mu_a, ""};
  switch (settings.reference) {
    case model::ReferenceKind::mean_area:
      terms.reference = mean_area_reference(session);
      break;
    case model::ReferenceKind::edge_length:
      terms.reference = "equilateral:" + digits_of(settings.edge_length);
      break;
    case model::ReferenceKind::initial:
      terms.reference = session.document->path.string();
      break;
    case model::ReferenceKind::file:
      terms.reference = settings.reference_file;
      break;
  }
  return terms;
}

/// The file that holds what is shown; the one that was opened when no file does.
std::string file_of(const model::Session& session) {
  const bool saved = session.save_path && session.is_saved_in(*session.save_path);
  return (saved ? *session.save_path : session.document->path).string();
}

/// The ends of the colour map: those of the run unless the view asks for others.
view::RangeChoice range_of(const model::Session& session, view::View view) {
  const model::ViewSettings& settings = session.view;
  const model::ValueRange range = session.color_range();
  if (settings.range_mode == model::RangeMode::typed) return {view::RangeRule::ends, {range.low, range.high}};
  if (view.difference) return {};  // of its own values
  view.range = {
      settings.range_mode == model::RangeMode::run ? view::RangeRule::run : view::RangeRule::current, {}};
  // The quantity's rules need only the extremes.
  const std::array ends{range.low, range.high};
  return {view::RangeRule::ends, view::coloring_of(view, ends).range};
}

}  // namespace

model::Coloring coloring_of(view::ColorBy color) {
  switch (color) {
    case view::ColorBy::min_angle:
      return model::Coloring::min_angle;
    case view::ColorBy::max_angle:
      return model::Coloring::max_angle;
    case view::ColorBy::area:
      return model::Coloring::relative_area;
    case view::ColorBy::energy:
      return model::Coloring::energy;
    case view::ColorBy::none:
    case view::ColorBy::classes:
      break;
  }
  return model::Coloring::none;
}

view::View view_of(const model::Session& session, const view::View& base, const render::Camera& camera,
                   render::PictureSize size, float points) {
  const model::ViewSettings& settings = session.view;
  view::View view = base;
  view.meshes = {file_of(session)};
  view.color = color_of(settings.coloring, base);
  const bool colored = settings.coloring != model::Coloring::none;
  view.difference = base.difference && colored;
  if (!colored) view.only_worse_than.reset();
  view.against = view.difference || view.arrows ? session.document->path.string() : std::string();
  view.energy = settings.coloring == model::Coloring::energy ? energy_of(session) : view::EnergyTerms{};
  view.color_map.reset();
  if (!settings.color_map.empty()) view.color_map = render::parse_color_map(settings.color_map);
  view.reversed = settings.reversed;
  view.wire = settings.wire;
  view.boundary = true;
  view.legend = settings.legend;
  view.labels.clear();
  view.shading = settings.shading == model::Shading::flat ? render::Shading::flat : render::Shading::smooth;
  view.size = size;
  view.supersampling = 1;
  view.points = points;
  if (session.selected_triangle) view.selected = session.selected_triangle;
  view.camera = camera;
  view.range = colored ? range_of(session, view) : view::RangeChoice{};
  return view;
}

model::ViewSettings settings_of(const view::View& view, const model::ViewSettings& present) {
  model::ViewSettings settings = present;
  settings.coloring = coloring_of(view.color);
  settings.color_map = view.color_map ? std::string(render::name_of(*view.color_map)) : std::string();
  settings.reversed = view.reversed;
  settings.wire = view.wire;
  settings.legend = view.legend;
  settings.shading = view.shading == render::Shading::flat ? model::Shading::flat : model::Shading::smooth;
  switch (view.range.rule) {
    case view::RangeRule::run:
      settings.range_mode = model::RangeMode::run;
      break;
    case view::RangeRule::current:
      settings.range_mode = model::RangeMode::current;
      break;
    case view::RangeRule::ends:
      settings.range_mode = model::RangeMode::typed;
      settings.typed[static_cast<std::size_t>(settings.coloring)] = {view.range.ends.low,
                                                                     view.range.ends.high};
      break;
  }
  return settings;
}

}  // namespace isorelax::editor
