#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/spheres.h"
#include "motion/dense_copy.h"
#include "surface/deviation.h"

namespace isorelax {
namespace {

MovingSurfaceOptions preset_with_step(const char* name, double step) {
  MovingSurfaceOptions options = motion_preset(name);
  options.step = step;
  options.threads = 1;
  return options;
}

TEST(MovingSurface, RigidMotionChangesPositionsAndNothingElse) {
  const TriangleMesh mesh = paper_sphere(120);
  for (const char* preset : {"none", "paper", "accuracy", "balanced", "angles"}) {
    MovingSurface surface(mesh, parse_motion("rigid:0,0,1.57079632679489662@0.5,0.75,0.5+0.1,0,0"),
                          preset_with_step(preset, 0.1));
    advance_to(surface, 1);
    const std::vector<Vec3>& x = surface.state().positions;
    double largest = 0;
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const Triangle& v = mesh.triangles[t];
      for (unsigned k = 0; k < 3; ++k) {
        const double before = (mesh.positions[v[next(k)]] - mesh.positions[v[k]]).norm();
        largest = std::max(largest, std::abs((x[v[next(k)]] - x[v[k]]).norm() / before - 1));
      }
    }
    EXPECT_LT(largest, preset == std::string("paper") ? 1e-3 : 1e-5) << preset;
  }
}

TEST(MovingSurface, ThePapersRecipeHasThePapersEnergy) {
  // Eq. 2 with equal weights is 2 for a triangle that is its reference, and so not yet when squared.
  const TriangleMesh mesh = paper_sphere(120);
  MovingSurface surface(mesh, parse_motion("rigid:0,0,0.1@0.5,0.75,0.5+0.1,0,0"),
                        preset_with_step("paper", 0.1));
  surface.advance(1);
  const auto count = static_cast<double>(mesh.triangle_count());
  EXPECT_NEAR(surface.report().relaxation.energy_before / count, 2, 1e-3);
}

TEST(MovingSurface, TimeReversalBringsTheSphereBackAndKeepsItsVolume) {
  const TriangleMesh mesh = paper_sphere(500);
  MovingSurface surface(mesh, parse_motion("paper:0.6"), preset_with_step("balanced", 0.05));
  const double volume = enclosed_volume(mesh.positions, mesh.triangles);
  while (surface.state().time < 0.6) {
    surface.advance(0.6);
    EXPECT_NEAR(enclosed_volume(surface.state().positions, mesh.triangles) / volume, 1, 1e-9);
  }
  double largest = 0;
  for (const Vec3& x : surface.state().positions)
    largest = std::max(largest, std::abs((x - Vec3(0.5, 0.75, 0.5)).norm() - 0.15));
  EXPECT_LT(largest, 0.15 * 0.003);
}

TEST(MovingSurface, RedistributionMakesAnglesBetterAndStaysNearTheExactSurface) {
  const TriangleMesh mesh = paper_sphere(500);
  std::vector<double> means, errors;
  for (const char* preset : {"none", "balanced"}) {
    MovingSurface surface(mesh, parse_motion("paper"), preset_with_step(preset, 0.03));
    DenseCopy dense(mesh, 1, {}, 1);
    const Motion motion = parse_motion("paper");
    while (surface.state().time < 0.3) {
      const double before = surface.state().time;
      surface.advance(0.3);
      dense.advance(*motion.field, before, surface.report().dt);
    }
    means.push_back(
        measure_motion(surface.state().positions, mesh.triangles, surface.topology()).mean_angle_deg);
    errors.push_back(dense.distances(surface.state().positions, mesh.triangles).second.max);
  }
  EXPECT_GT(means[1], means[0] + 8);
  EXPECT_LT(errors[1], 0.15 * 0.05);
}

TEST(MovingSurface, AResumedRunIsTheStraightOneToTheBit) {
  const TriangleMesh mesh = paper_sphere(80);
  for (const char* preset : {"none", "paper", "balanced"}) {
    for (const bool controlled : {false, true}) {
      MovingSurfaceOptions options = preset_with_step(preset, 0.04);
      if (controlled) options.tolerance = 1e-7;
      MovingSurface straight(mesh, parse_motion("paper:0.5"), options);
      for (int i = 0; i < 3; ++i) straight.advance(0.5);
      const MovingState middle = straight.state();
      advance_to(straight, 0.5);
      MovingSurface resumed(mesh, parse_motion("paper:0.5"), options);
      resumed.restore(middle, 0.5);
      advance_to(resumed, 0.5);
      EXPECT_EQ(straight.state().positions, resumed.state().positions) << preset;
      EXPECT_EQ(straight.state().step, resumed.state().step);
    }
  }
}

TEST(MovingSurface, AStateThatIsRefusedLeavesTheOneBefore) {
  const TriangleMesh mesh = paper_sphere(80);
  const MovingSurfaceOptions options = preset_with_step("balanced", 0.04);
  MovingSurface straight(mesh, parse_motion("paper:0.5"), options);
  MovingSurface tried(mesh, parse_motion("paper:0.5"), options);
  for (int i = 0; i < 3; ++i) {
    straight.advance(0.5);
    tried.advance(0.5);
  }
  MovingState other = tried.state();
  other.step = 1;  // the time is that of step 3
  EXPECT_THROW(tried.restore(other, 0.5), MeshError);
  straight.advance(0.5);
  tried.advance(0.5);
  EXPECT_EQ(straight.state().positions, tried.state().positions);
}

TEST(MovingSurface, ThreadsDoNotMatter) {
  const TriangleMesh mesh = paper_sphere(1100);
  std::vector<std::vector<Vec3>> results;
  for (const unsigned threads : {1U, 2U}) {
    MovingSurfaceOptions options = preset_with_step("balanced", 0.05);
    options.threads = threads;
    MovingSurface surface(mesh, parse_motion("enright"), options);
    surface.advance(1);
    results.push_back(surface.state().positions);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(MovingSurface, RedistributesOnlyWhenAndWhereItIsAskedTo) {
  const TriangleMesh mesh = paper_sphere(300);
  MovingSurfaceOptions options = preset_with_step("balanced", 0.05);
  options.every = 2;
  MovingSurface surface(mesh, parse_motion("paper"), options);
  surface.advance(1);
  EXPECT_FALSE(surface.report().redistributed);
  surface.advance(1);
  EXPECT_TRUE(surface.report().redistributed);
  options.every = 1;
  options.only_below_deg = 1;
  MovingSurface idle(mesh, parse_motion("paper"), options);
  idle.advance(1);
  EXPECT_FALSE(idle.report().redistributed);
}

TEST(MovingSurface, AFieldThatBlowsUpNamesTimeAndVertexAndLeavesTheStateBefore) {
  const TriangleMesh mesh = paper_sphere(100);
  for (const char* preset : {"none", "paper", "balanced"}) {
    MovingSurface surface(mesh, parse_motion("expr:1/max(0,0.12-t);0;0"), preset_with_step(preset, 0.05));
    std::vector<Vec3> last;
    try {
      while (surface.state().time < 1) {
        last = surface.state().positions;
        surface.advance(1);
      }
      FAIL() << "went on";
    } catch (const MotionError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("at time 0.1", 0), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find("vertex 0"), std::string::npos) << error.what();
    }
    EXPECT_EQ(surface.state().positions, last);
    EXPECT_NEAR(surface.state().time, 0.1, 1e-12);
  }
}

TEST(MovingSurface, AMotionThatTakesVerticesOutOfReachEndsWithTimeAndVertex) {
  const TriangleMesh mesh = paper_sphere(100);
  // x' = 5 x^2 has no end at t = 1 / (5 x).
  double farthest = 0;
  for (const Vec3& x : mesh.positions) farthest = std::max(farthest, x.x());
  for (const char* preset : {"none", "balanced"}) {
    for (const auto& [field, controlled] :
         {std::pair("expr:x*1000;0;0", false), std::pair("expr:exp(100*t);0;0", false),
          std::pair("expr:exp(100*t);0;0", true), std::pair("expr:5*x*x;0;0", true)}) {
      MovingSurfaceOptions options = preset_with_step(preset, 0.01);
      if (controlled) options.tolerance = 1e-6;
      MovingSurface surface(mesh, parse_motion(field), options);
      std::vector<Vec3> last;
      try {
        while (surface.state().time < 1 && surface.state().step < 1000) {
          last = surface.state().positions;
          surface.advance(1);
        }
        ADD_FAILURE() << preset << " " << field << " went on";
      } catch (const MotionError& error) {
        EXPECT_NE(std::string(error.what()).find("vertex"), std::string::npos) << error.what();
      }
      EXPECT_EQ(surface.state().positions, last);
      if (field == std::string("expr:5*x*x;0;0")) {
        EXPECT_NEAR(surface.state().time, 1 / (5 * farthest), 1e-3);
      }
    }
  }
}

TEST(MovingSurface, CreasesAndBordersKeepTheirVertices) {
  GenerateOptions shape;
  shape.triangles = 300;
  const TriangleMesh cube = generate(ShapeKind::cube, shape);
  MovingSurface surface(cube, parse_motion("shear:0.5"), preset_with_step("balanced", 0.1));
  advance_to(surface, 0.4);
  // A sheared cube: vertices stay on its planes, volume is kept.
  double largest = 0;
  for (const Vec3& x : surface.state().positions) {
    const Vec3 back(x.x() - 0.4 * 0.5 * x.y(), x.y(), x.z());
    largest = std::max(largest, std::abs((back - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() - 0.5));
  }
  EXPECT_LT(largest, 1e-9);
}

TEST(MovingSurface, RefusesWhatItCannotCarry) {
  TriangleMesh mesh = paper_sphere(50);
  EXPECT_THROW(MovingSurface(mesh, parse_motion("paper"), preset_with_step("balanced", 0)), UsageError);
  MovingSurfaceOptions options = motion_preset("balanced");
  options.reference = MeshReference{std::vector<Vec3>(3, Vec3::Zero())};
  EXPECT_THROW(MovingSurface(mesh, parse_motion("paper"), options), MeshError);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_THROW(MovingSurface(mesh, parse_motion("normal:0.1"), motion_preset("none")), MeshError);
  EXPECT_NO_THROW(MovingSurface(mesh, parse_motion("paper"), motion_preset("none")));
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  mesh.positions.emplace_back(0, 0, 0);
  EXPECT_THROW(MovingSurface(mesh, parse_motion("paper"), motion_preset("balanced")), MeshError);
}

TEST(MovingSurface, OnAMeshWithCreasesTheOthersAreRedistributedAndMeasured) {
  const TriangleMesh cube = generate(ShapeKind::cube, {.seed = 1, .triangles = 500, .jitter = 0.3});
  const char* const bending = "expr:0.5*y*y;0.3*sin(3*x);0";
  MovingSurface without(cube, parse_motion(bending), preset_with_step("none", 0.1));
  MovingSurface with(cube, parse_motion(bending), preset_with_step("balanced", 0.1));
  advance_to(without, 0.5);
  advance_to(with, 0.5);
  std::size_t moved = 0;
  for (Index v = 0; v < cube.vertex_count(); ++v)
    moved += (with.state().positions[v] - without.state().positions[v]).norm() > 1e-6 ? 1 : 0;
  EXPECT_GT(2 * moved, cube.vertex_count());
  // Flat faces that stay where they are stay flat.
  MovingSurface still(cube, parse_motion("rigid:0,0,0"), preset_with_step("balanced", 0.1));
  advance_to(still, 0.3);
  EXPECT_LT(still.report().deviation.max, 1e-12);
}

TEST(DenseCopy, FollowsTheFlatFacesOfACube) {
  const TriangleMesh cube = generate(ShapeKind::cube, {.seed = 1, .triangles = 200});
  const auto [there, back] = DenseCopy(cube, 2, {}, 1).distances(cube.positions, cube.triangles);
  EXPECT_LT(std::max(there.max, back.max), 1e-12);
}

}  // namespace
}  // namespace isorelax
