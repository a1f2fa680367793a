#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "app/render/render_fixtures.h"
#include "mesh/error.h"
#include "render/offscreen.h"
#include "render/renderer.h"

namespace isorelax::render {
namespace {

constexpr PictureSize kPicture{160, 120};

/// A scene of one mesh, as the editor makes it.
Scene scene_of(const TriangleMesh& mesh) {
  Scene scene;
  SceneMesh& shown = scene.meshes.emplace_back();
  shown.positions = mesh.positions;
  shown.triangles = mesh.triangles;
  return scene;
}

Color pixel(const Image& image, int x, int y) {
  const auto p = image.at(x, y);
  return {p[0], p[1], p[2]};
}

class RendererTest : public testing::Test {
 protected:
  Image draw(const Scene& scene, const Camera& camera, PictureSize size = kPicture) {
    renderer_.draw(scene, camera, size);
    return renderer_.read_back();
  }

  std::unique_ptr<OffscreenContext> context_ = OffscreenContext::create(ContextKind::osmesa);
  Renderer renderer_{context_->loader()};
};

TEST_F(RendererTest, a_flat_mesh_from_above_has_exactly_the_legends_colors) {
  TriangleMesh mesh = jittered_square(1, 0);
  const std::vector<double> values = {15, 52};
  Scene scene = scene_of(mesh);
  scene.meshes[0].face_values = values;
  scene.meshes[0].coloring.range = {0, 60};
  const Image image = draw(scene, default_camera(mesh.positions, kPicture));
  EXPECT_EQ(pixel(image, 100, 90), color_of(scene.meshes[0].coloring, 15));
  EXPECT_EQ(pixel(image, 60, 30), color_of(scene.meshes[0].coloring, 52));
}

TEST_F(RendererTest, the_background_runs_from_top_to_bottom) {
  Scene scene;
  scene.background = {{200, 0, 0}, {0, 0, 200}};
  const Image image = draw(scene, Camera());
  EXPECT_GT(pixel(image, 80, 0).red, 195);
  EXPECT_GT(pixel(image, 80, kPicture.height - 1).blue, 195);
}

TEST_F(RendererTest, pick_finds_the_triangle_its_nearest_vertex_and_the_point) {
  const TriangleMesh mesh = jittered_square(1, 0);
  const Scene scene = scene_of(mesh);
  const Camera camera = default_camera(mesh.positions, kPicture);
  const auto pick = renderer_.pick(scene, camera, kPicture, 120, 100);
  ASSERT_TRUE(pick.has_value());
  EXPECT_EQ(pick->triangle, 0U);
  EXPECT_EQ(pick->vertex, 1U);
  EXPECT_NEAR(pick->point.z(), 0, 1e-12);
  EXPECT_GT(pick->point.x(), 0.8);
  EXPECT_LT(pick->point.y(), 0.2);
  EXPECT_FALSE(renderer_.pick(scene, camera, kPicture, 2, 2).has_value());
}

TEST_F(RendererTest, pick_takes_the_front_most_triangle_in_perspective) {
  const TriangleMesh mesh = torus(24, 12);
  const Scene scene = scene_of(mesh);
  Camera camera = default_camera(mesh.positions, kPicture);
  ASSERT_EQ(camera.projection, Projection::perspective);
  const Vec3 toward_eye = axes_of(camera).toward_eye;
  int hits = 0;
  for (int x = 0; x < kPicture.width; x += 20) {
    const auto pick = renderer_.pick(scene, camera, kPicture, x, 60);
    if (!pick) continue;
    ++hits;
    const Triangle& t = mesh.triangles[pick->triangle];
    const Vec3 normal = area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    EXPECT_GT(normal.normalized().dot(toward_eye), -0.3) << "a far side was picked at x = " << x;
  }
  EXPECT_GE(hits, 3);
}

TEST_F(RendererTest, content_of_an_equal_revision_is_kept_and_of_a_new_one_taken_over) {
  TriangleMesh mesh = jittered_square(4, 0.3);
  Scene scene = scene_of(mesh);
  SceneMesh& shown = scene.meshes[0];
  shown.wire.shown = true;
  shown.positions_revision = next_revision();
  shown.triangles_revision = next_revision();
  const Camera camera = default_camera(mesh.positions, kPicture);
  const Image before = draw(scene, camera);
  mesh.positions[12] += Vec3(0.05, 0.05, 0);
  EXPECT_EQ(draw(scene, camera), before);
  shown.positions_revision = next_revision();
  EXPECT_NE(draw(scene, camera), before);
}

TEST_F(RendererTest, a_mesh_far_from_the_origin_looks_like_one_at_it) {
  const TriangleMesh mesh = jittered_square(8, 0.3);
  TriangleMesh far = mesh;
  const Vec3 offset(1 << 24, -(1 << 25), 1 << 23);
  for (Vec3& p : far.positions) p += offset;
  const Image near_picture = draw(scene_of(mesh), default_camera(mesh.positions, kPicture));
  Camera camera = default_camera(mesh.positions, kPicture);
  camera.target += offset;
  const Image far_picture = draw(scene_of(far), camera);
  std::size_t different = 0;
  for (std::size_t i = 0; i < near_picture.pixels.size(); ++i)
    different += std::abs(near_picture.pixels[i] - far_picture.pixels[i]) > 2;
  EXPECT_LE(different, near_picture.pixels.size() / 500);
}

TEST_F(RendererTest, tiny_and_huge_meshes_fill_the_picture_alike) {
  const TriangleMesh mesh = torus(16, 8);
  Scene scene = scene_of(mesh);
  const Image one = draw(scene, default_camera(mesh.positions, kPicture));
  for (const double scale : {0x1p-60, 0x1p60}) {
    TriangleMesh scaled = mesh;
    for (Vec3& p : scaled.positions) p *= scale;
    EXPECT_EQ(draw(scene_of(scaled), default_camera(scaled.positions, kPicture)), one) << scale;
  }
}

TEST_F(RendererTest, sizes_that_cannot_be_drawn_are_refused) {
  EXPECT_THROW(draw(Scene(), Camera(), {0, 10}), UsageError);
  EXPECT_THROW(draw(Scene(), Camera(), {renderer_.max_size() + 1, 10}), UsageError);
  EXPECT_THROW(draw(Scene(), Camera(), {8193, 8192}), UsageError);
}

TEST_F(RendererTest, values_must_fit_the_triangles) {
  const TriangleMesh mesh = jittered_square(1, 0);
  const std::vector<double> values = {1, 2, 3};
  Scene scene = scene_of(mesh);
  scene.meshes[0].face_values = values;
  EXPECT_THROW(draw(scene, Camera()), MeshError);
}

TEST_F(RendererTest, a_mesh_without_triangles_and_an_empty_mesh_leave_the_background) {
  TriangleMesh mesh;
  const Image nothing = draw(Scene(), Camera());
  EXPECT_EQ(draw(scene_of(mesh), default_camera(mesh.positions, kPicture)), nothing);
  mesh.positions.emplace_back(1, 2, 3);
  EXPECT_EQ(draw(scene_of(mesh), default_camera(mesh.positions, kPicture)), nothing);
}

TEST_F(RendererTest, shaders_reload_from_the_source_tree_and_a_missing_folder_changes_nothing) {
  const TriangleMesh mesh = torus(16, 8);
  const Scene scene = scene_of(mesh);
  const Camera camera = default_camera(mesh.positions, kPicture);
  const Image built_in = draw(scene, camera);
  renderer_.reload_shaders(ISORELAX_SOURCE_DIR "/shaders");
  EXPECT_EQ(draw(scene, camera), built_in);
  EXPECT_THROW(renderer_.reload_shaders("/nowhere"), Error);
  EXPECT_EQ(draw(scene, camera), built_in);
}

TEST(Offscreen, two_contexts_take_turns) {
  const TriangleMesh mesh = torus(16, 8);
  const Camera camera = default_camera(mesh.positions, kPicture);
  const auto first = OffscreenContext::create(ContextKind::osmesa);
  Renderer one(first->loader());
  one.draw(scene_of(mesh), camera, kPicture);
  const auto second = OffscreenContext::create(ContextKind::egl);
  {
    Renderer two(second->loader());
    two.draw(scene_of(mesh), camera, kPicture);
    const Image of_two = two.read_back();
    first->make_current();
    EXPECT_EQ(one.read_back(), of_two);
    second->make_current();
  }
  first->make_current();
}

}  // namespace
}  // namespace isorelax::render
