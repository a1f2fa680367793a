#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>

#include "generate/generate.h"
#include "smoothing/baselines.h"

namespace isorelax {
namespace {

struct Way {
  const char* name;
  std::function<std::unique_ptr<Smoother>(const SmoothingProblem&)> make;
};

std::vector<Way> ways() {
  const auto solver = [](Solver which) {
    return [=](const SmoothingProblem& problem) { return make_smoother(problem, which); };
  };
  return {{"jacobi", solver(Solver::jacobi)},
          {"newton", solver(Solver::newton)},
          {"lbfgs", solver(Solver::lbfgs)},
          {"automatic", solver(Solver::automatic)},
          {"laplacian", [](const SmoothingProblem& problem) { return make_laplacian(problem); }},
          {"angle-based", [](const SmoothingProblem& problem) { return make_angle_based(problem); }}};
}

struct Case {
  const char* name;
  TriangleMesh mesh;
  ProblemOptions options;
  /// Enough for the whole machinery, too few for rounding to grow.
  unsigned steps = 3;
  double tolerance = 1e-9;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"random square",
                 generate(ShapeKind::random_square, {.seed = 3, .triangles = 300}),
                 {.weights = {1, 0.5}, .exponent = 2}});
  all.push_back({"random sphere",
                 generate(ShapeKind::random_sphere, {.seed = 6, .vertices = 200}),
                 {.exponent = 2, .surface = SurfaceRule::tangent}});
  all.push_back({"part",
                 generate(ShapeKind::part, {.seed = 2, .triangles = 600}),
                 {.exponent = 2, .surface = SurfaceRule::tangent}});
  // Closest points on curves are found to 1e-7 of an edge.
  all.push_back({"part on its surface",
                 generate(ShapeKind::part, {.seed = 2, .triangles = 600, .jitter = 0.25}),
                 {.exponent = 2},
                 1,
                 1e-6});
  return all;
}

/// Where a few steps of a case lead from a mesh.
std::vector<Vec3> smoothed(const TriangleMesh& mesh, const Case& c, const Way& way) {
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, c.options);
  std::vector<Vec3> x = mesh.positions;
  run(*way.make(problem), problem, x, {.iterations = c.steps, .tolerance = 0});
  return x;
}

double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Eigen::Affine3d& map) {
  TriangleMesh copy = mesh;
  for (Vec3& p : copy.positions) p = map * p;
  return copy;
}

TEST(Smoothing, CommutesWithRotationTranslationAndScaling) {
  const Vec3 axis = Vec3(1, 2, -0.5).normalized();
  const Eigen::Affine3d rotation(Eigen::AngleAxisd(0.7, axis));
  const Eigen::Affine3d translation(Eigen::Translation3d(3, -2, 5));
  const Eigen::Affine3d scaling(Eigen::Scaling(1000.0));
  for (const Case& c : cases()) {
    for (const Way& way : ways()) {
      const std::vector<Vec3> plain = smoothed(c.mesh, c, way);
      EXPECT_GT(largest_distance(plain, c.mesh.positions), 1e-3) << c.name << ", " << way.name;
      for (const Eigen::Affine3d& map : {rotation, translation, scaling}) {
        std::vector<Vec3> expected = plain;
        for (Vec3& p : expected) p = map * p;
        const std::vector<Vec3> found = smoothed(transformed(c.mesh, map), c, way);
        EXPECT_LT(largest_distance(found, expected), c.tolerance * map.linear().norm())
            << c.name << ", " << way.name;
      }
    }
  }
}

TEST(Smoothing, DoesNotDependOnHowVerticesAndTrianglesAreNumbered) {
  std::mt19937 random(5);
  for (const Case& c : cases()) {
    std::vector<Index> new_id(c.mesh.positions.size());
    std::iota(new_id.begin(), new_id.end(), 0U);
    std::shuffle(new_id.begin(), new_id.end(), random);
    TriangleMesh renumbered = c.mesh;
    for (std::size_t v = 0; v < new_id.size(); ++v) renumbered.positions[new_id[v]] = c.mesh.positions[v];
    for (Triangle& t : renumbered.triangles) {
      for (Index& v : t) v = new_id[v];
      std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    }
    std::shuffle(renumbered.triangles.begin(), renumbered.triangles.end(), random);
    for (const Way& way : ways()) {
      const std::vector<Vec3> plain = smoothed(c.mesh, c, way);
      const std::vector<Vec3> other = smoothed(renumbered, c, way);
      std::vector<Vec3> back(other.size());
      for (std::size_t v = 0; v < new_id.size(); ++v) back[v] = other[new_id[v]];
      EXPECT_LT(largest_distance(back, plain), c.tolerance) << c.name << ", " << way.name;
    }
  }
}

TEST(Smoothing, KeepsTheSymmetryOfAMesh) {
  // A square with eightfold symmetry around a ring of eight free vertices: turned by a quarter it is itself.
  TriangleMesh mesh;
  mesh.positions.emplace_back(0, 0, 0);
  for (unsigned k = 0; k < 8; ++k) {
    const double angle = k * M_PI / 4;
    const double radius = k % 2 == 0 ? 0.2 : 0.45;
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  for (unsigned k = 0; k < 8; ++k) {
    const double angle = k * M_PI / 4;
    const double radius = k % 2 == 0 ? 1 : std::sqrt(2.0);
    mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  for (Index k = 0; k < 8; ++k) {
    const Index next = (k + 1) % 8;
    mesh.triangles.push_back({0, 1 + k, 1 + next});
    mesh.triangles.push_back({1 + k, 9 + k, 9 + next});
    mesh.triangles.push_back({1 + k, 9 + next, 1 + next});
  }
  for (const Way& way : ways()) {
    const std::vector<Vec3> x = smoothed(mesh, {"", mesh, {.exponent = 2}}, way);
    EXPECT_GT(largest_distance(x, mesh.positions), 1e-3) << way.name;
    EXPECT_LT(x[0].norm(), 1e-12) << way.name;
    for (Index k = 0; k < 8; ++k) {
      const Vec3 quarter(-x[1 + k].y(), x[1 + k].x(), 0);
      EXPECT_LT((x[1 + (k + 2) % 8] - quarter).norm(), 1e-12) << way.name;
    }
  }
}

}  // namespace
}  // namespace isorelax
