#include "cli/smooth_run.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/option_words.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax::cli {
namespace {

constexpr std::array<std::pair<std::string_view, PolishGoal>, 3> kPolishGoals{
    {{"worst", PolishGoal::worst}, {"mean", PolishGoal::mean}, {"both", PolishGoal::both}}};

/// What a word says about the limit of the distance; none where it is a number.
std::optional<AutomaticLimit> limit_word(const std::string& text) {
  if (text == "nearest") return AutomaticLimit::nearest;
  if (text == "widest") return AutomaticLimit::widest;
  return std::nullopt;
}

const CLI::Validator kDistance = number_between(0, std::numeric_limits<double>::infinity());

bool is_file(const std::string& text) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(text, ignored);
}

}  // namespace

void SmoothRun::declare(CLI::App& app) {
  app_ = &app;
  const std::vector<CLI::Option*> others = app.get_options();
  declare_method(app, method_);
  declare_problem(app, problem_);
  app.add_option("--iterations", run_.iterations, "Largest number of steps before a polish (default 1000)")
      ->type_name("N")
      ->check(whole_number(0, std::numeric_limits<unsigned>::max()));
  app.add_option("--tolerance", run_.tolerance, "Stop threshold (default 1e-6)")
      ->type_name("T")
      ->check(number_between(0, std::numeric_limits<double>::max()));
  app.add_option(
         "--polish", polish_,
         "A last stage. worst: raises the smallest angles that can move, the worst first; mean: raises the "
         "mean "
         "of the triangles' smallest angles, and the worst tenth stay as good as they are; both: worst, then "
         "mean; "
         "none (default)")
      ->type_name("WHAT");
  app.add_option(
         "--polish-mean-loss", polish_options_.largest_mean_loss,
         "For the worst angles, the mean of the smallest angles of the triangles that can change falls by no "
         "more, degrees (default 1), nor by more than 0.1 beyond what the smallest of these rises or their "
         "largest falls")
      ->type_name("DEG")
      ->check(number_between(0, 60));
  app.add_option("--polish-worst-share", polish_options_.worst_share,
                 "For the mean, this share of the triangles, the worst, get no worse, and no other as bad "
                 "(default 0.1)")
      ->type_name("SHARE")
      ->check(number_between(0, 1));
  app.add_option(
         "--max-deviation", deviation_,
         "Largest distance from the input surface, of its bounding-box diagonal; inf: any; widest: 0.003, "
         "more where the mesh is coarse; nearest: mean edge length times dihedral angle, of that no less "
         "than an eighth (default: nearest, or widest where that pays). With the last three, what is as "
         "smooth as a sphere stays as round; a number is made full use of")
      ->type_name("D")
      ->check([](const std::string& text) {
        const std::string fault = limit_word(text) ? std::string() : kDistance(text);
        return fault.empty() ? fault : fault + ", nor inf, nearest or widest";
      });
  for (const CLI::Option* option : app.get_options()) {
    if (std::ranges::find(others, option) == others.end()) options_.push_back(option);
  }
}

void SmoothRun::check() const {
  const Method method = parse_method(*app_, method_);
  const std::optional<PolishOptions> polish = parse_polish();
  if (polish && !method.guarded) throw UsageError("--polish " + polish_ + ": not without a guard");
  const auto needs = [&](const char* option, PolishGoal one) {
    if (app_->count(option) == 0 || (polish && (polish->goal == one || polish->goal == PolishGoal::both)))
      return;
    throw UsageError(std::string(option) + " has no meaning with --polish " + polish_);
  };
  needs("--polish-mean-loss", PolishGoal::worst);
  needs("--polish-worst-share", PolishGoal::mean);
}

std::optional<PolishOptions> SmoothRun::parse_polish() const {
  if (polish_ == "none") return std::nullopt;
  PolishOptions options = polish_options_;
  for (const auto& [word, goal] : kPolishGoals) {
    if (polish_ != word) continue;
    options.goal = goal;
    return options;
  }
  throw UsageError("--polish " + polish_ + ": expected worst, mean, both or none");
}

DeviationLimit SmoothRun::limit() const {
  if (deviation_.empty()) return {};
  if (const auto word = limit_word(deviation_)) return {.max = {}, .automatic = *word};
  double limit = 0;
  std::from_chars(deviation_.data(), deviation_.data() + deviation_.size(), limit);
  return {.max = limit, .automatic = {}};
}

std::vector<std::string> SmoothRun::words(const TriangleMesh& mesh) const {
  std::vector<std::string> words = words_of(options_);
  if (std::string marks = marks_as_pins(problem_, mesh); !marks.empty())
    words.insert(words.end(), {"--pin", std::move(marks)});
  return words;
}

std::vector<std::string> SmoothRun::files() const {
  std::vector<std::string> found;
  for (const CLI::Option* option : options_)
    std::ranges::copy_if(option->results(), std::back_inserter(found), is_file);
  return found;
}

std::vector<TraceResource> SmoothRun::resources() const {
  std::vector<TraceResource> found;
  for (const std::string& file : files()) found.push_back({file, hash_of(read_bytes(file))});
  return found;
}

SmoothOutcome SmoothRun::smooth(Console& console, const std::string& input, TriangleMesh& mesh,
                                const StepObserver& observer, const PartObserver& part_observer) const {
  const Method method = parse_method(*app_, method_);
  ProblemOptions options = parse_problem(console, problem_, mesh);
  if (!method.minimises) options.exponent = 1;  // of the energy that is reported
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const auto measure = [&] {
    return measure_quality(mesh.positions, mesh.triangles, topology, options.threads);
  };
  SmoothOutcome outcome;
  outcome.before = measure();
  try {
    Progress progress(console, "smoothing");
    const auto start = std::chrono::steady_clock::now();
    const auto begin_part = [&](const RunPart& part, std::span<const Vec3> positions) {
      if (part.begins_run()) ++outcome.attempts;
      outcome.exponent = part.exponent;
      if (part_observer) part_observer(part, positions);
    };
    const auto show = [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> positions) {
      progress.update(static_cast<double>(iteration) / run_.iterations,
                      "iteration " + std::to_string(iteration) +
                          (outcome.attempts > 1 ? " of attempt " + std::to_string(outcome.attempts) : ""));
      return !observer || observer(iteration, record, positions);
    };
    if (method.guarded) {
      static_cast<BoundedResult&>(outcome) =
          run_bounded(mesh.positions, mesh.triangles, options, method.make_smoother, run_, limit(), show,
                      parse_polish(), begin_part);
    } else {
      RunPart only;
      only.exponent = options.exponent.value_or(kDefaultExponent);
      begin_part(only, mesh.positions);
      static_cast<UnguardedResult&>(outcome) =
          run_unguarded(mesh.positions, mesh.triangles, options, method.make_smoother, run_, show);
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } catch (const MeshError& error) {  // gets the name of its file
    throw MeshError(input + ": " + error.what());
  }
  outcome.after = measure();
  return outcome;
}

RunPlan SmoothRun::plan(Console& console, const TriangleMesh& mesh) const {
  return {parse_problem(console, problem_, mesh),
          parse_method(*app_, method_, RecordDetail::stages).make_smoother,
          parse_polish().value_or(polish_options_)};
}

void read_words(SmoothRun& run, CLI::App& app, std::vector<std::string> words) {
  run.declare(app);
  std::ranges::reverse(words);  // CLI11 takes them from the back
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw UsageError(std::string("the arguments of the trace are not understood: ") + error.what());
  }
  run.check();
}

RunPlan read_plan(const RunWords& words, const TriangleMesh& mesh) {
  Console silent;
  silent.set_verbosity(Verbosity::quiet);
  CLI::App app;
  SmoothRun run;
  read_words(run, app, words.arguments);
  return run.plan(silent, mesh);
}

}  // namespace isorelax::cli
