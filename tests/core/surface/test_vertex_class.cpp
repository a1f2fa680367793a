#include "surface/vertex_class.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/surface/shapes.h"
#include "mesh/angle.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

VertexClasses classify(const TriangleMesh& mesh, const FeatureOptions& options = {}) {
  return classify_vertices(mesh.positions, mesh.triangles, Topology(mesh.triangles, mesh.vertex_count()),
                           options);
}

/// How many of the three coordinates lie on the box of the mesh, to 1e-9.
unsigned box_sides(const Vec3& p, const Vec3& low, const Vec3& high) {
  unsigned sides = 0;
  for (int k = 0; k < 3; ++k)
    sides += std::min(std::abs(p[k] - low[k]), std::abs(p[k] - high[k])) < 1e-9 ? 1 : 0;
  return sides;
}

void expect_classes_of_a_cube(double jitter) {
  const TriangleMesh cube = generate(ShapeKind::cube, {.seed = 5, .triangles = 1200, .jitter = jitter});
  Vec3 low = cube.positions[0];
  Vec3 high = low;
  for (const Vec3& p : cube.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const VertexClasses found = classify(cube);
  for (Index v = 0; v < cube.vertex_count(); ++v) {
    constexpr VertexClass kExpected[] = {VertexClass::smooth, VertexClass::smooth, VertexClass::ridge,
                                         VertexClass::corner};
    EXPECT_EQ(found.classes[v], kExpected[box_sides(cube.positions[v], low, high)])
        << "vertex " << v << " of a cube with jitter " << jitter;
  }
}

TEST(VertexClasses, OfACubeAreEightCornersTwelveRidgesAndSmoothFaces) {
  expect_classes_of_a_cube(0);
  expect_classes_of_a_cube(0.4);
}

/// Two flat faces of side x side / 2 squares that meet at this turn, at x = 0.
TriangleMesh roof(Index side, double turn_deg) {
  TriangleMesh mesh = saddle(side);
  const double slope = std::tan(0.5 * turn_deg / kDegrees);
  for (Vec3& x : mesh.positions) x.z() = -slope * std::abs(x.x());
  return mesh;
}

std::size_t count_ridge(const TriangleMesh& mesh, const FeatureOptions& options = {}) {
  const VertexClasses found = classify(mesh, options);
  std::size_t count = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (found.classes[v] != VertexClass::ridge) continue;
    EXPECT_EQ(mesh.positions[v].x(), 0);
    ++count;
  }
  return count;
}

TEST(VertexClasses, MeshedFlatFacesEndInRidgesHoweverGentle) {
  EXPECT_EQ(count_ridge(roof(12, 10)), 11U);
  EXPECT_EQ(count_ridge(roof(12, 1)), 0U) << "an uneven triangle turns as far";
  EXPECT_EQ(count_ridge(roof(6, 10)), 5U) << "twice as many vertices on their rims as inside";
  EXPECT_EQ(count_ridge(roof(2, 10)), 0U) << "spanned between its corners";
  EXPECT_EQ(count_ridge(roof(12, 10), FeatureOptions::none()), 0U);
  EXPECT_EQ(count_ridge(roof(12, 1), {.ridge_angle_deg = 0.5}), 11U) << "a crease by its own threshold";
  const TriangleMesh gentle = roof(12, 10);
  const VertexClasses found = classify(gentle);
  const auto ridge = std::ranges::find(found.classes, VertexClass::ridge) - found.classes.begin();
  EXPECT_NEAR(found.margin_deg[ridge], 10 - 2, 1e-6) << "over what makes a rim a ridge";
}

TEST(VertexClasses, RidgesFromAnAngleTurnByNoLess) {
  const TriangleMesh steep = roof(2, 80);
  EXPECT_EQ(count_ridge(steep, FeatureOptions::ridges_from(60)), 1U);
  EXPECT_EQ(count_ridge(steep, FeatureOptions::ridges_from(100)), 0U);
  EXPECT_EQ(count_ridge(steep, {.ridge_angle_deg = 100}), 1U) << "a sharp edge has a threshold of its own";
  EXPECT_EQ(count_ridge(roof(12, 80), FeatureOptions::ridges_from(180)), 0U)
      << "not even those of flat faces";
}

TEST(VertexClasses, OfACylinderAreTwoCircularRidges) {
  for (const double jitter : {0.0, 0.3}) {
    const TriangleMesh cylinder = generate(ShapeKind::cylinder, {.triangles = 2000, .jitter = jitter});
    const VertexClasses found = classify(cylinder);
    double top = -1e9;
    double bottom = 1e9;
    for (const Vec3& p : cylinder.positions) top = std::max(top, p.z()), bottom = std::min(bottom, p.z());
    for (Index v = 0; v < cylinder.vertex_count(); ++v) {
      const Vec3& p = cylinder.positions[v];
      const bool end = p.z() > top - 1e-9 || p.z() < bottom + 1e-9;
      const bool rim = end && std::hypot(p.x(), p.y()) > 0.5 - 1e-6;
      EXPECT_EQ(found.classes[v], rim ? VertexClass::ridge : VertexClass::smooth)
          << "vertex " << v << " jitter " << jitter;
    }
  }
}

TEST(VertexClasses, OfAConeAreOneCornerAtTheTopAndACircularRidge) {
  const TriangleMesh cone = generate(ShapeKind::cone, {.triangles = 2000});
  const VertexClasses found = classify(cone);
  double top = -1e9;
  double bottom = 1e9;
  for (const Vec3& p : cone.positions) top = std::max(top, p.z()), bottom = std::min(bottom, p.z());
  for (Index v = 0; v < cone.vertex_count(); ++v) {
    const Vec3& p = cone.positions[v];
    VertexClass expected = VertexClass::smooth;
    // The first rings below the tip have so few vertices that the cone is a pyramid there.
    if (p.z() > 0.75 * top && p.z() < top - 1e-9) continue;
    if (p.z() > top - 1e-9) expected = VertexClass::corner;
    if (p.z() < bottom + 1e-9 && std::hypot(p.x(), p.y()) > 0.5 - 1e-6) expected = VertexClass::ridge;
    EXPECT_EQ(found.classes[v], expected) << "vertex " << v << " at " << p.transpose();
  }
}

TEST(VertexClasses, OfASphereAreSmooth) {
  const VertexClasses found = classify(generate(ShapeKind::random_sphere, {.vertices = 3000}));
  for (const VertexClass c : found.classes) EXPECT_EQ(c, VertexClass::smooth);
}

TEST(VertexClasses, RoughnessIsNoFeature) {
  TriangleMesh rough = generate(ShapeKind::sphere, {.vertices = 3000});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.982, 1.018);
  for (Vec3& p : rough.positions) p *= radius(random);
  const Topology topology(rough.triangles, rough.vertex_count());
  std::size_t steep = 0;
  for (Corner c = 0; c < 3 * rough.triangles.size(); ++c)
    steep += dihedral_turn_deg(rough.positions, rough.triangles, topology, c) > 30 ? 1 : 0;
  EXPECT_GT(steep, rough.triangles.size() / 3);
  const VertexClasses found = classify(rough);
  const auto smooth = std::count(found.classes.begin(), found.classes.end(), VertexClass::smooth);
  EXPECT_GT(static_cast<double>(smooth), 0.97 * rough.vertex_count());
}

TEST(VertexClasses, OfASquareAreItsBorderWithFourCorners) {
  const TriangleMesh square = generate(ShapeKind::random_square, {.triangles = 800});
  const VertexClasses found = classify(square);
  for (Index v = 0; v < square.vertex_count(); ++v) {
    const Vec3& p = square.positions[v];
    const unsigned sides = box_sides({p.x(), p.y(), 7}, {0, 0, 0}, {1, 1, 1});
    constexpr VertexClass kExpected[] = {VertexClass::smooth, VertexClass::boundary, VertexClass::corner};
    EXPECT_EQ(found.classes[v], kExpected[sides]) << v;
  }
}

TEST(VertexClasses, WithoutFeaturesOnlyTheBorderIsSpecial) {
  const VertexClasses found = classify(generate(ShapeKind::cube, {.triangles = 300}), FeatureOptions::none());
  for (const VertexClass c : found.classes) EXPECT_EQ(c, VertexClass::smooth);
}

TEST(VertexClasses, MarginTellsHowFarTheSpreadIsFromTheThreshold) {
  const TriangleMesh cube = generate(ShapeKind::cube, {.triangles = 1200});
  const VertexClasses found = classify(cube);
  for (Index v = 0; v < cube.vertex_count(); ++v) {
    if (found.classes[v] != VertexClass::smooth) continue;
    EXPECT_NEAR(found.spread_deg[v], 0, 1e-5);
    EXPECT_NEAR(found.margin_deg[v], FeatureOptions{}.ridge_angle_deg, 1e-5);
  }
}

}  // namespace
}  // namespace isorelax
