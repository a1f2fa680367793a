#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generate/generate.h"
#include "smoothing/bounded_run.h"

// Small cases whose minimiser is known, or found by other means.

namespace isorelax {
namespace {

constexpr std::array kSolvers = {Solver::jacobi, Solver::newton, Solver::lbfgs, Solver::automatic};

/// Nothing is a corner, not even where the border turns.
FeatureOptions no_corners() {
  FeatureOptions options = FeatureOptions::none();
  options.turn_deg = options.boundary_turn_deg = 181;
  return options;
}

std::vector<Vec3> minimised(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                            const ProblemOptions& options, Solver solver) {
  std::vector<Vec3> x(positions.begin(), positions.end());
  const SmoothingProblem problem = make_problem(x, triangles, options);
  run(*make_smoother(problem, solver), problem, x, {.iterations = 3000, .tolerance = 1e-11});
  return x;
}

/// Least value of a function with one minimum between low and high: golden section.
double minimiser_between(double low, double high, const std::function<double(double)>& f) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 100; ++i) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return 0.5 * (low + high);
}

double energy_of(std::span<const Vec3> x, std::span<const Triangle> triangles,
                 const ProblemOptions& options) {
  const ReferenceMesh reference = make_reference(options.reference, x, triangles);
  double sum = 0;
  for (Index t = 0; t < triangles.size(); ++t) {
    const Triangle& v = triangles[t];
    sum += std::pow(evaluate_energy({x[v[0]], x[v[1]], x[v[2]]}, reference[t], options.weights).energy,
                    options.exponent.value_or(kDefaultExponent));
  }
  return sum;
}

TEST(Minimisers, OfOneTriangleOnAFixedEdgeIsEquilateral) {
  const std::vector<Vec3> x = {{0, 0, 0}, {1, 0, 0}, {0.8, 0.3, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  for (const Solver solver : kSolvers) {
    const std::vector<Vec3> y = minimised(
        x, triangles, {.boundary = BoundaryRule::free, .features = no_corners(), .pinned = {0, 1}}, solver);
    EXPECT_LT((y[2] - Vec3(0.5, std::sqrt(0.75), 0)).norm(), 1e-6);
  }
}

TEST(Minimisers, BalanceAnglesAgainstAreas) {
  // By symmetry the apex stays above the middle; how high is left to one number.
  const std::vector<Vec3> x = {{0, 0, 0}, {1, 0, 0}, {0.6, 0.4, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  for (const double mu : {0.2, 0.5, 0.8}) {
    const ProblemOptions options{.weights = EnergyWeights::from_mu(mu),
                                 .reference = EdgeLengthReference{2},
                                 .boundary = BoundaryRule::free,
                                 .features = no_corners(),
                                 .pinned = {0, 1}};
    const double height = minimiser_between(0.1, 5, [&](double h) {
      return energy_of(std::vector<Vec3>{x[0], x[1], Vec3(0.5, h, 0)}, triangles, options);
    });
    EXPECT_GT(height, std::sqrt(0.75) + 0.01);
    for (const Solver solver : kSolvers) {
      const std::vector<Vec3> y = minimised(x, triangles, options, solver);
      EXPECT_LT((y[2] - Vec3(0.5, height, 0)).norm(), 1e-5) << "mu " << mu;
    }
  }
}

TEST(Minimisers, OfAFanAroundOneVertexLieOnItsAxis) {
  // A kite: the free vertex stays on the axis, at a height that one number gives.
  const std::vector<Vec3> x = {{0.2, 0.1, 0}, {1, 0, 0}, {0, 2, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  for (const double exponent : {1.0, 2.0, 5.0}) {
    // Areas of the start do not matter: the sum of all is the kite's.
    const ProblemOptions options{.weights = {1, 0.3}, .exponent = exponent};
    const double height = minimiser_between(-0.9, 1.9, [&](double h) {
      return energy_of(std::vector<Vec3>{Vec3(0, h, 0), x[1], x[2], x[3], x[4]}, triangles, options);
    });
    for (const Solver solver : kSolvers) {
      const std::vector<Vec3> y = minimised(x, triangles, options, solver);
      EXPECT_LT((y[0] - Vec3(0, height, 0)).norm(), 1e-5) << "exponent " << exponent;
    }
  }
}

TEST(Minimisers, OfAFanAboutAShortEdgeAreReachedByEverySolver) {
  // The needle on the short edge bends so much that a step which minds only its shape leads far too far.
  const double half = 0.03;
  std::vector<Vec3> x = {{0, 0, 0}};
  for (int i = 1; i < 8; ++i) x.emplace_back(std::cos(i * 0.785), std::sin(i * 0.785), 0);
  x.emplace_back(1, -half, 0);
  x.emplace_back(1, half, 0);
  std::vector<Triangle> triangles;
  for (Index i = 1; i < x.size(); ++i) triangles.push_back({0, i, i + 1 == x.size() ? 1 : i + 1});
  for (const double exponent : {2.0, 4.0}) {
    const ProblemOptions options{.exponent = exponent};
    const double found = energy_of(minimised(x, triangles, options, Solver::lbfgs), triangles, options);
    EXPECT_LT(found, 0.5 * energy_of(x, triangles, options));
    for (const Solver solver : kSolvers)
      EXPECT_NEAR(energy_of(minimised(x, triangles, options, solver), triangles, options), found,
                  1e-3 * found);
  }
}

// Two inner vertices beside the border of a strip: the largest angle of all, which nothing may exceed, holds
// up steps that all make at once.
TEST(Minimisers, AreReachedThoughTheLargestAngleHoldsStepsUp) {
  const std::vector<Vec3> x = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}, {1, 0, 0},        {2, 0, 0},
                               {3, 0, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {3.92, 0.977, 0}, {0.73, 0.41, 0}};
  const std::vector<Triangle> triangles = {{11, 3, 0}, {10, 6, 1}, {2, 10, 1}, {10, 9, 6},
                                           {9, 10, 2}, {11, 7, 3}, {4, 7, 11}, {6, 9, 5},
                                           {9, 8, 5},  {8, 7, 5},  {7, 4, 5},  {4, 11, 0}};
  const ProblemOptions options{.exponent = 16};
  const double least = energy_of(minimised(x, triangles, options, Solver::automatic), triangles, options);
  for (const Solver solver : {Solver::newton, Solver::lbfgs}) {
    const double energy = energy_of(minimised(x, triangles, options, solver), triangles, options);
    EXPECT_LT(energy, 1.001 * least) << static_cast<int>(solver);
  }
}

TEST(Minimisers, OfASlidingVertexLieInTheMiddleOfItsEdge) {
  const std::vector<Vec3> x = {{-1, 0, 0}, {0.4, 0, 0}, {1, 0, 0}, {0, 1.5, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 3}, {1, 2, 3}};
  for (const Solver solver : kSolvers) {
    const std::vector<Vec3> y = minimised(x, triangles, {.boundary = BoundaryRule::slide}, solver);
    EXPECT_LT(y[1].norm(), 1e-5);
    EXPECT_EQ(y[1].y(), 0);
    EXPECT_EQ(y[0], x[0]);
    EXPECT_EQ(y[3], x[3]);
  }
}

TEST(Minimisers, AgainstAMeshAreThatMesh) {
  const TriangleMesh wanted =
      generate(ShapeKind::hexagonal_square, {.seed = 4, .triangles = 120, .jitter = 0.2});
  const TriangleMesh start =
      generate(ShapeKind::hexagonal_square, {.seed = 9, .triangles = 120, .jitter = 0.4});
  ASSERT_EQ(wanted.triangles, start.triangles);
  const ProblemOptions options{.weights = {1, 1}, .reference = MeshReference{wanted.positions}};
  for (const Solver solver : kSolvers) {
    const std::vector<Vec3> y = minimised(start.positions, start.triangles, options, solver);
    double largest = 0;
    for (std::size_t v = 0; v < y.size(); ++v)
      largest = std::max(largest, (y[v] - wanted.positions[v]).norm());
    EXPECT_LT(largest, 1e-5);
    const double least = std::pow(4.0, kDefaultExponent) * static_cast<double>(start.triangles.size());
    EXPECT_NEAR(energy_of(y, start.triangles, options), least, 1e-6);
  }
}

}  // namespace
}  // namespace isorelax
