#include "surface/deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/surface/shapes.h"

namespace isorelax {
namespace {

Deviation deviation(const TriangleMesh& before, const std::vector<Vec3>& after, unsigned threads = 1) {
  return measure_deviation(before.positions, after, before.triangles,
                           Topology(before.triangles, before.vertex_count()), threads);
}

TEST(Deviation, OfAnUnmovedMeshIsNothing) {
  const TriangleMesh mesh = with_triangles(ShapeKind::part, 1000);
  const Deviation d = deviation(mesh, mesh.positions);
  EXPECT_LT(d.max, 1e-15);
  EXPECT_EQ(d.volume_change, 0);
  EXPECT_TRUE(d.has_volume);
  EXPECT_EQ(d.normal_change_deg, 0);
}

TEST(Deviation, OfALiftedSquareIsItsHeight) {
  const TriangleMesh mesh = with_triangles(ShapeKind::random_square, 400);
  std::vector<Vec3> lifted = mesh.positions;
  for (Vec3& x : lifted) x.z() += 0.01;
  const Deviation d = deviation(mesh, lifted);
  EXPECT_NEAR(d.max, 0.01 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(d.rms, 0.01 / std::sqrt(2.0), 1e-15);
  EXPECT_FALSE(d.has_volume);
  EXPECT_EQ(d.volume_change, 0);
}

TEST(Deviation, OfVerticesMovedInsideTheirPlaneIsNothing) {
  const TriangleMesh mesh = with_triangles(ShapeKind::hexagonal_square, 600, 0.3);
  std::vector<Vec3> moved = with_triangles(ShapeKind::hexagonal_square, 600, 0).positions;
  ASSERT_EQ(moved.size(), mesh.positions.size());
  EXPECT_LT(deviation(mesh, moved).max, 1e-15);
}

TEST(Deviation, OfAScaledSphereIsTheRadiusAndThreeTimesTheVolume) {
  const TriangleMesh mesh = with_vertices(ShapeKind::sphere, 2000);
  const double e = 1e-5;
  std::vector<Vec3> grown = mesh.positions;
  for (Vec3& x : grown) x *= 1 + e;
  const Deviation d = deviation(mesh, grown);
  EXPECT_NEAR(d.volume_change, 3 * e, 4 * e * e);
  EXPECT_NEAR(d.max * 2 * std::sqrt(3.0), e, 0.01 * e);  // the box of a sphere: its diameter on three sides
  EXPECT_NEAR(d.rms, d.max, 0.01 * d.max);
  EXPECT_LT(d.normal_change_deg, 1e-6);
  // A surface that faces inward encloses more all the same.
  TriangleMesh inward = mesh;
  for (Triangle& t : inward.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(deviation(inward, grown).volume_change, 3 * e, 4 * e * e);
}

TEST(Deviation, CountsBothWays) {
  // A pyramid's tip pressed into the base plane: the tip is far from the new surface by less than its height,
  // and nothing of the new surface is as far from the old one.
  const TriangleMesh mesh = {
      {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0.5}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
      {},
  };
  std::vector<Vec3> flat = mesh.positions;
  flat[4].z() = 0;
  const Deviation d = deviation(mesh, flat);
  const double diagonal = std::sqrt(4 + 4 + 0.25);
  EXPECT_NEAR(d.max_to_new, 0.5 / diagonal, 1e-12);
  EXPECT_NEAR(d.max_to_original, 0.5 / std::sqrt(1.25) / diagonal, 1e-6);  // from the centre to a slope
  EXPECT_EQ(d.max, d.max_to_new);
  EXPECT_NEAR(d.normal_change_deg, std::atan(0.5) * 180 / std::numbers::pi, 1e-9);
}

TEST(Deviation, NamesTheTrianglesThatAreFar) {
  const TriangleMesh mesh = with_triangles(ShapeKind::hexagonal_square, 600);
  std::vector<Vec3> moved = mesh.positions;
  const Topology topology(mesh.triangles, mesh.vertex_count());
  Index inner = 0;
  while ((mesh.positions[inner] - Vec3(0.5, 0.5, 0)).norm() > 0.1) ++inner;
  moved[inner].z() = 0.05;
  const DeviationByTriangle d =
      measure_deviation_by_triangle(mesh.positions, moved, mesh.triangles, topology, 1);
  EXPECT_EQ(d.whole.max, *std::max_element(d.largest.begin(), d.largest.end()));
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto& v = mesh.triangles[t];
    const bool touches = v[0] == inner || v[1] == inner || v[2] == inner;
    if (touches) {
      EXPECT_NEAR(d.largest[t], 0.05 / std::sqrt(2.0), 1e-12);
    } else {
      EXPECT_LT(d.largest[t], 1e-15);
    }
  }
}

TEST(Deviation, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = with_triangles(ShapeKind::torus, 9000);
  std::vector<Vec3> moved = mesh.positions;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-0.005, 0.005);
  for (Vec3& x : moved) x += Vec3::NullaryExpr([&] { return u(random); });
  const Deviation one = deviation(mesh, moved, 1);
  for (const unsigned threads : {2U, 5U}) {
    const Deviation other = deviation(mesh, moved, threads);
    EXPECT_EQ(one.max, other.max);
    EXPECT_EQ(one.rms, other.rms);
    EXPECT_EQ(one.volume_change, other.volume_change);
    EXPECT_EQ(one.normal_change_deg, other.normal_change_deg);
  }
}

TEST(Deviation, HasNoVolumeChangeForAnOpenSurface) {
  TriangleMesh mesh = generate(ShapeKind::cube, {});
  EXPECT_NEAR(enclosed_volume(mesh.positions, mesh.triangles), 1, 1e-12);
  mesh.triangles.pop_back();
  std::vector<Vec3> grown = mesh.positions;
  for (Vec3& x : grown) x *= 1.1;
  EXPECT_FALSE(deviation(mesh, grown).has_volume);
  EXPECT_EQ(deviation(mesh, grown).volume_change, 0);
}

TEST(EnclosesVolume, HoldsForClosedSurfacesThatAreNotFlat) {
  const auto encloses = [](const TriangleMesh& mesh) {
    return encloses_volume(mesh.positions, mesh.triangles, Topology(mesh.triangles, mesh.vertex_count()));
  };
  TriangleMesh mesh = generate(ShapeKind::cube, {});
  EXPECT_TRUE(encloses(mesh));
  TriangleMesh flat = mesh;
  for (Vec3& x : flat.positions) x.z() = 0;
  EXPECT_FALSE(encloses(flat));
  mesh.triangles.pop_back();
  EXPECT_FALSE(encloses(mesh));
  EXPECT_FALSE(encloses({}));
}

/// The same surface with its triangles turned over.
TriangleMesh turned(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

bool inward(const TriangleMesh& mesh) {
  return faces_inward(mesh.positions, mesh.triangles);
}

TEST(FacesInward, TellsASurfaceTurnedInsideOut) {
  TriangleMesh ball = with_vertices(ShapeKind::sphere, 500);
  EXPECT_FALSE(inward(ball));
  EXPECT_TRUE(inward(turned(ball)));
  ball.triangles.pop_back();
  EXPECT_FALSE(inward(ball));
  EXPECT_TRUE(inward(turned(ball))) << "a small hole";
}

TEST(FacesInward, SaysNothingOfSheetsAndOfWhatDisagreesWithItself) {
  TriangleMesh ball = turned(with_vertices(ShapeKind::sphere, 500));
  std::swap(ball.triangles[0][1], ball.triangles[0][2]);
  EXPECT_FALSE(inward(ball));
  EXPECT_FALSE(inward({}));
  for (const TriangleMesh& sheet : {saddle(6), with_triangles(ShapeKind::random_square, 400)}) {
    EXPECT_FALSE(inward(sheet));
    EXPECT_FALSE(inward(turned(sheet)));
  }
  // A dome seen from below is seen from inside.
  TriangleMesh dome = with_vertices(ShapeKind::sphere, 500);
  std::erase_if(dome.triangles, [&](const Triangle& t) { return dome.positions[t[0]].z() < 0; });
  EXPECT_FALSE(inward(turned(dome)));
}

TEST(Deviation, OfWhatRanAwayIsInfinite) {
  const TriangleMesh mesh = with_vertices(ShapeKind::sphere, 100);
  for (const double far : {1e200, static_cast<double>(INFINITY), std::nan("")}) {
    std::vector<Vec3> gone = mesh.positions;
    for (std::size_t v = 0; v < gone.size(); v += 3) gone[v].y() = far;
    EXPECT_EQ(deviation(mesh, gone).max, INFINITY) << far;
  }
}

TEST(Deviation, OfAnEmptyMeshIsNothing) {
  const Deviation d = deviation(TriangleMesh(), {});
  EXPECT_EQ(d.max, 0);
  EXPECT_FALSE(d.has_volume);
}

}  // namespace
}  // namespace isorelax
