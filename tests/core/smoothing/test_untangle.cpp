#include "smoothing/untangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generate/generate.h"
#include "generate/random.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"
#include "smoothing/minimise.h"
#include "smoothing/pins.h"
#include "smoothing/regularised_energy.h"

namespace isorelax {
namespace {

/// Triangles that turn clockwise seen from above, or have no area: counted without the code under test.
std::size_t upside_down(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    const double twice_area = (q.x() - p.x()) * (r.y() - p.y()) - (r.x() - p.x()) * (q.y() - p.y());
    count += twice_area > 0 ? 0 : 1;
  }
  return count;
}

BoundedResult smooth(TriangleMesh& mesh, const ProblemOptions& options = {}, unsigned iterations = 20,
                     const DeviationLimit& limit = {}) {
  return run_bounded(
      mesh.positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::newton); },
      {.iterations = iterations}, limit);
}

/// The square without what is nearer to (0.4, 0.6) than 0.2 and without its quarter at the upper right.
TriangleMesh with_hole_and_notch(TriangleMesh mesh) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
    return (middle - Vec3(0.4, 0.6, 0)).norm() < 0.2 || (middle.x() > 0.6 && middle.y() < 0.5);
  });
  return mesh;
}

TEST(Untangle, TurnsAllTrianglesOfTangledSquares) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::hexagonal_square}) {
    for (const double share : {0.05, 0.2, 0.5, 1.0}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        TriangleMesh mesh = generate(kind, {.seed = seed, .triangles = 500, .tangle = share});
        ASSERT_GT(upside_down(mesh), 5U);
        const BoundedResult result = smooth(mesh);
        EXPECT_EQ(upside_down(mesh), 0U) << share << " seed " << seed;
        EXPECT_EQ(result.untangled.after, 0U);
        EXPECT_GT(measure_quality(mesh).min_angle_deg, 12);
      }
    }
  }
}

TEST(Untangle, TurnsAllTrianglesOfALargeSquare) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 5, .triangles = 10000, .tangle = 0.5});
  ASSERT_GT(upside_down(mesh), 3000U);
  const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
  EXPECT_EQ(upside_down(mesh), 0U);
  EXPECT_EQ(result.after, 0U);
}

TEST(Untangle, TurnsTrianglesWithinAnOutlineThatIsNotConvex) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TriangleMesh sound =
        with_hole_and_notch(generate(ShapeKind::random_square, {.seed = seed, .triangles = 1200}));
    TriangleMesh mesh = sound;
    const Topology topology(mesh.triangles, mesh.vertex_count());
    const TriangleMesh thrown =
        generate(ShapeKind::random_square, {.seed = seed, .triangles = 1200, .tangle = 0.5});
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (topology.flags(v) == 0) mesh.positions[v] = thrown.positions[v];
    ASSERT_GT(upside_down(mesh), 100U);
    untangle_input(mesh.positions, mesh.triangles, {});
    EXPECT_EQ(upside_down(mesh), 0U) << seed;
  }
}

TEST(Untangle, LeavesWhatIsFarFromAFoldAlone) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 2000});
  const TriangleMesh sound = mesh;
  const Topology topology(mesh.triangles, mesh.vertex_count());
  Index thrown = 0;
  while (topology.flags(thrown) != 0 || (mesh.positions[thrown] - Vec3(0.5, 0.5, 0)).norm() > 0.05) ++thrown;
  mesh.positions[thrown] += Vec3(0.1, 0.02, 0);
  ASSERT_GT(upside_down(mesh), 0U);
  const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
  EXPECT_EQ(upside_down(mesh), 0U);
  EXPECT_LE(result.moved.size(), 7U);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const bool moved = std::binary_search(result.moved.begin(), result.moved.end(), v);
    if (!moved) {
      EXPECT_EQ(mesh.positions[v], sound.positions[v]);
    }
  }
}

TEST(Untangle, PinnedVerticesAndTheBorderStay) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 2, .triangles = 800, .tangle = 0.2});
  const TriangleMesh input = mesh;
  const Topology topology(mesh.triangles, mesh.vertex_count());
  ProblemOptions options;
  for (Index v = 0; v < mesh.vertex_count(); v += 3) options.pinned.push_back(v);
  const BoundedResult result = smooth(mesh, options);
  EXPECT_LE(upside_down(mesh), upside_down(input));
  EXPECT_EQ(result.untangled.after, upside_down(mesh));
  for (const Index v : options.pinned) EXPECT_EQ(mesh.positions[v], input.positions[v]);
  for (const Index v : boundary_vertices(topology)) EXPECT_EQ(mesh.positions[v], input.positions[v]);
}

/// Triangles of a sphere about the origin that face inward.
std::size_t facing_inward(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 area = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    count += area.dot(mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) > 0 ? 0 : 1;
  }
  return count;
}

TEST(Untangle, TurnsTrianglesOfASphereAndStaysOnIt) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    TriangleMesh mesh = generate(ShapeKind::sphere, {.seed = seed, .vertices = 800});
    Random random(seed);
    for (Vec3& p : mesh.positions) {
      const Vec3 throw_by(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      if (random.uniform() < 0.05) p = (p + 0.3 * throw_by).normalized();
    }
    ASSERT_GT(facing_inward(mesh), 20U);
    const BoundedResult result = smooth(mesh);
    EXPECT_EQ(facing_inward(mesh), 0U) << seed;
    EXPECT_EQ(result.untangled.after, 0U);
    for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 1, 0.01);
  }
}

TEST(Untangle, WhatGetsOnlyLessTangledGetsNoWorse) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    TriangleMesh mesh = generate(ShapeKind::sphere, {.seed = seed, .vertices = 2000});
    Random random(seed);
    for (Vec3& p : mesh.positions)
      if (random.uniform() < 0.1)
        p = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const double before = measure_quality(mesh).min_angle_deg;
    const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
    EXPECT_TRUE(result.after == 0 || measure_quality(mesh).min_angle_deg >= before) << seed;
  }
}

/// How many coordinates of a point are at an end of 0 .. 1: of a cube's faces that it is on.
unsigned faces_at(const Vec3& p) {
  unsigned count = 0;
  for (unsigned k = 0; k < 3; ++k) count += p[k] == 0 || p[k] == 1 ? 1 : 0;
  return count;
}

TEST(Untangle, FlatFacesInTheirOwnPlanes) {
  TriangleMesh cube = generate(ShapeKind::cube, {.triangles = 1200});
  Vec3 low = cube.positions[0];
  for (const Vec3& p : cube.positions) low = low.cwiseMin(p);
  for (Vec3& p : cube.positions) p -= low;
  for (const double share : {0.02, 0.2, 0.5}) {
    TriangleMesh mesh = cube;
    Random random(1);
    for (Vec3& p : mesh.positions) {
      if (faces_at(p) != 1 || !(random.uniform() < share)) continue;
      for (unsigned k = 0; k < 3; ++k)
        if (p[k] != 0 && p[k] != 1) p[k] = random.uniform(0.01, 0.99);
    }
    const TriangleMesh tangled = mesh;
    const BoundedResult result = smooth(mesh);
    EXPECT_GT(result.untangled.before, 10U);
    EXPECT_EQ(result.untangled.after, 0U) << share;
    EXPECT_GT(measure_quality(mesh).min_angle_deg, 20) << share;
    EXPECT_LT(result.deviation.max, 1e-12);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 &from = tangled.positions[v], &to = mesh.positions[v];
      EXPECT_TRUE(faces_at(from) < 3 || to == from) << v;
      for (unsigned k = 0; k < 3; ++k) EXPECT_TRUE(from[k] != 0 || std::abs(to[k]) < 1e-12) << v;
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
      const Vec3 area = area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
      EXPECT_GT(area.dot(middle - Vec3::Constant(0.5)), 0);
    }
  }
}

TEST(Untangle, OneVertexThatLiesAmongOthersIsPutBack) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    TriangleMesh mesh = generate(ShapeKind::sphere, {.seed = seed, .vertices = 1500});
    Vec3& thrown = mesh.positions[100 * seed];
    thrown = (thrown + 0.25 * thrown.unitOrthogonal()).normalized();
    ASSERT_GT(facing_inward(mesh), 0U);
    const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
    EXPECT_EQ(facing_inward(mesh), 0U) << seed;
    EXPECT_LE(result.moved.size(), 10U);
    for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 1, 1e-3);
  }
}

TEST(Untangle, OneFoldThatStandsOutOfTheSurfaceIsItsOwn) {
  // A spike that is bent over: some of its triangles lie over others, a good way above them. That the bent
  // one's edges are long makes it no nearer.
  for (const auto& [height, bent] : {std::pair{0.07, 0.3}, std::pair{0.072, 0.8}}) {
    TriangleMesh mesh = generate(ShapeKind::sphere, {.seed = 1, .vertices = 1500});
    Vec3& tip = mesh.positions[300];
    tip = (1 + height) * (tip + bent * tip.unitOrthogonal()).normalized();
    const TriangleMesh input = mesh;
    const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
    EXPECT_GT(result.before, 0U);
    EXPECT_EQ(result.after, result.before);
    EXPECT_EQ(mesh.positions, input.positions) << height;
  }
}

TEST(Untangle, SliversThatItLeavesDoNotHoldTheirVertices) {
  TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 3, .vertices = 1500});
  Random random(3);
  const double edge = 2 * std::sqrt(3.14 / 1500);
  for (Vec3& p : mesh.positions) {
    const Vec3 throw_by(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (random.uniform() < 0.2) p = (p + 1.5 * edge * throw_by.normalized()).normalized();
  }
  run_bounded(mesh.positions, mesh.triangles, {},
              [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
              {.iterations = 100}, {});
  EXPECT_EQ(facing_inward(mesh), 0U);
  EXPECT_GT(measure_quality(mesh).min_angle_deg, 15);
}

TEST(Untangle, SoundSurfacesAreLeftAlone) {
  for (const ShapeKind kind : {ShapeKind::part, ShapeKind::cone, ShapeKind::torus}) {
    TriangleMesh mesh = generate(kind, {.triangles = 1000});
    const UntangleResult result = untangle_input(mesh.positions, mesh.triangles, {});
    EXPECT_EQ(result.before, 0U);
    EXPECT_TRUE(result.moved.empty());
  }
}

TEST(Untangle, DoesNotDependOnThreads) {
  const TriangleMesh input =
      generate(ShapeKind::random_square, {.seed = 4, .triangles = 5000, .tangle = 0.3});
  TriangleMesh one = input, five = input;
  untangle_input(one.positions, one.triangles, {.threads = 1});
  untangle_input(five.positions, five.triangles, {.threads = 5});
  EXPECT_EQ(one.positions, five.positions);
}

TEST(Untangle, OffLeavesTheTrianglesAsTheyAre) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 500, .tangle = 0.05});
  const TriangleMesh input = mesh;
  const std::size_t before = upside_down(mesh);
  const BoundedResult result = smooth(mesh, {.untangle = UntangleRule::off});
  EXPECT_EQ(result.untangled.before, 0U);
  EXPECT_EQ(upside_down(mesh), before);
  for (const Index t :
       inverted_triangles(input.positions, input.triangles, Topology(input.triangles, input.vertex_count())))
    for (const Index v : input.triangles[t]) EXPECT_EQ(mesh.positions[v], input.positions[v]);
}

TEST(Untangle, AStatedLimitIsKeptAndSaidToPreventIt) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 100});
  const Topology topology(mesh.triangles, mesh.vertex_count());
  Index thrown = 0;
  while (topology.flags(thrown) != 0) ++thrown;
  mesh.positions[thrown] = Vec3(2, 2, 0);  // far outside: what it covers there goes with it
  const TriangleMesh input = mesh;
  const BoundedResult held = smooth(mesh, {}, 5, {0.01});
  EXPECT_EQ(mesh.positions[thrown], input.positions[thrown]);
  EXPECT_LE(held.deviation.max, 0.01);
  ASSERT_FALSE(held.notes.empty());
  EXPECT_NE(held.notes.front().find("not done"), std::string::npos) << held.notes.front();
  smooth(mesh);
  EXPECT_EQ(upside_down(mesh), 0U);
}

TEST(RegularisedEnergy, GradientIsThatOfTheValueOnFoldedTrianglesToo) {
  const TriangleMesh mesh = generate(ShapeKind::random_square, {.seed = 3, .triangles = 60, .tangle = 0.5});
  const Topology topology(mesh.triangles, mesh.vertex_count());
  std::vector<Index> free;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (topology.flags(v) == 0) free.push_back(v);
  const std::vector<Vec3> normals(mesh.triangles.size(), Vec3::UnitZ());
  RegularisedEnergy energy(mesh.positions, mesh.triangles, topology, normals, free, 1.0 / 60, 1);
  energy.set_epsilon(0.3);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.dimension());
  Eigen::VectorXd gradient(x.size()), ignored(x.size());
  energy(x, gradient);
  ASSERT_LT(energy.worst_determinant(x), -0.1);
  const Eigen::VectorXd direction = Eigen::VectorXd::LinSpaced(x.size(), -1, 1);
  const double h = 1e-6;
  const double slope = (energy(x + h * direction, ignored) - energy(x - h * direction, ignored)) / (2 * h);
  EXPECT_NEAR(slope, gradient.dot(direction), 1e-6 * std::abs(slope));
}

TEST(Minimise, FindsTheMinimumOfACurvedValley) {
  const DifferentiableFunction valley = [](const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    const double a = 1 - x[0], b = x[1] - x[0] * x[0];
    g[0] = -2 * a - 400 * x[0] * b;
    g[1] = 200 * b;
    return a * a + 100 * b * b;
  };
  Eigen::VectorXd x(2);
  x << -1.2, 1;
  Eigen::VectorXd downhill = x;
  EXPECT_LT(minimise(valley, x, {.iterations = 200, .tolerance = 0}), 1e-12);
  EXPECT_NEAR(x[0], 1, 1e-6);
  EXPECT_NEAR(x[1], 1, 1e-6);
  EXPECT_LT(minimise(valley, downhill, {.iterations = 200, .memory = 0, .tolerance = 0}), 5);
}

}  // namespace
}  // namespace isorelax
