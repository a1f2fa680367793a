#include "cli/motion_options.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <limits>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/option_words.h"
#include "cli/problem_options.h"
#include "cli/vertex_files.h"
#include "generate/generate.h"

namespace isorelax::cli {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

std::vector<std::string> split_words(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

/// One of several words, each with a meaning.
template <typename Value>
Value choose(const std::string& option, const std::string& word,
             std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw UsageError(option + " " + word + ": expected one of " + known);
}

}  // namespace

SphereStart parse_sphere(const std::string& text) {
  const auto fail = [&]() -> void {
    throw UsageError("--sphere " + text + ": expected N[:RADIUS[:X,Y,Z]], such as 5832:0.15:0.5,0.75,0.5");
  };
  SphereStart sphere;
  const std::vector<std::string> parts = split_words(text, ':');
  const auto count = parse_number(parts[0]);
  if (!count || !(*count >= 4 && *count <= 1e8) || *count != std::floor(*count) || parts.size() > 3) fail();
  sphere.vertices = static_cast<std::size_t>(*count);
  if (parts.size() > 1) {
    const auto radius = parse_number(parts[1]);
    if (!radius || !(*radius > 0) || !std::isfinite(*radius)) fail();
    sphere.radius = *radius;
  }
  if (parts.size() > 2) {
    const std::vector<std::string> numbers = split_words(parts[2], ',');
    if (numbers.size() != 3) fail();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto coordinate = parse_number(numbers[i]);
      if (!coordinate || !std::isfinite(*coordinate)) fail();
      sphere.centre[static_cast<Eigen::Index>(i)] = *coordinate;
    }
  }
  return sphere;
}

TriangleMesh make_sphere(const SphereStart& sphere) {
  GenerateOptions options;
  options.vertices = sphere.vertices;
  TriangleMesh mesh = generate(ShapeKind::sphere, options);
  for (Vec3& x : mesh.positions) x = sphere.centre + sphere.radius * x;
  return mesh;
}

void MotionSpec::declare(CLI::App& app) {
  app_ = &app;
  const std::vector<CLI::Option*> others = app.get_options();
  app.add_option(
         "--sphere", sphere_,
         "Start from a sphere, N[:RADIUS[:X,Y,Z]] (default 5832:0.15:0.5,0.75,0.5 where no mesh is given)")
      ->type_name("SPEC");
  app.add_option("--field", field_, "What moves the surface, see below (default paper)")->type_name("FIELD");
  app.add_option("--until", until_, "Time at which to end (default: the field's period, else 1)")
      ->type_name("T")
      ->check(number_between(std::numeric_limits<double>::min(), kLargest));
  app.add_option("--step", step_, "Length of a time step, of the first one with --tolerance (default 0.01)")
      ->type_name("DT")
      ->check(number_between(std::numeric_limits<double>::min(), kLargest));
  app.add_option("--tolerance", tolerance_,
                 "Choose steps such that the estimated error of each stays below this share of the start's "
                 "bounding-box diagonal")
      ->type_name("E")
      ->check(number_between(std::numeric_limits<double>::min(), 1));
  app.add_option(
         "--method", method_,
         "rk4: every vertex goes with the flow; face-offsetting: faces do, vertices are where they meet "
         "(default: the preset's; normal motion always offsets faces)")
      ->type_name("M");
  app.add_option("--preset", preset_, "none, paper, accuracy, balanced (default) or angles, see below")
      ->type_name("P");
  app.add_option("--redistribute", redistribute_, "none, tangent or carrier (default: the preset's)")
      ->type_name("HOW");
  app.add_option("--solver", solver_, "Of tangent moves: jacobi (default), newton, lbfgs or auto")
      ->type_name("S");
  app.add_option("--iterations", iterations_, "Moves after each step (default: the preset's)")
      ->type_name("N")
      ->check(whole_number(1));
  app.add_option("--mu", mu_, "Of tangent moves: weight of areas against angles, 0 to 1 (default 0.5)")
      ->type_name("MU")
      ->check(number_between(0, 1));
  app.add_option("--reference", reference_,
                 "What triangles ought to look like: initial (default), equilateral, equilateral:EDGE, or a "
                 "mesh FILE "
                 "with the same vertices")
      ->type_name("R");
  app.add_option("--every", every_, "Redistribute after every K-th step only (default 1)")
      ->type_name("K")
      ->check(whole_number(1));
  app.add_option("--only-below", only_below_,
                 "Redistribute only about triangles with an angle under this many degrees")
      ->type_name("DEG")
      ->check(number_between(0, 60));
  app.add_option(
         "--volume", volume_,
         "Of carrier moves: keep (default) gives the mesh the volume that the motion leaves the start's, by "
         "moves along normals; free leaves vertices on the surface")
      ->type_name("RULE");
  app.add_option("--threads", threads_, "Threads; 0: all (default). The result does not depend on it")
      ->type_name("N")
      ->check(whole_number(0));
  for (const CLI::Option* option : app.get_options())
    if (std::ranges::find(others, option) == others.end()) options_.push_back(option);
}

std::vector<std::string> MotionSpec::words() const {
  return words_of(options_);
}

MovingSurfaceOptions MotionSpec::parse_options(Console& console) const {
  MovingSurfaceOptions options = motion_preset(preset_);
  options.step = step_;
  if (app_->count("--tolerance") > 0) options.tolerance = tolerance_;
  if (!method_.empty()) {
    options.integration = choose<Integration>(
        "--method", method_,
        {{"rk4", Integration::vertices}, {"face-offsetting", Integration::face_offsetting}});
  }
  if (!redistribute_.empty()) {
    options.redistribution = choose<Redistribution>("--redistribute", redistribute_,
                                                    {{"none", Redistribution::none},
                                                     {"tangent", Redistribution::tangent},
                                                     {"carrier", Redistribution::carrier}});
  }
  const bool tangent = options.redistribution == Redistribution::tangent;
  for (const char* option : {"--solver", "--mu"})
    if (!tangent && app_->count(option) > 0)
      throw UsageError(std::string(option) + " is for tangent moves: --redistribute tangent");
  if (options.redistribution != Redistribution::carrier && !volume_.empty())
    throw UsageError("--volume is for carrier moves: --redistribute carrier");
  if (!solver_.empty()) {
    options.solver = choose<Solver>("--solver", solver_,
                                    {{"jacobi", Solver::jacobi},
                                     {"newton", Solver::newton},
                                     {"lbfgs", Solver::lbfgs},
                                     {"auto", Solver::automatic}});
  }
  if (iterations_ > 0) options.iterations = options.carrier.iterations = iterations_;
  options.weights = EnergyWeights::from_mu(mu_);
  options.reference = parse_reference(console, reference_);
  options.every = every_;
  options.only_below_deg = only_below_;
  if (!volume_.empty())
    options.balance_volume = choose<bool>("--volume", volume_, {{"keep", true}, {"free", false}});
  options.threads = threads_;
  return options;
}

MotionSetup MotionSpec::set_up(Console& console, const std::string& input) const {
  if (!input.empty() && !sphere_.empty()) throw UsageError("--sphere and a mesh: give one of them");
  MotionSetup setup;
  setup.motion = parse_motion(field_);
  setup.options = parse_options(console);
  if (!setup.motion.field && setup.options.tolerance)
    throw UsageError("--tolerance is for velocity fields: motion along normals takes fixed steps");
  setup.until = until_ > 0 ? until_ : setup.motion.period.value_or(1);
  if (input.empty()) {
    setup.sphere = sphere_.empty() ? SphereStart{} : parse_sphere(sphere_);
    setup.start = make_sphere(*setup.sphere);
  } else {
    setup.start = read_input(console, input);
  }
  return setup;
}

}  // namespace isorelax::cli
