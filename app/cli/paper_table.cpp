#include "cli/paper_table.h"

#include "generate/generate.h"
#include "smoothing/baselines.h"
#include "smoothing/polish.h"
#include "smoothing/unguarded_run.h"

namespace isorelax::cli {
namespace {

/// Triangles of the six meshes, where a kind can have that many.
constexpr std::array<std::size_t, kPaperMeshes> kTriangles = {460, 2394, 11704, 454, 2126, 10282};

using Run = std::function<RunResult(TriangleMesh&)>;

struct PaperMethod {
  std::string_view key, name, about;
  std::optional<PaperFigures> paper;
  Run run;  ///< none: the meshes as they are
};

constexpr PaperFigures kOriginal = {{12.0, 8.8, 8.5, 0.11, 1.1, 0.043},
                                    {129.5, 156.9, 147.5, 179.7, 176.9, 179.9}};
constexpr PaperFigures kLaplacian = {{33.1, 31.4, 30.8, 5.8, 4.9, 4.5},
                                     {99.4, 105.9, 109.2, 168.3, 170.8, 171.0}};
constexpr PaperFigures kAngleBased = {{32.9, 30.9, 29.5, 3.9, std::nullopt, std::nullopt},
                                      {96.0, 103.7, 105.9, 170.3, std::nullopt, std::nullopt}};
constexpr PaperFigures kConditionNumber = {{36.0, 36.1, 34.6, 12.6, 8.9, 10.3},
                                           {96.8, 100.1, 105.6, 153.2, 157.3, 156.2}};
constexpr PaperFigures kEqualArea = {{35.7, 35.3, 34.2, 12.7, 7.8, 8.9},
                                     {97.0, 101.3, 105.8, 153.9, 163.4, 160.6}};

constexpr std::array<std::string_view, 9> kChoices = {
    "The meshes are not published: U are equilateral rows with shaken vertices, R Delaunay triangles of "
    "random "
    "points, both of the unit square, from a seed.",
    "What the boundary does is not said: it is fixed. A triangle with all its vertices on it stays as it is, "
    "and in "
    "rows there are such at the corners: where a column shows the same angle throughout, it is theirs.",
    "How many steps were made is not said: the published methods make equally many, see their rows.",
    "Laplacian: whether vertices move one by one or all at once is not said. Here all at once, and half the "
    "way to "
    "the mean weighted by edge length: the full way swings and folds.",
    "Angle-based: the basic form of Zhou and Shimada, all neighbours alike, all vertices at once, no guard.",
    "CNEA-based is printed with mu_A = 1. Eq. 2 then has no angle term left, and its angles are terrible; "
    "its "
    "figures are those of the sum of both terms, weights (1, 1), the same minimiser as mu_A = 0.5.",
    "The sign of t_i in Eq. 7 is turned: as printed, the formula is not the gradient of Eq. 2.",
    "The step-size control of Sec. 3 keeps triangles from folding but not the energy from rising, and its "
    "results "
    "then get no better: a step is also cut back where the energy would rise, and relaxed by 0.9.",
    "How much better any method could be: where a vertex of three triangles is next to one of four, as in "
    "large "
    "random meshes, no positions have a smallest angle m above 22.5 degrees or above 1.5 M - 180, with M the "
    "largest. Polishing comes to this bound from where it starts, better in both: no row is better in both "
    "than every other.",
};

ProblemOptions energy(EnergyWeights weights, double exponent) {
  ProblemOptions options;
  options.weights = weights;
  options.exponent = exponent;
  options.threads = 1;
  return options;
}

/// Once, without any limit: what a method does to a planar mesh.
Run runs(const ProblemOptions& problem, const SmootherFactory& make, const RunOptions& options) {
  return [=](TriangleMesh& mesh) -> RunResult {
    return run_unguarded(mesh.positions, mesh.triangles, problem, make, options).run;
  };
}

/// To the end, and then the worst angles themselves.
Run polished(const ProblemOptions& options, const SmootherFactory& make, const RunOptions& run_options) {
  return [=](TriangleMesh& mesh) -> RunResult {
    const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, options);
    RunResult result = run_with_continuation(problem, make, mesh.positions, run_options, {});
    const PolishOptions polish;
    const RunResult last = isorelax::run(*make_polish(problem, polish), problem, mesh.positions,
                                         {.iterations = polish.iterations, .tolerance = kPolishTolerance});
    result.iterations += last.iterations;
    result.seconds += last.seconds;
    return result;
  };
}

std::vector<PaperMethod> paper_methods(unsigned iterations) {
  const RunOptions as_published{.iterations = iterations, .tolerance = 0};
  const RunOptions to_the_end{.iterations = 2000, .tolerance = 1e-6};
  const auto laplacian = [](const SmoothingProblem& problem) {
    LaplacianOptions options;
    options.guard = BaselineGuard::off;
    return make_laplacian(problem, options);
  };
  const auto angle_based = [](const SmoothingProblem& problem) {
    AngleBasedOptions options;
    options.weighting = AngleWeighting::plain;
    options.guard = BaselineGuard::off;
    return make_angle_based(problem, options);
  };
  const auto jacobi = [](const SmoothingProblem& problem) { return make_jacobi(problem); };
  const auto automatic = [](const SmoothingProblem& problem) {
    return make_smoother(problem, Solver::automatic);
  };
  return {
      {"original", "Original", "the meshes as made", kOriginal, {}},
      {"laplacian", "Laplacian", "weighted by edge length, unguarded", kLaplacian,
       runs(energy({1, 0}, 1), laplacian, as_published)},
      {"angle_based", "Angle-based", "Zhou and Shimada, unguarded", kAngleBased,
       runs(energy({1, 0}, 1), angle_based, as_published)},
      {"cn", "CN-based", "the paper's step, mu 0", kConditionNumber,
       runs(energy({1, 0}, 1), jacobi, as_published)},
      {"cnea", "CNEA-based", "the paper's step, weights (1, 1)", kEqualArea,
       runs(energy({1, 1}, 1), jacobi, as_published)},
      {"converged", "Converged", "mu 0, exponent 2, Newton and L-BFGS to the end", std::nullopt,
       runs(energy({1, 0}, 2), automatic, to_the_end)},
      {"worst_element", "Worst element", "mu 0, exponents 2 to 32, to the end", std::nullopt,
       runs(energy({1, 0}, 32), automatic, to_the_end)},
      {"polished", "Polished", "converged, then the worst angles themselves, --polish worst", std::nullopt,
       polished(energy({1, 0}, 2), automatic, to_the_end)},
      {"worst_polished", "Worst polished", "worst element, then --polish worst", std::nullopt,
       polished(energy({1, 0}, 32), automatic, to_the_end)},
  };
}

TriangleMesh paper_mesh(std::size_t i, const PaperTableOptions& table) {
  GenerateOptions options;
  options.triangles = table.triangles ? (*table.triangles)[i % 3] : kTriangles[i];
  options.seed = table.seed + i % 3;
  return generate(i < 3 ? ShapeKind::hexagonal_square : ShapeKind::random_square, options);
}

}  // namespace

std::vector<PaperRow> compute_paper_table(const PaperTableOptions& options,
                                          const std::function<void(double, std::string_view)>& progress) {
  const std::vector<PaperMethod> methods = paper_methods(options.iterations);
  std::vector<PaperRow> rows;
  for (const PaperMethod& method : methods) {
    PaperRow row;
    row.key = method.key;
    row.name = method.name;
    row.about = method.about;
    row.paper = method.paper;
    for (std::size_t i = 0; i < kPaperMeshes; ++i) {
      progress(static_cast<double>(rows.size() * kPaperMeshes + i) /
                   static_cast<double>(methods.size() * kPaperMeshes),
               method.name);
      row.meshes[i] = paper_mesh(i, options);
      if (method.run) {
        const RunResult result = method.run(row.meshes[i]);
        row.iterations[i] = result.iterations;
        row.seconds += result.seconds;
      }
      row.quality[i] = measure_quality(row.meshes[i], 1);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::span<const std::string_view> paper_choices() {
  return kChoices;
}

}  // namespace isorelax::cli
