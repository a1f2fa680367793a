#include <gtest/gtest.h>

#include "core/motion/spheres.h"
#include "motion/runge_kutta.h"

namespace isorelax {
namespace {

/// The paper's sphere, mapped by the paper's field for a while; the map is asked in the middles of triangles.
double error_in_the_middles(std::size_t vertices) {
  const TriangleMesh mesh = paper_sphere(vertices);
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const EdgeWalls walls(3 * mesh.triangles.size(), 0);
  const MaterialSurface surface(mesh.positions, mesh.triangles, topology, walls);
  FlowMap map(surface, topology, walls, 1);
  std::vector<MaterialPoint> points;
  std::vector<Vec3> exact;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    points.push_back({t, Vec3::Constant(1.0 / 3)});
    exact.push_back(Vec3(0.5, 0.75, 0.5) +
                    0.15 * (surface.point(points.back()) - Vec3(0.5, 0.75, 0.5)).normalized());
  }
  const auto field = make_paper_field(3);
  RungeKutta integrator(*field, 1);
  std::vector<Vec3> carrier = mesh.positions;
  for (int i = 0; i < 10; ++i) {
    integrator.step(carrier, 0.03 * i, 0.03);
    integrator.step(exact, 0.03 * i, 0.03);
  }
  map.set_carrier(carrier);
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    largest = std::max(largest, (map.position(points[i]) - exact[i]).norm());
  return largest;
}

TEST(FlowMap, ItsErrorFallsAtThirdOrderOrBetter) {
  const double coarse = error_in_the_middles(500);
  const double fine = error_in_the_middles(2000);
  EXPECT_LT(coarse, 0.15 * 0.01);
  EXPECT_GT(std::log2(coarse / fine), 3);
}

TEST(FlowMap, ItsDerivativeIsThatOfItsPositions) {
  const TriangleMesh mesh = paper_sphere(200);
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const EdgeWalls walls(3 * mesh.triangles.size(), 0);
  const MaterialSurface surface(mesh.positions, mesh.triangles, topology, walls);
  FlowMap map(surface, topology, walls, 1);
  std::vector<Vec3> carrier = mesh.positions;
  for (Vec3& x : carrier) x = Vec3(x.x() * x.y(), x.y() + x.z() * x.z(), x.z());
  map.set_carrier(carrier);
  const MaterialPoint at{17, Vec3(0.5, 0.2, 0.3)};
  const MappedPoint mapped = map.map(at);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d d = kStep * Eigen::Vector2d::Unit(i);
    const Vec3 slope = (map.position(surface.walk(at, d)) - map.position(surface.walk(at, -d))) / (2 * kStep);
    EXPECT_LT((slope - mapped.jacobian.col(i)).norm(), 1e-7);
  }
}

TEST(FlowMap, PassesThroughTheCarriersVertices) {
  const TriangleMesh mesh = paper_sphere(100);
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const EdgeWalls walls(3 * mesh.triangles.size(), 0);
  const MaterialSurface surface(mesh.positions, mesh.triangles, topology, walls);
  const FlowMap map(surface, topology, walls, 1);
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    for (unsigned k = 0; k < 3; ++k)
      EXPECT_EQ(map.position({t, Vec3::Unit(k)}), mesh.positions[mesh.triangles[t][k]]);
}

}  // namespace
}  // namespace isorelax
