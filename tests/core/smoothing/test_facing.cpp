// Which way triangles face: what a sliver's normal is taken to be, and that none comes to face away.
#include <gtest/gtest.h>

#include <random>

#include "generate/generate.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"
#include "smoothing/initial_normals.h"
#include "smoothing/surface_watch.h"
#include "smoothing/turn_limit.h"

namespace isorelax {
namespace {

constexpr Index kAbout = 40;  // a triangle of the sphere

TriangleMesh coarse_sphere() {
  return generate(ShapeKind::sphere, {.vertices = 60});
}

/// The sphere with a corner of one triangle near the opposite edge, over it by a share of its height before.
TriangleMesh squeezed_sphere(double share, double radius) {
  TriangleMesh mesh = coarse_sphere();
  const auto [a, b, c] = mesh.triangles[kAbout];
  const Vec3 middle = 0.5 * (mesh.positions[a] + mesh.positions[b]);
  mesh.positions[c] = radius * (middle + share * (mesh.positions[c] - middle)).normalized();
  return mesh;
}

Vec3 unit_normal(const TriangleMesh& mesh, Index t) {
  const auto [a, b, c] = mesh.triangles[t];
  return area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]).normalized();
}

TEST(InitialNormals, ASliverOnARoundedPartFacesAsItsSurroundingsDo) {
  const TriangleMesh mesh = squeezed_sphere(0.04, 1);
  const auto [a, b, c] = mesh.triangles[kAbout];
  const Vec3 outwards = (mesh.positions[a] + mesh.positions[b]).normalized();
  ASSERT_LT(unit_normal(mesh, kAbout).dot(outwards), 0.75);
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const VertexClasses classes =
      classify_vertices(mesh.positions, mesh.triangles, topology, FeatureOptions::none());
  const std::vector<Vec3> normals = initial_normals(mesh.positions, mesh.triangles, topology, classes).own;
  EXPECT_GT(normals[kAbout].dot(outwards), 0.95);
  for (Index t = 0; t < mesh.triangle_count(); ++t) EXPECT_GT(normals[t].dot(unit_normal(mesh, t)), 0) << t;
}

/// A random sphere, with noise along the radius of up to this share of the mean edge length.
TriangleMesh noisy_sphere(std::uint64_t seed, double noise) {
  TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = seed, .vertices = 600});
  double edges = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    edges += (mesh.positions[a] - mesh.positions[b]).norm() / mesh.triangle_count();
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> u(-noise * edges, noise * edges);
  for (Vec3& p : mesh.positions) p *= 1 + u(engine);
  return mesh;
}

// What noise sets upright stays a sliver for as long as it may not turn far from where it was.
TEST(TurnLimit, LetsUprightSliversLieDown) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TriangleMesh mesh = noisy_sphere(seed, 0.1);
    std::vector<Vec3> positions = mesh.positions;
    const BoundedResult result = run_bounded(
        positions, mesh.triangles, {},
        [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); }, {}, {});
    const Topology topology(mesh.triangles, mesh.vertex_count());
    const QualityReport quality = measure_quality(positions, mesh.triangles, topology);
    EXPECT_GT(quality.min_angle_deg, 12) << "seed " << seed;
    EXPECT_EQ(quality.inverted, 0U) << "seed " << seed;
    EXPECT_LE(result.deviation.max, result.deviation_limit) << "seed " << seed;
  }
}

TEST(InitialNormals, KnowWhatATriangleStandsOn) {
  const TriangleMesh mesh = noisy_sphere(1, 0.1);
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const VertexClasses classes =
      classify_vertices(mesh.positions, mesh.triangles, topology, FeatureOptions::none());
  const InitialNormals normals = initial_normals(mesh.positions, mesh.triangles, topology, classes);
  EXPECT_GE(normals.around.size(), 3U);
  for (const auto& [t, normal] : normals.around) {
    const Vec3 outwards = mesh.positions[mesh.triangles[t][0]].normalized();
    EXPECT_LT(unit_normal(mesh, t).dot(outwards), 0.6) << t;
    EXPECT_GT(normal.dot(outwards), 0.8) << t;
  }
}

TEST(SurfaceWatch, SeesATriangleThatFacesAwayWithoutAFold) {
  const TriangleMesh start = coarse_sphere();
  ProblemOptions options;
  options.features = FeatureOptions::none();
  const SmoothingProblem problem = make_problem(start.positions, start.triangles, options);
  const SurfaceWatch watch(start.positions, start.positions, problem);
  EXPECT_TRUE(watch.look(start.positions, 1).sound());
  // The corner leans over the opposite edge, so high above it that no edge turns by 150 degrees.
  const TriangleMesh moved = squeezed_sphere(-0.2, 1.3);
  ASSERT_TRUE(inverted_triangles(moved.positions, moved.triangles, problem.topology).empty());
  const auto corners = [&](const TriangleMesh& mesh) {
    const auto& [a, b, c] = mesh.triangles[kAbout];
    return std::array<Vec3, 3>{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  };
  EXPECT_FALSE(TurnLimit(problem).faces_away(kAbout, corners(start)));
  EXPECT_TRUE(TurnLimit(problem).faces_away(kAbout, corners(moved)));
  const SurfaceWatch::Finding found = watch.look(moved.positions, 1);
  EXPECT_GE(found.turned_triangles, 1U);
  for (const Index v : start.triangles[kAbout])
    EXPECT_NE(std::ranges::find(found.turned, v), found.turned.end()) << v;
}

}  // namespace
}  // namespace isorelax
