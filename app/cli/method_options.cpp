#include "cli/method_options.h"

#include <CLI/App.hpp>

#include "cli/checks.h"
#include "mesh/error.h"
#include "smoothing/baselines.h"

namespace isorelax::cli {
namespace {

/// The value that belongs to a typed word; the first choice is the default.
template <typename T>
T choose(const std::string& option, const std::string& typed,
         std::initializer_list<std::pair<const char*, T>> choices) {
  if (typed.empty()) return choices.begin()->second;
  std::string known;
  std::size_t left = choices.size();
  for (const auto& [word, value] : choices) {
    if (typed == word) return value;
    known += word;
    if (--left > 0) known += left == 1 ? " or " : ", ";
  }
  throw UsageError(option + " " + typed + ": expected " + known);
}

void refuse(const CLI::App& app, const std::string& method, std::initializer_list<const char*> options) {
  for (const char* option : options) {
    if (app.count(option) > 0)
      throw UsageError(std::string(option) + " has no meaning with --method " + method);
  }
}

Method near_isometry(const CLI::App& app, const MethodSpec& spec, RecordDetail detail) {
  refuse(app, spec.method, {"--weighting", "--guard"});
  const auto solver = choose<Solver>("--solver", spec.solver,
                                     {{"auto", Solver::automatic},
                                      {"jacobi", Solver::jacobi},
                                      {"newton", Solver::newton},
                                      {"lbfgs", Solver::lbfgs}});
  if (spec.relaxation && solver != Solver::jacobi)
    throw UsageError("--relaxation has no meaning with --solver " +
                     (spec.solver.empty() ? "auto" : spec.solver));
  JacobiOptions jacobi;
  jacobi.detail = detail;
  if (spec.relaxation) jacobi.relaxation = *spec.relaxation;
  return {.make_smoother = [=](const SmoothingProblem& problem) {
    return solver == Solver::jacobi ? make_jacobi(problem, jacobi) : make_smoother(problem, solver, detail);
  }};
}

BaselineGuard parse_guard(const std::string& typed) {
  return choose<BaselineGuard>("--guard", typed, {{"on", BaselineGuard::on}, {"off", BaselineGuard::off}});
}

Method laplacian(const MethodSpec& spec, RecordDetail detail) {
  LaplacianOptions options;
  options.detail = detail;
  options.guard = parse_guard(spec.guard);
  options.weighting = choose<LaplacianWeighting>(
      "--weighting", spec.weighting,
      {{"length", LaplacianWeighting::length}, {"uniform", LaplacianWeighting::uniform}});
  options.relaxation = spec.relaxation;
  return {.make_smoother = [=](const SmoothingProblem& problem) { return make_laplacian(problem, options); },
          .guarded = options.guard == BaselineGuard::on,
          .minimises = false};
}

Method angle_based(const MethodSpec& spec, RecordDetail detail) {
  AngleBasedOptions options;
  options.detail = detail;
  options.guard = parse_guard(spec.guard);
  options.weighting = choose<AngleWeighting>(
      "--weighting", spec.weighting, {{"angle", AngleWeighting::angle}, {"plain", AngleWeighting::plain}});
  if (spec.relaxation) options.relaxation = *spec.relaxation;
  return {
      .make_smoother = [=](const SmoothingProblem& problem) { return make_angle_based(problem, options); },
      .guarded = options.guard == BaselineGuard::on,
      .minimises = false};
}

}  // namespace

void declare_method(CLI::App& app, MethodSpec& spec) {
  app.add_option("--method", spec.method,
                 "near-isometry (default), or a baseline to compare with: laplacian (to the mean of the "
                 "neighbours) or angle-based (to the bisectors at the neighbours, Zhou and Shimada)")
      ->type_name("METHOD");
  app.add_option(
         "--solver", spec.solver,
         "Of near-isometry: auto (default: evening out, Newton steps, then L-BFGS, and one vertex after "
         "another where many are at the limit), jacobi (the paper's step), newton or lbfgs (both with one "
         "vertex after another where steps of all are held up)")
      ->type_name("SOLVER");
  app.add_option("--weighting", spec.weighting,
                 "How neighbours count. laplacian: length (default, by the edge to them) or uniform; "
                 "angle-based: angle (default, 1 over the square of their two angles) or plain")
      ->type_name("W");
  app.add_option("--guard", spec.guard,
                 "Of the baselines: on (default) cuts back moves that turn a triangle over; off is the "
                 "method as published, and nothing is written when it turned one over")
      ->type_name("G");
  app.add_option("--relaxation", spec.relaxation,
                 "Factor on the step of jacobi (default 0.9), laplacian (uniform 1, length 0.5) and "
                 "angle-based (1)")
      ->type_name("W")
      ->check(number_between(0.01, 2));
}

Method parse_method(const CLI::App& app, const MethodSpec& spec, RecordDetail detail) {
  if (spec.method == "near-isometry") return near_isometry(app, spec, detail);
  if (spec.method != "laplacian" && spec.method != "angle-based") {
    throw UsageError("--method " + spec.method + ": expected near-isometry, laplacian or angle-based");
  }
  refuse(app, spec.method, {"--solver", "--mu", "--weights", "--exponent", "--reference"});
  return spec.method == "laplacian" ? laplacian(spec, detail) : angle_based(spec, detail);
}

}  // namespace isorelax::cli
