#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "generate/generate.h"
#include "smoothing/baselines.h"

namespace isorelax {
namespace {

TriangleMesh shuffled(const TriangleMesh& mesh) {
  std::mt19937 random(7);
  std::vector<Index> number(mesh.vertex_count());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  TriangleMesh copy = mesh;
  for (Index v = 0; v < number.size(); ++v) copy.positions[number[v]] = mesh.positions[v];
  for (Triangle& t : copy.triangles)
    for (Index& v : t) v = number[v];
  std::shuffle(copy.triangles.begin(), copy.triangles.end(), random);
  return copy;
}

TEST(Renumbering, LeavesGridsAndNumbersAllOfRandomlyNumberedMeshes) {
  const TriangleMesh grid = generate(ShapeKind::torus, {.seed = 1, .triangles = 4000, .jitter = 0.3});
  EXPECT_TRUE(Renumbering(grid.positions, grid.triangles).empty());
  const TriangleMesh random = generate(ShapeKind::random_sphere, {.seed = 1, .vertices = 3000});
  Renumbering numbering(random.positions, random.triangles);
  double jump = 0;
  for (std::size_t i = 1; i < numbering.vertices.size(); ++i)
    jump += (random.positions[numbering.vertices[i]] - random.positions[numbering.vertices[i - 1]]).norm();
  EXPECT_LT(jump / 3000, 0.12);  // the mean edge is 0.07, the mean distance of two vertices 1.3
  const std::vector<Index> places = inverse(numbering.vertices);
  for (Index v = 0; v < 3000; ++v) ASSERT_EQ(numbering.vertices[places[v]], v);
  std::ranges::sort(numbering.triangles);
  for (Index t = 0; t < random.triangle_count(); ++t) ASSERT_EQ(numbering.triangles[t], t);
}

struct RenumberedCase {
  const char* name;
  TriangleMesh mesh;
  ProblemOptions options;
};

std::vector<RenumberedCase> renumbered_cases() {
  std::vector<RenumberedCase> all;
  const TriangleMesh square = shuffled(generate(ShapeKind::hexagonal_square, {.seed = 3, .triangles = 2400}));
  std::vector<double> sizes;
  for (const Vec3& x : square.positions) sizes.push_back(1 + x[0]);
  all.push_back(
      {"square",
       square,
       {.weights = {1, 0.5}, .reference = SizeFieldReference{sizes}, .boundary = BoundaryRule::slide}});
  const TriangleMesh part =
      shuffled(generate(ShapeKind::part, {.seed = 2, .triangles = 3000, .jitter = 0.25}));
  const TriangleMesh regular = shuffled(generate(ShapeKind::part, {.seed = 2, .triangles = 3000}));
  all.push_back(
      {"part",
       part,
       {.reference = MeshReference{regular.positions}, .holds = {.still = {5, 17}, .distance = 0.02}}});
  all.push_back({"part in tangent planes", part, {.surface = SurfaceRule::tangent, .pinned = {3, 200}}});
  return all;
}

void expect_near(std::span<const Vec3> a, std::span<const Vec3> b, double tolerance, const char* what) {
  double scale = 0, largest = 0;
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t v = 0; v < a.size(); ++v) {
    scale = std::max(scale, a[v].norm());
    largest = std::max(largest, (a[v] - b[v]).norm());
  }
  EXPECT_LE(largest, tolerance * scale) << what;
}

TEST(Renumbering, MakesTheSameStepAndSaysItUnderTheNumbersOfTheProblem) {
  const std::vector<std::pair<const char*, SmootherFactory>> ways = {
      {"jacobi", [](const SmoothingProblem& p) { return make_jacobi(p, {.detail = RecordDetail::stages}); }},
      {"newton", [](const SmoothingProblem& p) { return make_newton(p, {.detail = RecordDetail::stages}); }},
      {"automatic",
       [](const SmoothingProblem& p) { return make_smoother(p, Solver::automatic, RecordDetail::stages); }},
      {"laplacian",
       [](const SmoothingProblem& p) { return make_laplacian(p, {.detail = RecordDetail::stages}); }},
      {"angle-based",
       [](const SmoothingProblem& p) { return make_angle_based(p, {.detail = RecordDetail::stages}); }}};
  for (const RenumberedCase& c : renumbered_cases()) {
    SmoothingProblem problem = make_problem(c.mesh.positions, c.mesh.triangles, c.options);
    ASSERT_FALSE(problem.numbering.empty()) << c.name;
    SmoothingProblem plain = problem;
    plain.numbering = {};
    for (const auto& [name, make] : ways) {
      SCOPED_TRACE(std::string(c.name) + ", " + name);
      StepRecord near, other;
      make(problem)->step(c.mesh.positions, near);
      make(plain)->step(c.mesh.positions, other);
      EXPECT_GT(near.moved, 0U);
      EXPECT_EQ(near.moved, other.moved);
      EXPECT_EQ(near.limits, other.limits);
      EXPECT_EQ(near.tangent_class, other.tangent_class);
      EXPECT_NEAR(near.before.energy, other.before.energy, 1e-10 * near.before.energy);
      EXPECT_NEAR(near.after.energy, other.after.energy, 1e-8 * near.before.energy);
      EXPECT_EQ(near.fold_passes, other.fold_passes);
      EXPECT_EQ(near.energy_passes, other.energy_passes);
      EXPECT_NEAR(near.largest_move, other.largest_move, 1e-6 * other.largest_move);
      std::vector<Vec3> there = c.mesh.positions, plain_there = there;
      apply_step(near, there);
      apply_step(other, plain_there);
      expect_near(there, plain_there, 1e-8, "positions");
      expect_near(near.gradient, other.gradient, 1e-10, "gradient");
      ASSERT_TRUE(near.detail && other.detail);
      EXPECT_EQ(near.detail->dimensions, other.detail->dimensions);
      expect_near(near.detail->tangent, other.detail->tangent, 1e-8, "tangent gradient");
      expect_near(near.detail->proposed, other.detail->proposed, 1e-6, "proposed move");
      for (Index t = 0; t < c.mesh.triangle_count(); ++t)
        ASSERT_NEAR(near.energy[t], other.energy[t], 1e-9 * other.energy[t]) << t;
      ASSERT_EQ(near.detail->passes.size(), other.detail->passes.size());
      for (std::size_t p = 0; p < near.detail->passes.size(); ++p) {
        const auto& cuts = near.detail->passes[p].cuts;
        const auto& plain_cuts = other.detail->passes[p].cuts;
        ASSERT_EQ(cuts.size(), plain_cuts.size());
        for (std::size_t k = 0; k < cuts.size(); ++k) {
          EXPECT_EQ(cuts[k].vertex, plain_cuts[k].vertex);
          // Of two that leave it the same share, either may be named.
          ASSERT_EQ(cuts[k].triangle == kNone, plain_cuts[k].triangle == kNone);
          if (cuts[k].triangle == kNone) continue;
          EXPECT_TRUE(std::ranges::count(c.mesh.triangles[cuts[k].triangle], cuts[k].vertex));
        }
      }
      EXPECT_EQ(alpha_after(near, near.detail->passes.size()), near.alpha);
    }
  }
}

TEST(Renumbering, KnowsWhereEachVertexIsOnTheSurface) {
  for (const RenumberedCase& c : renumbered_cases()) {
    const SmoothingProblem problem = make_problem(c.mesh.positions, c.mesh.triangles, c.options);
    if (!problem.surface) continue;
    for (Index v = 0; v < c.mesh.vertex_count(); ++v) {
      const SurfaceAnchor& anchor = problem.anchors[v];
      const Vec3& x = c.mesh.positions[v];
      ASSERT_EQ(problem.surface->closest_of(anchor.triangle, x).distance, 0) << c.name << ", " << v;
      ASSERT_EQ(anchor.edge == kNone, problem.classes.classes[v] == VertexClass::smooth)
          << c.name << ", " << v;
    }
  }
}

}  // namespace
}  // namespace isorelax
