#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generate/generate.h"
#include "mesh/error.h"
#include "mesh/validation.h"
#include "quality/report.h"

namespace isorelax {
namespace {

double volume_of(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c])) / 6;
  }
  return volume;
}

double signed_area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += area_vector(mesh.positions[a], mesh.positions[b], mesh.positions[c]).z() / 2;
  }
  return area;
}

GenerateOptions with_triangles(std::size_t triangles, std::uint64_t seed = 1) {
  GenerateOptions options;
  options.seed = seed;
  options.triangles = triangles;
  return options;
}

bool is_flat(ShapeKind kind) {
  return kind == ShapeKind::random_square || kind == ShapeKind::hexagonal_square;
}

class EveryKind : public testing::TestWithParam<ShapeKind> {};

TEST_P(EveryKind, IsSoundAtEverySizeAndJitter) {
  for (const std::size_t triangles : {4U, 12U, 100U, 3000U}) {
    for (const double jitter : {0.0, 0.5, 1.0}) {
      GenerateOptions options = with_triangles(triangles, triangles);
      options.jitter = jitter;
      const TriangleMesh mesh = generate(GetParam(), options);
      const ValidationReport r = validate(mesh);
      EXPECT_TRUE(r.manifold()) << triangles;
      EXPECT_TRUE(r.oriented) << triangles;
      EXPECT_TRUE(r.degenerate.empty()) << triangles;
      EXPECT_TRUE(r.isolated_vertices.empty()) << triangles;
      EXPECT_EQ(r.components.size(), 1U) << triangles;
      EXPECT_EQ(r.closed, !is_flat(GetParam())) << triangles;
      const bool one_handle = GetParam() == ShapeKind::torus || GetParam() == ShapeKind::part;
      EXPECT_EQ(r.genus, one_handle ? 1 : 0) << triangles;
      if (is_flat(GetParam())) {
        EXPECT_NEAR(signed_area_of(mesh), 1, 1e-12);
      } else {
        EXPECT_GT(volume_of(mesh), 0) << triangles;
      }
      EXPECT_EQ(measure_quality(mesh).inverted, 0U) << triangles << " jitter " << jitter;
    }
  }
}

TEST_P(EveryKind, IsTheSameForTheSameSeedAndComesNearTheSizeAskedFor) {
  const TriangleMesh a = generate(GetParam(), with_triangles(5000, 3));
  const TriangleMesh b = generate(GetParam(), with_triangles(5000, 3));
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_NEAR(a.triangle_count(), 5000, 500);
}

INSTANTIATE_TEST_SUITE_P(Generate, EveryKind,
                         testing::Values(ShapeKind::random_square, ShapeKind::hexagonal_square,
                                         ShapeKind::sphere, ShapeKind::random_sphere, ShapeKind::torus,
                                         ShapeKind::cube, ShapeKind::cylinder, ShapeKind::cone,
                                         ShapeKind::part));

TEST(RandomSquare, HasExactlyTheCountAskedForAndPoorTriangles) {
  for (const std::size_t count : {2U, 3U, 454U, 2126U, 10282U, 1001U}) {
    EXPECT_EQ(generate(ShapeKind::random_square, with_triangles(count)).triangle_count(), count);
  }
  GenerateOptions options;
  options.vertices = 777;
  EXPECT_EQ(generate(ShapeKind::random_square, options).vertex_count(), 777U);
  const QualityReport q = measure_quality(generate(ShapeKind::random_square, with_triangles(10282)));
  EXPECT_LT(q.min_angle_deg, 2);
  EXPECT_GT(q.max_angle_deg, 170);
  EXPECT_NEAR(q.mean_min_angle_deg, 30.7, 1);
}

TEST(HexagonalSquare, StartsAtAboutEightDegreesLikeThePaper) {
  const QualityReport q = measure_quality(generate(ShapeKind::hexagonal_square, with_triangles(11704)));
  EXPECT_NEAR(q.min_angle_deg, 8.5, 0.6);
  EXPECT_NEAR(q.mean_min_angle_deg, 38.5, 1.5);
}

TEST(Sphere, OfNVerticesHasTwiceAsManyTrianglesLessFour) {
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::random_sphere}) {
    for (const std::size_t count : {4U, 5U, 6U, 7U, 50U, 5832U}) {
      GenerateOptions options;
      options.vertices = count;
      const TriangleMesh mesh = generate(kind, options);
      EXPECT_EQ(mesh.vertex_count(), count);
      EXPECT_EQ(mesh.triangle_count(), 2 * count - 4);
      for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 1, 1e-15);
    }
  }
}

TEST(Solids, HaveTheVolumesOfTheirShapes) {
  const auto volume = [](ShapeKind kind) { return volume_of(generate(kind, with_triangles(40000))); };
  EXPECT_NEAR(volume(ShapeKind::cube), 1, 1e-12);
  EXPECT_NEAR(volume(ShapeKind::sphere) / (4 * std::numbers::pi / 3), 1, 1e-3);
  EXPECT_NEAR(volume(ShapeKind::torus) / (2 * std::numbers::pi * std::numbers::pi * 0.16), 1, 2e-3);
  EXPECT_NEAR(volume(ShapeKind::cylinder) / (std::numbers::pi / 4), 1, 1e-3);
  EXPECT_NEAR(volume(ShapeKind::cone) / (std::numbers::pi / 12), 1, 1e-3);
}

TEST(Generate, RefusesWhatCannotBe) {
  GenerateOptions both = with_triangles(100);
  both.vertices = 100;
  EXPECT_THROW(static_cast<void>(generate(ShapeKind::cube, both)), UsageError);
  GenerateOptions jitter;
  jitter.jitter = 1.5;
  EXPECT_THROW(static_cast<void>(generate(ShapeKind::cube, jitter)), UsageError);
  GenerateOptions three;
  three.vertices = 3;
  EXPECT_THROW(static_cast<void>(generate(ShapeKind::sphere, three)), UsageError);
  EXPECT_THROW(static_cast<void>(generate(ShapeKind::random_square, three)), UsageError);
  EXPECT_THROW(static_cast<void>(generate(ShapeKind::sphere, with_triangles(7))), UsageError);
}

}  // namespace
}  // namespace isorelax
