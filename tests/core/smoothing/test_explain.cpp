#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "generate/generate.h"
#include "smoothing/explain.h"
#include "smoothing/run.h"

namespace isorelax {
namespace {

struct ExplainCase {
  const char* name;
  TriangleMesh mesh;
  ProblemOptions options;
};

std::vector<ExplainCase> explain_cases() {
  std::vector<ExplainCase> all;
  all.push_back({"random square", generate(ShapeKind::random_square, {.seed = 3, .triangles = 400}), {}});
  all.push_back({"areas too, squared, sliding",
                 generate(ShapeKind::random_square, {.seed = 5, .triangles = 400}),
                 {.weights = {0.6, 0.4}, .exponent = 2, .boundary = BoundaryRule::slide}});
  all.push_back({"random sphere", generate(ShapeKind::random_sphere, {.seed = 6, .vertices = 400}), {}});
  all.push_back({"part, like itself",
                 generate(ShapeKind::part, {.seed = 7, .triangles = 1000}),
                 {.weights = {0.5, 0.5}, .reference = InitialReference{}}});
  return all;
}

struct Explained {
  SmoothingProblem problem;
  StepRecord record;
};

Explained step_of(const ExplainCase& c, Solver solver = Solver::newton) {
  Explained made{make_problem(c.mesh.positions, c.mesh.triangles, c.options), {}};
  make_smoother(made.problem, solver, RecordDetail::stages)->step(c.mesh.positions, made.record);
  return made;
}

TEST(Explain, AVertexGradientIsTheSumOfItsTrianglesAndTheEnergysSlope) {
  for (const ExplainCase& c : explain_cases()) {
    SCOPED_TRACE(c.name);
    const Explained made = step_of(c);
    EXPECT_EQ(check_gradients(made.problem, c.mesh.positions, made.record).wrong, 0U);
    for (Index v = 0; v < made.problem.vertex_count(); v += 7) {
      const auto e = explain_vertex(made.problem, c.options.features, c.mesh.positions, made.record, v);
      EXPECT_LT(e.share_error, kShareErrorLimit) << v;
      EXPECT_LT(e.quotient_error, kQuotientErrorLimit) << v;
    }
  }
}

TEST(Explain, AWrongSignInOneTermOfTheRecordIsSeen) {
  const ExplainCase c = explain_cases()[1];
  Explained made = step_of(c);
  const Index v = 200;
  const auto right = explain_vertex(made.problem, {}, c.mesh.positions, made.record, v);
  made.record.gradient[v].setZero();
  for (const TriangleShare& share : right.shares) made.record.gradient[v] += share.shape - share.area;
  const auto wrong = explain_vertex(made.problem, {}, c.mesh.positions, made.record, v);
  EXPECT_GT(wrong.share_error, 100 * kShareErrorLimit);
  EXPECT_GT(wrong.quotient_error, kQuotientErrorLimit);
  const GradientCheck check = check_gradients(made.problem, c.mesh.positions, made.record);
  EXPECT_EQ(check.wrong, 1U);
  EXPECT_EQ(check.worst, v);
}

TEST(Explain, TurnsOfBordersAreComparedWithTheBordersThreshold) {
  ExplainCase c = explain_cases()[0];
  c.options.features.boundary_turn_deg = 20;
  const Explained made = step_of(c);
  for (Index v = 0; v < made.problem.vertex_count(); ++v) {
    const auto e = explain_vertex(made.problem, c.options.features, c.mesh.positions, made.record, v);
    EXPECT_EQ(e.turn.threshold, made.problem.topology.is_boundary(v) ? 20 : 45) << v;
  }
}

TEST(Explain, TheTangentBasisHoldsTheProjectedGradientAndTheProposedMove) {
  for (const ExplainCase& c : explain_cases()) {
    SCOPED_TRACE(c.name);
    const Explained made = step_of(c);
    for (Index v = 0; v < made.problem.vertex_count(); v += 5) {
      const auto e = explain_vertex(made.problem, c.options.features, c.mesh.positions, made.record, v);
      ASSERT_EQ(e.basis.size(), e.dimensions);
      for (const Vec3& vector : {e.tangent, e.proposed}) {
        Vec3 inside = Vec3::Zero();
        for (const Vec3& b : e.basis) inside += b * b.dot(vector);
        EXPECT_LT((inside - vector).norm(), 1e-9 * (1 + vector.norm())) << v;
      }
      for (const Vec3& b : e.basis)
        EXPECT_LT(std::abs(b.dot(e.gradient - e.tangent)), 1e-9 * (1 + e.gradient.norm())) << v;
    }
  }
}

TEST(Explain, TheRoundsOfTheControlEndWithTheSharesThatAreMade) {
  for (const Solver solver : {Solver::jacobi, Solver::newton, Solver::lbfgs}) {
    const ExplainCase c = explain_cases()[0];
    const Explained made = step_of(c, solver);
    ASSERT_TRUE(made.record.detail);
    const auto& passes = made.record.detail->passes;
    ASSERT_EQ(passes.size(), made.record.fold_passes + made.record.energy_passes);
    EXPECT_GT(passes.size(), 0U) << "random points fold";
    EXPECT_EQ(alpha_after(made.record, passes.size()), made.record.alpha);
    EXPECT_EQ(alpha_after(made.record, 0), std::vector<double>(made.record.alpha.size(), 1.0));
  }
}

TEST(Explain, TheTriangleThatSetAShareIsOneAtTheVertex) {
  const ExplainCase c = explain_cases()[0];
  const Explained made = step_of(c);
  unsigned found = 0;
  for (Index v = 0; v < made.problem.vertex_count(); ++v) {
    const Index t = triangle_that_cut(made.record, v);
    if (t == kNone) continue;
    ++found;
    EXPECT_LT(made.record.alpha[v], 1);
    EXPECT_NE(made.record.limits[v] & kLimitFold, 0);
    const Triangle& corners = made.problem.triangles[t];
    EXPECT_TRUE(corners[0] == v || corners[1] == v || corners[2] == v);
  }
  EXPECT_GT(found, 0U);
}

TEST(Explain, DetailChangesNothingAboutAStep) {
  for (const ExplainCase& c : explain_cases()) {
    const Explained made = step_of(c);
    StepRecord plain;
    make_smoother(made.problem, Solver::newton)->step(c.mesh.positions, plain);
    EXPECT_FALSE(plain.detail);
    EXPECT_EQ(plain.displacement, made.record.displacement);
    EXPECT_EQ(plain.alpha, made.record.alpha);
    EXPECT_GT(bytes_of(made.record), bytes_of(plain));
  }
}

TEST(Explain, ATrianglesSingularValuesGiveItsEnergyBack) {
  for (const ExplainCase& c : explain_cases()) {
    SCOPED_TRACE(c.name);
    const Explained made = step_of(c);
    for (Index t = 0; t < made.problem.triangle_count(); t += 3) {
      const auto e = explain_triangle(made.problem, c.mesh.positions, made.record, t);
      if (!e.treated) continue;
      for (const TriangleMoment& state : {e.before, e.after}) {
        const auto [large, small] = state.singular_values;
        ASSERT_GE(large, small - 1e-12);
        EXPECT_NEAR(large / small + small / large, state.shape, 1e-6 * state.shape);
        const double det = std::sqrt(large * small);
        EXPECT_NEAR(det + 1 / det, state.area, 1e-6 * state.area);
        EXPECT_NEAR(state.energy, c.options.weights.shape * state.shape + c.options.weights.area * state.area,
                    1e-9);
        EXPECT_NEAR(std::accumulate(state.angles_deg.begin(), state.angles_deg.end(), 0.0), 180, 1e-9);
      }
    }
  }
}

TEST(Explain, TheReferenceTriangleHasTheReferencesAreaAndAngles) {
  const ExplainCase c = explain_cases()[3];
  const Explained made = step_of(c);
  const auto e = explain_triangle(made.problem, c.mesh.positions, made.record, 11);
  const auto& [p, q, r] = e.reference;
  EXPECT_NEAR(0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])), e.reference_area, 1e-12);
  EXPECT_NEAR(e.reference_area, e.before.metrics.area, 1e-9 * e.before.metrics.area)
      << "it is its own reference";
  EXPECT_NEAR(e.before.shape, 2, 1e-9);
}

}  // namespace
}  // namespace isorelax
