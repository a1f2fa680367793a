#include <gtest/gtest.h>

#include "core/motion/spheres.h"
#include "surface/deviation.h"

namespace isorelax {
namespace {

TriangleMesh shaken_cube(std::size_t triangles) {
  GenerateOptions options;
  options.triangles = triangles;
  options.jitter = 0.3;
  return generate(ShapeKind::cube, options);
}

/// Largest distance of a vertex from the faces of the cube with the given middle and half side.
double distance_from_cube(std::span<const Vec3> positions, const Vec3& middle, double half) {
  double largest = 0;
  for (const Vec3& x : positions)
    largest = std::max(largest, std::abs((x - middle).cwiseAbs().maxCoeff() - half));
  return largest;
}

MovingSurface expanding(const TriangleMesh& mesh, const std::string& speed, double step) {
  MovingSurfaceOptions options = motion_preset("none");
  options.step = step;
  return {mesh, parse_motion("normal:" + speed), options};
}

TEST(FaceOffsetting, ACubeThatGrowsStaysASharpCube) {
  const TriangleMesh cube = shaken_cube(300);
  MovingSurface surface = expanding(cube, "0.5", 0.1);
  advance_to(surface, 1);
  const Vec3 middle(0.5, 0.5, 0.5);
  EXPECT_LT(distance_from_cube(cube.positions, middle, 0.5), 1e-12);
  EXPECT_LT(distance_from_cube(surface.state().positions, middle, 1), 1e-9);
  EXPECT_NEAR(enclosed_volume(surface.state().positions, cube.triangles), 8, 1e-8);
}

TEST(FaceOffsetting, ASphereThatGrowsKeepsItsCentreAndGainsRadiusAtSecondOrder) {
  std::vector<double> errors;
  for (const std::size_t vertices : {500, 2000}) {
    const TriangleMesh mesh = paper_sphere(vertices);
    MovingSurface surface = expanding(mesh, "0.1", 0.1);
    advance_to(surface, 1);
    double largest = 0;
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : surface.state().positions) {
      largest = std::max(largest, std::abs((x - Vec3(0.5, 0.75, 0.5)).norm() - 0.25));
      centre += x / static_cast<double>(vertices);
    }
    EXPECT_LT((centre - Vec3(0.5, 0.75, 0.5)).norm(), 2e-4);
    errors.push_back(largest);
  }
  EXPECT_LT(errors[0], 0.25 * 0.01);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.5);
}

TEST(FaceOffsetting, ASphereThatShrinksToNothingEndsWithTimeAndVertex) {
  const TriangleMesh mesh = paper_sphere(200);
  MovingSurface surface = expanding(mesh, "-0.1", 0.1);
  try {
    advance_to(surface, 3);
    FAIL() << "went through itself";
  } catch (const MotionError& error) {
    EXPECT_NE(std::string(error.what()).find("folds"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("vertex"), std::string::npos) << error.what();
  }
  EXPECT_LE(surface.state().time, 1.5);
  EXPECT_GT(surface.state().time, 1.2);
  EXPECT_GT(enclosed_volume(surface.state().positions, mesh.triangles), 0);
}

TEST(FaceOffsetting, AlongAFlowItAgreesWithTheVerticesOfAResolvedSurface) {
  const TriangleMesh mesh = paper_sphere(1000);
  MovingSurfaceOptions options = motion_preset("none");
  MovingSurface vertices(mesh, parse_motion("paper"), options);
  options.integration = Integration::face_offsetting;
  MovingSurface faces(mesh, parse_motion("paper"), options);
  advance_to(vertices, 0.1);
  advance_to(faces, 0.1);
  double largest = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    largest = std::max(largest, (vertices.state().positions[v] - faces.state().positions[v]).norm());
  EXPECT_LT(largest, 1e-9);
}

}  // namespace
}  // namespace isorelax
