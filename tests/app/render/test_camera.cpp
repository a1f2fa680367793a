#include <gtest/gtest.h>

#include <glm/vec4.hpp>
#include <string>

#include "app/render/render_fixtures.h"
#include "mesh/error.h"
#include "render/camera.h"

namespace isorelax::render {
namespace {

constexpr PictureSize kSize{400, 300};

/// Pixel coordinates, y downwards, of a point of the world.
Eigen::Vector2d pixel_of(const Camera& camera, PictureSize size, const Vec3& point) {
  const Bounds bounds{camera.target - Vec3::Constant(camera.extent),
                      camera.target + Vec3::Constant(camera.extent)};
  const MeshFrame frame{camera.target, camera.extent};
  const Vec3 local = (point - frame.origin) / frame.scale;
  const glm::vec4 clip = view_projection(camera, size, frame, bounds) *
                         glm::vec4(static_cast<float>(local.x()), static_cast<float>(local.y()),
                                   static_cast<float>(local.z()), 1.0F);
  return {0.5 * (1 + clip.x / clip.w) * size.width, 0.5 * (1 - clip.y / clip.w) * size.height};
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " is not " << b.transpose();
}

TEST(Camera, axes_are_those_of_the_convention) {
  Camera camera;
  expect_near(axes_of(camera).right, Vec3::UnitX());
  expect_near(axes_of(camera).up, Vec3::UnitY());
  expect_near(axes_of(camera).toward_eye, Vec3::UnitZ());
  camera.up = UpAxis::z;
  expect_near(axes_of(camera).right, Vec3::UnitX());
  expect_near(axes_of(camera).up, Vec3::UnitZ());
  expect_near(axes_of(camera).toward_eye, -Vec3::UnitY());
  expect_near(axes_of(look_from(camera, NamedView::right)).toward_eye, Vec3::UnitX());
  expect_near(axes_of(look_from(camera, NamedView::left)).toward_eye, -Vec3::UnitX());
  expect_near(axes_of(look_from(camera, NamedView::back)).toward_eye, Vec3::UnitY());
  expect_near(axes_of(look_from(camera, NamedView::top)).toward_eye, Vec3::UnitZ());
  expect_near(axes_of(look_from(camera, NamedView::bottom)).toward_eye, -Vec3::UnitZ());
}

TEST(Camera, axes_are_right_handed_from_everywhere) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z})
    for (double azimuth = -170; azimuth < 180; azimuth += 35)
      for (double elevation = -90; elevation <= 90; elevation += 30) {
        Camera camera;
        camera.up = up;
        camera.azimuth_deg = azimuth;
        camera.elevation_deg = elevation;
        const CameraAxes axes = axes_of(camera);
        expect_near(axes.right.cross(axes.up), axes.toward_eye);
      }
}

TEST(Camera, extent_is_what_the_shorter_side_shows_in_both_projections) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera;
    camera.projection = projection;
    camera.extent = 2;
    EXPECT_NEAR(pixel_of(camera, {400, 300}, Vec3(0, 1, 0)).y(), 0, 1e-3);
    EXPECT_NEAR(pixel_of(camera, {300, 400}, Vec3(1, 0, 0)).x(), 300, 1e-3);
  }
}

TEST(Camera, nearer_things_look_larger_in_perspective_only) {
  Camera camera;
  const auto width = [&](double z) {
    return pixel_of(camera, kSize, Vec3(0.5, 0, z)).x() - pixel_of(camera, kSize, Vec3(-0.5, 0, z)).x();
  };
  EXPECT_GT(width(0.5), width(-0.5) + 1);
  camera.projection = Projection::orthographic;
  EXPECT_NEAR(width(0.5), width(-0.5), 1e-3);
}

TEST(Camera, pan_moves_the_target_with_the_pointer) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera;
    camera.projection = projection;
    camera.azimuth_deg = 40;
    camera.elevation_deg = 25;
    const Camera moved = pan(camera, 30, -12, kSize);
    const Eigen::Vector2d at = pixel_of(moved, kSize, camera.target);
    EXPECT_NEAR(at.x(), 230, 1e-2);
    EXPECT_NEAR(at.y(), 138, 1e-2);
  }
}

TEST(Camera, zoom_keeps_what_is_under_the_pointer) {
  Camera camera;
  camera.azimuth_deg = -20;
  const CameraAxes axes = axes_of(camera);
  const Vec3 point = camera.target + 0.3 * axes.right - 0.2 * axes.up;
  const Eigen::Vector2d before = pixel_of(camera, kSize, point);
  const Camera zoomed = zoom_to(camera, 3, before.x(), before.y(), kSize);
  EXPECT_DOUBLE_EQ(zoomed.extent, camera.extent / 3);
  EXPECT_LT((pixel_of(zoomed, kSize, point) - before).norm(), 1e-2);
}

TEST(Camera, orbit_stops_at_the_poles_and_keeps_azimuth_readable) {
  Camera camera = orbit(Camera(), 0, 1e6, kSize);
  EXPECT_DOUBLE_EQ(camera.elevation_deg, 90);
  for (int i = 0; i < 100; ++i) camera = orbit(camera, 123, 0, kSize);
  EXPECT_LE(std::abs(camera.azimuth_deg), 180);
  EXPECT_LT(orbit(Camera(), 10, 0, kSize).azimuth_deg, 0) << "the object follows the pointer";
}

TEST(Fit, keeps_clear_of_what_is_laid_over_the_top_and_the_bottom) {
  const TriangleMesh mesh = torus(40, 20);
  FitOptions options;
  options.top = 0.2;
  options.bottom = 0.1;
  for (const PictureSize size : {PictureSize{400, 300}, PictureSize{300, 400}, PictureSize{900, 200}})
    for (const char* view : {"fit", "front", "top", "iso:orthographic"}) {
      const Camera camera = parse_camera(view, mesh.positions, size, options);
      const double margin = options.margin * std::min(size.width, size.height);
      for (const Vec3& p : mesh.positions) {
        const Eigen::Vector2d at = pixel_of(camera, size, p);
        EXPECT_GT(at.y(), margin + 0.2 * size.height - 0.1) << view;
        EXPECT_LT(at.y(), size.height - margin - 0.1 * size.height + 0.1) << view;
      }
    }
}

TEST(Fit, every_vertex_is_in_the_free_part_and_some_touch_it) {
  const TriangleMesh mesh = torus(40, 20);
  FitOptions options;
  options.right = 0.2;
  for (const PictureSize size : {PictureSize{400, 300}, PictureSize{300, 400}, PictureSize{900, 200}})
    for (const char* view : {"fit", "front", "top", "iso", "70,-40:orthographic"}) {
      const Camera camera = parse_camera(view, mesh.positions, size, options);
      const double margin = options.margin * std::min(size.width, size.height);
      Eigen::Vector2d low(1e9, 1e9);
      Eigen::Vector2d high(-1e9, -1e9);
      for (const Vec3& p : mesh.positions) {
        low = low.cwiseMin(pixel_of(camera, size, p));
        high = high.cwiseMax(pixel_of(camera, size, p));
      }
      const double right = size.width - margin - options.right * size.height;
      EXPECT_GT(low.x(), margin - 0.1) << view;
      EXPECT_LT(high.x(), right + 0.1) << view;
      EXPECT_GT(low.y(), margin - 0.1) << view;
      EXPECT_LT(high.y(), size.height - margin + 0.1) << view;
      const double slack =
          std::min({low.x() - margin, right - high.x(), low.y() - margin, size.height - margin - high.y()});
      EXPECT_LT(slack, 1.5) << view << " wastes room";
      EXPECT_NEAR(0.5 * (low.y() + high.y()), 0.5 * size.height, 1.0) << view;
    }
}

TEST(Fit, points_lines_and_nothing_get_a_finite_camera) {
  const std::vector<std::vector<Vec3>> sets = {
      {}, {Vec3(1, 2, 3)}, {Vec3(0, 0, 0), Vec3(0, 0, 5)}, {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}};
  for (const auto& points : sets)
    for (const char* view : {"fit", "front", "top:orthographic"}) {
      const Camera camera = parse_camera(view, points, kSize);
      EXPECT_TRUE(std::isfinite(camera.extent) && camera.extent > 0) << points.size() << view;
      EXPECT_TRUE(camera.target.allFinite()) << points.size() << view;
    }
}

TEST(DefaultCamera, a_mesh_in_the_xy_plane_is_seen_from_above_with_x_to_the_right) {
  TriangleMesh mesh = jittered_square(4, 0.2);
  for (Vec3& p : mesh.positions) p.z() = 7;
  const Camera camera = default_camera(mesh.positions, kSize);
  EXPECT_EQ(camera.projection, Projection::orthographic);
  expect_near(axes_of(camera).right, Vec3::UnitX());
  expect_near(axes_of(camera).up, Vec3::UnitY());
}

TEST(DefaultCamera, any_other_plane_is_looked_at_along_its_normal) {
  const Vec3 normal = Vec3(1, 2, 2) / 3;
  const Vec3 u = Vec3(2, 1, -2) / 3;
  const Vec3 v = normal.cross(u);
  TriangleMesh mesh = jittered_square(4, 0.2);
  for (Vec3& p : mesh.positions) p = Vec3(5, 6, 7) + p.x() * u + p.y() * v;
  const Camera camera = default_camera(mesh.positions, kSize);
  EXPECT_EQ(camera.projection, Projection::orthographic);
  expect_near(axes_of(camera).toward_eye, normal, 1e-6);
}

TEST(DefaultCamera, a_solid_is_seen_in_perspective_and_a_flat_one_has_z_up) {
  const TriangleMesh lying = torus(24, 12);
  EXPECT_EQ(default_camera(lying.positions, kSize).projection, Projection::perspective);
  EXPECT_EQ(default_camera(lying.positions, kSize).up, UpAxis::z);
  TriangleMesh standing = lying;
  for (Vec3& p : standing.positions) p = Vec3(p.y(), p.z(), p.x());
  EXPECT_EQ(default_camera(standing.positions, kSize).up, UpAxis::y);
}

TEST(ParseCamera, reads_views_angles_and_options) {
  const TriangleMesh mesh = torus(24, 12);
  const Camera camera = parse_camera("30,-15:y-up:orthographic:zoom=2", mesh.positions, kSize);
  EXPECT_DOUBLE_EQ(camera.azimuth_deg, 30);
  EXPECT_DOUBLE_EQ(camera.elevation_deg, -15);
  EXPECT_EQ(camera.up, UpAxis::y);
  EXPECT_EQ(camera.projection, Projection::orthographic);
  EXPECT_DOUBLE_EQ(2 * camera.extent, parse_camera("30,-15:y-up:orthographic", mesh.positions, kSize).extent);
  EXPECT_EQ(parse_camera("30,20,4", mesh.positions, kSize),
            parse_camera("30,20:zoom=4", mesh.positions, kSize));
  EXPECT_EQ(parse_camera("fit", mesh.positions, kSize), default_camera(mesh.positions, kSize));
}

TEST(ParseCamera, names_what_is_wrong) {
  for (const char* text :
       {"", "frnt", "30", "30,", "30,91", "nan,0", "30,20,", "30,20,0", "30,20,1,1", ",",
        "front:", "front:upside", "front:zoom=", "front:zoom=0", "front:zoom=-1", ":front"}) {
    try {
      parse_camera(text, {}, kSize);
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace isorelax::render
