#include "cli/problem_options.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/vertex_files.h"
#include "mesh/error.h"
#include "motion/motion_choices.h"
#include "smoothing/pins.h"

namespace isorelax::cli {
namespace {

EnergyWeights parse_weights(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const auto shape = parse_number(std::string_view(text).substr(0, comma));
    const auto area = parse_number(std::string_view(text).substr(comma + 1));
    if (shape && area) return {*shape, *area};
  }
  throw UsageError("--weights " + text + ": expected two numbers, shape and area, as in 1,0.5");
}

BoundaryRule parse_boundary(const std::string& text) {
  if (text == "fixed") return BoundaryRule::fixed;
  if (text == "slide") return BoundaryRule::slide;
  if (text == "free") return BoundaryRule::free;
  throw UsageError("--boundary " + text + ": expected fixed, slide or free");
}

SurfaceRule parse_surface(const std::string& text) {
  if (text == "tangent") return SurfaceRule::tangent;
  if (text == "project") return SurfaceRule::project;
  throw UsageError("--surface " + text + ": expected tangent or project");
}

UntangleRule parse_untangle(const std::string& text) {
  if (text == "auto") return UntangleRule::automatic;
  if (text == "off") return UntangleRule::off;
  throw UsageError("--untangle " + text + ": expected auto or off");
}

/// What is minimised.
void declare_energy(CLI::App& app, ProblemSpec& spec) {
  auto* mu = app.add_option("--mu", spec.mu, "mu_A: 0 improves angles only, 1 areas only (default 0)")
                 ->type_name("M")
                 ->check(number_between(0, 1));
  app.add_option("--weights", spec.weights, "Weights of the shape and the area term, instead of --mu")
      ->type_name("S,A")
      ->excludes(mu);
  app.add_option(
         "--exponent", spec.exponent,
         "p from 1 to 64: minimise the sum of E^p; larger p favours the worst triangles (default 2; "
         "1 where squares would lower the mean of the smallest angles, unless areas count more than angles)")
      ->type_name("P");
  auto* reference =
      app.add_option(
             "--reference", spec.reference,
             "Triangles to aim at: equilateral (of the mean area, default), equilateral:EDGE, initial, "
             "or a mesh FILE")
          ->type_name("R");
  app.add_option(
         "--size-field", spec.size_field,
         "Equilateral triangles of varying size: curvature (smaller where the surface bends more), or a "
         "FILE with a target edge length for each vertex; scaled so that they cover the mesh. Takes "
         "a --mu near 1, as 0.9: the smaller, the more angles win over sizes")
      ->type_name("FIELD")
      ->excludes(reference);
}

/// What vertices may do.
void declare_rules(CLI::App& app, ProblemSpec& spec) {
  app.add_option(
         "--boundary", spec.boundary,
         "fixed (default); slide: along the border as it was, corners stay; or free: in the tangent plane "
         "(with the automatic solver it slides first), corners stay and the surface stays within a mean edge "
         "length, or --max-deviation, of what it was, either way: along the outline vertices may go farther")
      ->type_name("RULE");
  app.add_option(
         "--boundary-corner", spec.boundary_corner_deg,
         "The border has a corner where it turns by more than this, in degrees (default 45), and where a "
         "straight stretch of it ends")
      ->type_name("DEGREES")
      ->check(number_between(0, 180));
  app.add_option("--features", spec.features,
                 "Ridges and corners to keep: auto (default), none, or the least angle in degrees by "
                 "which a ridge turns (180: as none)")
      ->type_name("F");
  app.add_option("--surface", spec.surface,
                 "project (default): slide on the surface as it was; tangent: move in tangent planes only")
      ->type_name("RULE");
  app.add_option(
         "--untangle", spec.untangle,
         "auto (default): turn triangles that lie upside down before smoothing, just a few of a surface "
         "only where that hardly changes it; off: leave them")
      ->type_name("RULE");
  app.add_option("--pin", spec.pins,
                 "Vertices that must not move: boundary, feature, box:X0,Y0,Z0:X1,Y1,Z1 (two corners), "
                 "vertices:ID,ID,..., or a FILE of vertex numbers from 0 (repeatable)")
      ->type_name("WHICH")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--marks", spec.marks,
                 "Vertices that the file marks by groups of its elements (MSH): points, lines inside the "
                 "surface, where two groups meet: hold (default) or free")
      ->type_name("RULE")
      ->check(CLI::IsMember({"hold", "free"}));
}

}  // namespace

void declare_problem(CLI::App& app, ProblemSpec& spec) {
  declare_energy(app, spec);
  declare_rules(app, spec);
  app.add_option("--threads", spec.threads, "Threads; 0: all (default). The result does not depend on it")
      ->type_name("N");
}

ReferenceChoice parse_reference(Console& console, const std::string& text, const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  ReferenceChoice reference = read_reference(text, notes);
  for (const std::string& note : notes) console.message(note);
  const auto* other = std::get_if<MeshReference>(&reference);
  if (other != nullptr && other->positions.size() != mesh.positions.size())
    throw MeshError(text + ": has " + std::to_string(other->positions.size()) +
                    " vertices, the mesh that it is to be a reference for " +
                    std::to_string(mesh.positions.size()));
  return reference;
}

FeatureOptions parse_features(const std::string& text) {
  if (text == "auto") return {};
  if (text == "none") return FeatureOptions::none();
  const auto degrees = parse_number(text);
  if (!degrees || !(*degrees > 0) || !(*degrees <= 180)) {
    throw UsageError("--features " + text +
                     ": expected auto, none, or an angle over 0 and up to 180 degrees");
  }
  return FeatureOptions::ridges_from(*degrees);
}

namespace {

std::vector<Index> held_marks(const ProblemSpec& spec, const TriangleMesh& mesh) {
  if (spec.marks != "hold") return {};
  return marked_vertices(mesh, Topology(mesh.triangles, mesh.vertex_count()));
}

}  // namespace

std::string marks_as_pins(const ProblemSpec& spec, const TriangleMesh& mesh) {
  std::string word;
  for (const Index v : held_marks(spec, mesh)) word += (word.empty() ? "vertices:" : ",") + std::to_string(v);
  return word;
}

ProblemOptions parse_problem(Console& console, const ProblemSpec& spec, const TriangleMesh& mesh) {
  ProblemOptions options;
  options.weights = spec.weights.empty() ? EnergyWeights::from_mu(spec.mu) : parse_weights(spec.weights);
  options.exponent = spec.exponent;
  options.boundary = parse_boundary(spec.boundary);
  options.features = parse_features(spec.features);
  options.surface = parse_surface(spec.surface);
  options.features.boundary_turn_deg = spec.boundary_corner_deg;
  options.reference = parse_reference(console, spec.reference, mesh);
  if (spec.size_field == "curvature") {
    options.reference = CurvatureReference{options.features};
  } else if (!spec.size_field.empty()) {
    options.reference = SizeFieldReference{read_size_field(spec.size_field, mesh.positions.size())};
  }
  options.untangle = parse_untangle(spec.untangle);
  options.threads = spec.threads;
  options.pinned = parse_pins(console, spec.pins, mesh, options);
  const std::vector<Index> marks = held_marks(spec, mesh);
  if (!marks.empty()) {
    console.message(std::to_string(marks.size()) + (marks.size() == 1 ? " vertex is" : " vertices are") +
                    " held because the file marks them (--marks free: not)");
  }
  options.pinned.insert(options.pinned.end(), marks.begin(), marks.end());
  return options;
}

}  // namespace isorelax::cli
