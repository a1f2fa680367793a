#include "motion/motion_choices.h"

#include <array>
#include <cmath>

#include "generate/generate.h"
#include "io/mesh_file.h"
#include "io/text_in.h"
#include "io/text_out.h"

namespace isorelax {
namespace {

[[noreturn]] void refuse(std::string_view option, const std::string& word, const std::string& expected) {
  throw UsageError("--" + std::string(option) + " " + word + ": expected " + expected);
}

double positive(std::string_view option, const std::string& word) {
  double value = 0;
  if (!read_number(word, value) || !(value > 0) || !std::isfinite(value))
    refuse(option, word, "a number over 0");
  return value;
}

double between(std::string_view option, const std::string& word, double low, double high) {
  double value = 0;
  if (!read_number(word, value) || !(value >= low && value <= high))
    refuse(option, word, "a number from " + digits_of(low) + " to " + digits_of(high));
  return value;
}

unsigned count_from(std::string_view option, const std::string& word, unsigned least) {
  unsigned value = 0;
  if (!read_number(word, value) || value < least)
    refuse(option, word, "a whole number of " + std::to_string(least) + " or more");
  return value;
}

/// A run keeps a record of each.
constexpr double kMostSteps = 1e7;

/// Words with a meaning each.
template <typename Value, std::size_t N>
using Choices = std::array<std::pair<std::string_view, Value>, N>;

constexpr Choices<Integration, 2> kMethods{
    {{"rk4", Integration::vertices}, {"face-offsetting", Integration::face_offsetting}}};
constexpr Choices<Redistribution, 3> kRedistributions{{{"none", Redistribution::none},
                                                       {"tangent", Redistribution::tangent},
                                                       {"carrier", Redistribution::carrier}}};
constexpr Choices<Solver, 4> kSolvers{{{"jacobi", Solver::jacobi},
                                       {"newton", Solver::newton},
                                       {"lbfgs", Solver::lbfgs},
                                       {"auto", Solver::automatic}}};
constexpr Choices<bool, 2> kVolumes{{{"keep", true}, {"free", false}}};

template <typename Value, std::size_t N>
Value choose(std::string_view option, const std::string& word, const Choices<Value, N>& choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (word == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  refuse(option, word, "one of " + known);
}

template <typename Value, std::size_t N>
std::string word_of(const std::optional<Value>& value, const Choices<Value, N>& choices) {
  if (value)
    for (const auto& [name, meaning] : choices)
      if (meaning == *value) return std::string(name);
  return {};
}

using C = MotionChoices;

constexpr MotionOption kOptions[] = {
    {"sphere", "SPEC",
     "Start from a sphere, N[:RADIUS[:X,Y,Z]] (default 5832:0.15:0.5,0.75,0.5 where no mesh is given)",
     [](const std::string& w, C& c) { c.sphere = parse_sphere(w); },
     [](const C& c) { return c.sphere ? to_text(*c.sphere) : std::string(); }},
    {"field", "FIELD", "What moves the surface, see below (default paper)",
     [](const std::string& w, C& c) { c.field = parse_field(w, c.field); },
     [](const C& c) {
       const std::string text = to_text(c.field);
       return text == to_text(FieldSpec{}) ? std::string() : text;
     }},
    {"until", "T", "Time at which to end (default: the field's period, else 1)",
     [](const std::string& w, C& c) { c.until = positive("until", w); },
     [](const C& c) { return c.until ? digits_of(*c.until) : std::string(); }},
    {"step", "DT", "Length of a time step, of the first one with --tolerance (default 0.01)",
     [](const std::string& w, C& c) { c.step = positive("step", w); },
     [](const C& c) { return c.step == C{}.step ? std::string() : digits_of(c.step); }},
    {"tolerance", "E",
     "Choose steps such that the estimated error of each stays below this share of the start's "
     "bounding-box diagonal",
     [](const std::string& w, C& c) {
       c.tolerance = between("tolerance", w, std::numeric_limits<double>::min(), 1);
     },
     [](const C& c) { return c.tolerance ? digits_of(*c.tolerance) : std::string(); }},
    {"method", "M",
     "rk4: every vertex goes with the flow; face-offsetting: faces do, vertices are where they meet "
     "(default: the preset's; normal motion always offsets faces)",
     [](const std::string& w, C& c) { c.method = choose("method", w, kMethods); },
     [](const C& c) { return word_of(c.method, kMethods); }},
    {"preset", "P", "none, paper, accuracy, balanced (default) or angles, see below",
     [](const std::string& w, C& c) {
       static_cast<void>(motion_preset(w));
       c.preset = w;
     },
     [](const C& c) { return c.preset == C{}.preset ? std::string() : c.preset; }},
    {"redistribute", "HOW", "none, tangent or carrier (default: the preset's)",
     [](const std::string& w, C& c) { c.redistribute = choose("redistribute", w, kRedistributions); },
     [](const C& c) { return word_of(c.redistribute, kRedistributions); }},
    {"solver", "S", "Of tangent moves: jacobi (default), newton, lbfgs or auto",
     [](const std::string& w, C& c) { c.solver = choose("solver", w, kSolvers); },
     [](const C& c) { return word_of(c.solver, kSolvers); }},
    {"iterations", "N", "Moves after each step (default: the preset's)",
     [](const std::string& w, C& c) { c.iterations = count_from("iterations", w, 1); },
     [](const C& c) { return c.iterations ? std::to_string(*c.iterations) : std::string(); }},
    {"mu", "MU", "Of tangent moves: weight of areas against angles, 0 to 1 (default 0.5)",
     [](const std::string& w, C& c) { c.mu = between("mu", w, 0, 1); },
     [](const C& c) { return c.mu ? digits_of(*c.mu) : std::string(); }},
    {"reference", "R",
     "What triangles ought to look like: initial (default), equilateral, a mesh FILE with the same vertices, "
     "or, of tangent moves, equilateral:EDGE",
     [](const std::string& w, C& c) { c.reference = w; },
     [](const C& c) { return c.reference == C{}.reference ? std::string() : c.reference; }},
    {"every", "K", "Redistribute after every K-th step only (default 1)",
     [](const std::string& w, C& c) { c.every = count_from("every", w, 1); },
     [](const C& c) { return c.every == 1 ? std::string() : std::to_string(c.every); }},
    {"only-below", "DEG", "Redistribute only about triangles with an angle under this many degrees",
     [](const std::string& w, C& c) { c.only_below_deg = between("only-below", w, 0, 60); },
     [](const C& c) { return c.only_below_deg == 0 ? std::string() : digits_of(c.only_below_deg); }},
    {"volume", "RULE",
     "Of carrier moves: keep (default) gives the mesh the volume that the motion leaves the start's, by "
     "moves along normals; free leaves vertices on the surface",
     [](const std::string& w, C& c) { c.keep_volume = choose("volume", w, kVolumes); },
     [](const C& c) { return word_of(c.keep_volume, kVolumes); }},
    {"threads", "N", "Threads; 0: all (default). The result does not depend on it",
     [](const std::string& w, C& c) { c.threads = count_from("threads", w, 0); },
     [](const C& c) { return c.threads == 0 ? std::string() : std::to_string(c.threads); }},
};

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string_view::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
  }
  return parts;
}

}  // namespace

SphereStart parse_sphere(const std::string& text) {
  const auto check = [&](bool sound) {
    if (!sound) refuse("sphere", text, "N[:RADIUS[:X,Y,Z]], such as 5832:0.15:0.5,0.75,0.5");
  };
  SphereStart sphere;
  const std::vector<std::string_view> parts = parts_of(text, ':');
  double count = 0;
  check(read_number(parts[0], count) && count >= 4 && count <= 1e8 && count == std::floor(count) &&
        parts.size() <= 3);
  sphere.vertices = static_cast<std::size_t>(count);
  if (parts.size() > 1)
    check(read_number(parts[1], sphere.radius) && sphere.radius > 0 && std::isfinite(sphere.radius));
  if (parts.size() > 2) {
    const std::vector<std::string_view> numbers = parts_of(parts[2], ',');
    check(numbers.size() == 3);
    for (Eigen::Index i = 0; i < 3; ++i)
      check(read_number(numbers[static_cast<std::size_t>(i)], sphere.centre[i]) &&
            std::isfinite(sphere.centre[i]));
  }
  return sphere;
}

std::string to_text(const SphereStart& sphere) {
  std::string text = std::to_string(sphere.vertices) + ":" + digits_of(sphere.radius);
  for (Eigen::Index i = 0; i < 3; ++i) text += (i == 0 ? ":" : ",") + digits_of(sphere.centre[i]);
  return text;
}

TriangleMesh make_sphere(const SphereStart& sphere) {
  GenerateOptions options;
  options.vertices = sphere.vertices;
  TriangleMesh mesh = generate(ShapeKind::sphere, options);
  for (Vec3& x : mesh.positions) x = sphere.centre + sphere.radius * x;
  return mesh;
}

std::span<const MotionOption> motion_options() {
  return kOptions;
}

void read_words(std::span<const std::string> words, MotionChoices& choices) {
  for (std::size_t k = 0; k < words.size(); k += 2) {
    std::string_view name = words[k];
    if (name.starts_with("--")) name.remove_prefix(2);
    const auto* option = std::ranges::find(kOptions, name, &MotionOption::name);
    if (option == std::end(kOptions)) {
      std::string known;
      for (const MotionOption& o : kOptions) known += (known.empty() ? "" : ", ") + std::string(o.name);
      throw UsageError("\"" + words[k] + "\" is no option of a motion: expected one of " + known);
    }
    if (k + 1 == words.size()) throw UsageError(words[k] + ": its value is missing");
    option->read(words[k + 1], choices);
  }
}

std::vector<std::string> to_words(const MotionChoices& choices) {
  std::vector<std::string> words;
  for (const MotionOption& option : kOptions) {
    std::string text = option.text(choices);
    if (text.empty()) continue;
    words.push_back("--" + std::string(option.name));
    words.push_back(std::move(text));
  }
  return words;
}

double end_time(const MotionChoices& choices) {
  const FieldSpec& field = choices.field;
  const bool returns = field.kind == FieldKind::paper || field.kind == FieldKind::enright;
  return choices.until.value_or(returns ? field.period : 1);
}

ReferenceChoice read_reference(const std::string& word, std::vector<std::string>& notes) {
  if (word == "equilateral") return MeanAreaReference{};
  if (word == "initial") return InitialReference{};
  constexpr std::string_view kEdge = "equilateral:";
  if (word.starts_with(kEdge)) {
    double edge = 0;
    if (!read_number(std::string_view(word).substr(kEdge.size()), edge) || !(edge > 0))
      refuse("reference", word, "a positive edge length after the colon");
    return EdgeLengthReference{edge};
  }
  MeshFile file = read_mesh(word);
  for (const std::string& message : file.messages) notes.push_back(word + ": " + message);
  return MeshReference{std::move(file.mesh.positions)};
}

MovingSurfaceOptions motion_options_of(const MotionChoices& choices, std::vector<std::string>& notes) {
  MovingSurfaceOptions options = motion_preset(choices.preset);
  options.step = choices.step;
  options.tolerance = choices.tolerance;
  options.integration = choices.method.value_or(options.integration);
  options.redistribution = choices.redistribute.value_or(options.redistribution);
  const bool tangent = options.redistribution == Redistribution::tangent;
  if (!tangent && choices.solver) throw UsageError("--solver is for tangent moves: --redistribute tangent");
  if (!tangent && choices.mu) throw UsageError("--mu is for tangent moves: --redistribute tangent");
  if (options.redistribution != Redistribution::carrier && choices.keep_volume)
    throw UsageError("--volume is for carrier moves: --redistribute carrier");
  options.solver = choices.solver.value_or(options.solver);
  if (choices.iterations) options.iterations = options.carrier.iterations = *choices.iterations;
  if (choices.mu) options.weights = EnergyWeights::from_mu(*choices.mu);
  options.reference = read_reference(choices.reference, notes);
  if (options.redistribution == Redistribution::carrier &&
      std::holds_alternative<EdgeLengthReference>(options.reference))
    throw UsageError(
        "--reference " + choices.reference +
        ": carrier moves scale references to the mesh's area; an edge length is for tangent moves");
  options.every = choices.every;
  options.only_below_deg = choices.only_below_deg;
  options.balance_volume = choices.keep_volume.value_or(options.balance_volume);
  options.threads = choices.threads;
  return options;
}

MotionSetup set_up_motion(const MotionChoices& choices, std::optional<TriangleMesh> start,
                          std::vector<std::string>& notes) {
  MotionSetup setup;
  setup.motion = make_motion(choices.field);
  setup.options = motion_options_of(choices, notes);
  if (!setup.motion.field && setup.options.tolerance)
    throw UsageError("--tolerance is for velocity fields: motion along normals takes fixed steps");
  setup.until = end_time(choices);
  if (!(setup.until <= kMostSteps * choices.step))
    throw UsageError("--step " + digits_of(choices.step) + ": until " + digits_of(setup.until) +
                     " that would be more than 10 million steps");
  if (start) {
    setup.start = std::move(*start);
  } else {
    setup.sphere = choices.sphere.value_or(SphereStart{});
    setup.start = make_sphere(*setup.sphere);
  }
  return setup;
}

}  // namespace isorelax
