#include "smoothing/objective.h"

#include <gtest/gtest.h>

#include "generate/generate.h"

namespace isorelax {
namespace {

SmoothingProblem problem_of(const TriangleMesh& mesh, const ProblemOptions& options) {
  return make_problem(mesh.positions, mesh.triangles, options);
}

/// Sum of E^p by the plain functions of the energy room.
double plain_energy(const SmoothingProblem& p, std::span<const Vec3> x) {
  double sum = 0;
  for (Index t = 0; t < p.triangle_count(); ++t) {
    const Triangle& v = p.triangles[t];
    sum +=
        std::pow(evaluate_energy({x[v[0]], x[v[1]], x[v[2]]}, p.reference[t], p.weights).energy, p.exponent);
  }
  return sum;
}

/// Gradient at a vertex by the plain functions.
Vec3 plain_gradient(const SmoothingProblem& p, std::span<const Vec3> x, Index vertex) {
  Vec3 sum = Vec3::Zero();
  for (const Corner c : p.topology.corners_of(vertex)) {
    const Triangle& v = p.triangles[c / 3];
    const std::array<Vec3, 3> points = {x[v[0]], x[v[1]], x[v[2]]};
    const double energy = evaluate_energy(points, p.reference[c / 3], p.weights).energy;
    sum += p.exponent * std::pow(energy, p.exponent - 1) *
           energy_gradient(points, p.reference[c / 3], p.weights)[c % 3];
  }
  return sum;
}

TEST(Objective, AgreesWithThePlainFunctionsForEveryReferenceAndExponent) {
  const TriangleMesh mesh = generate(ShapeKind::torus, {.triangles = 500, .jitter = 0.4});
  TriangleMesh other = generate(ShapeKind::torus, {.seed = 9, .triangles = 500, .jitter = 0.4});
  for (const double exponent : {1.0, 2.0, 3.5}) {
    for (const ReferenceChoice& reference :
         {ReferenceChoice{MeanAreaReference{}}, ReferenceChoice{MeshReference{other.positions}}}) {
      const SmoothingProblem p =
          problem_of(mesh, {.weights = {0.7, 0.4}, .exponent = exponent, .reference = reference});
      Objective objective(p);
      const double energy = objective.evaluate(mesh.positions).energy;
      EXPECT_NEAR(energy, plain_energy(p, mesh.positions), 1e-12 * energy);
      for (Index v = 0; v < p.vertex_count(); ++v) {
        const Vec3 expected = plain_gradient(p, mesh.positions, v);
        EXPECT_LT((objective.gather(v).gradient - expected).norm(), 1e-10 * (1 + expected.norm())) << v;
      }
    }
  }
}

TEST(Objective, UpdateOfTheMovedTrianglesGivesTheBitsOfAFullEvaluation) {
  TriangleMesh mesh = generate(ShapeKind::sphere, {.vertices = 3000});
  const SmoothingProblem p = problem_of(mesh, {.weights = {1, 1}});
  Objective updated(p);
  updated.evaluate(mesh.positions);
  std::vector<Index> touched;
  for (const Index v : {7U, 8U, 2999U}) {
    mesh.positions[v] *= 1.01;
    for (const Corner c : p.topology.corners_of(v)) touched.push_back(c / 3);
  }
  Objective fresh(p);
  EXPECT_EQ(updated.update(mesh.positions, touched).energy, fresh.evaluate(mesh.positions).energy);
  EXPECT_EQ(updated.gather(8).gradient, fresh.gather(8).gradient);
}

TEST(Objective, KnowsThePositionsItBelongsToByTheirBits) {
  TriangleMesh mesh = generate(ShapeKind::cube, {.triangles = 300});
  const SmoothingProblem p = problem_of(mesh, {});
  Objective objective(p);
  objective.evaluate(mesh.positions);
  EXPECT_FALSE(objective.is_at(mesh.positions));
  objective.mark(mesh.positions);
  EXPECT_TRUE(objective.is_at(mesh.positions));
  mesh.positions[3].x() += 1e-15;
  EXPECT_FALSE(objective.is_at(mesh.positions));
}

}  // namespace
}  // namespace isorelax
