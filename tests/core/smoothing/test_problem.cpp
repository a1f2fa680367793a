#include "smoothing/problem.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "generate/generate.h"
#include "mesh/error.h"
#include "smoothing/step_record.h"

namespace isorelax {
namespace {

/// A 3 x 3 grid of vertices in the plane, eight triangles, vertex 4 in the middle.
TriangleMesh grid() {
  TriangleMesh mesh;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) mesh.positions.emplace_back(i, j, 0);
  }
  for (Index j = 0; j < 2; ++j) {
    for (Index i = 0; i < 2; ++i) {
      const Index a = 3 * j + i;
      mesh.triangles.push_back({a, a + 1, a + 4});
      mesh.triangles.push_back({a, a + 4, a + 3});
    }
  }
  return mesh;
}

SmoothingProblem frozen(const TriangleMesh& mesh, const ProblemOptions& options = {}) {
  return make_problem(mesh.positions, mesh.triangles, options);
}

bool any_note_has(const SmoothingProblem& problem, const std::string& text) {
  return std::any_of(problem.notes.begin(), problem.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(Problem, BoundaryRuleDecidesWhoMayMove) {
  const TriangleMesh mesh = grid();
  const SmoothingProblem fixed = frozen(mesh);
  EXPECT_EQ(fixed.mobility[4], Mobility::plane);
  EXPECT_EQ(fixed.mobility[1], Mobility::none);
  EXPECT_EQ(fixed.fixed_limits[1], kLimitBoundary);

  const SmoothingProblem slide = frozen(mesh, {.boundary = BoundaryRule::slide});
  EXPECT_EQ(slide.mobility[1], Mobility::line);
  EXPECT_EQ(slide.mobility[0], Mobility::none);
  EXPECT_EQ(slide.fixed_limits[0], kLimitBoundary | kLimitCorner);
  auto ends = slide.border.at(1);
  std::sort(ends.begin(), ends.end());
  EXPECT_EQ(ends, (std::array<Index, 2>{0, 2}));

  const SmoothingProblem free = frozen(mesh, {.boundary = BoundaryRule::free});
  EXPECT_EQ(free.mobility[1], Mobility::plane);
  EXPECT_EQ(free.mobility[0], Mobility::none);
}

TEST(Problem, PlanarMeshIsRecognised) {
  EXPECT_TRUE(frozen(grid()).plane_normal.has_value());
  TriangleMesh bent = grid();
  bent.positions[4].z() = 0.1;
  EXPECT_FALSE(frozen(bent).plane_normal.has_value());
}

TEST(Problem, NonManifoldPlacesArePinnedAndNamed) {
  TriangleMesh mesh = grid();
  mesh.positions.emplace_back(0, 0, 1);
  mesh.triangles.push_back({1, 4, 9});
  const SmoothingProblem problem = frozen(mesh);
  EXPECT_EQ(problem.mobility[4], Mobility::none);
  EXPECT_TRUE(problem.fixed_limits[4] & kLimitPinned);
  EXPECT_TRUE(any_note_has(problem, "non-manifold vertices are pinned: 1, 4")) << problem.notes.front();
}

TEST(Problem, DegenerateTriangleIsLeftOutAndNamed) {
  TriangleMesh mesh = grid();
  mesh.positions[4] = mesh.positions[1];
  const SmoothingProblem problem = frozen(mesh);
  EXPECT_TRUE(any_note_has(problem, "degenerate"));
  EXPECT_EQ(problem.mobility[4], Mobility::none);
  EXPECT_EQ(std::count(problem.treated.begin(), problem.treated.end(), 0), 2);
}

TEST(Problem, InvertedTriangleOfAPlaneIsLeftOutAndNamed) {
  TriangleMesh mesh = grid();
  mesh.positions[4] = {-0.5, 1, 0};
  const SmoothingProblem problem = frozen(mesh);
  EXPECT_TRUE(any_note_has(problem, "inverted"));
  EXPECT_EQ(problem.mobility[4], Mobility::none);
}

TEST(Problem, PinnedVertexStays) {
  const SmoothingProblem problem = frozen(grid(), {.pinned = {4}});
  EXPECT_EQ(problem.mobility[4], Mobility::none);
  EXPECT_EQ(problem.fixed_limits[4], kLimitPinned);
  EXPECT_THROW(frozen(grid(), {.pinned = {9}}), UsageError);
}

TEST(Problem, RefusesWhatMakesNoSense) {
  EXPECT_THROW(frozen(grid(), {.weights = {0, 0}}), UsageError);
  EXPECT_THROW(frozen(grid(), {.weights = {-1, 2}}), UsageError);
  for (const double far : {1e-200, 1e-13, 1e13, 1e100})
    EXPECT_THROW(frozen(grid(), {.weights = {far, far}}), UsageError);
  EXPECT_NO_THROW(frozen(grid(), {.weights = {1e-12, 0}}));
  EXPECT_THROW(frozen(grid(), {.weights = {1e12, 0}, .exponent = 32}), UsageError);
  EXPECT_THROW(frozen(grid(), {.exponent = 0.5}), UsageError);
  EXPECT_THROW(frozen(grid(), {.reference = EdgeLengthReference{-1}}), UsageError);
  EXPECT_THROW(frozen(grid(), {.reference = MeshReference{{{0, 0, 0}}}}), MeshError);
  TriangleMesh flat = grid();
  for (Vec3& p : flat.positions) p.y() = 0;
  EXPECT_THROW(frozen(flat), MeshError);
  EXPECT_THROW(make_problem(flat.positions, {}, {}), MeshError);
}

TEST(Problem, CornersAndRidgesOfAPartAreHeld) {
  const TriangleMesh mesh = generate(ShapeKind::cube, {.triangles = 300});
  const SmoothingProblem problem = frozen(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    constexpr Mobility kExpected[] = {Mobility::plane, Mobility::line, Mobility::none};
    EXPECT_EQ(problem.mobility[v], kExpected[static_cast<unsigned>(problem.classes.classes[v])]);
  }
}

}  // namespace
}  // namespace isorelax
