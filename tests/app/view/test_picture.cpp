// What pictures of views show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/render/render_fixtures.h"
#include "app/temporary_mesh.h"
#include "mesh/error.h"
#include "view/measures.h"
#include "view/picture.h"
#include "view/scene.h"

namespace isorelax::view {
namespace {

using render::Image;

/// One triangle in the xy plane with its corners moved to the right.
TriangleMesh triangle(double right = 0) {
  TriangleMesh mesh;
  mesh.positions = {{right, 0, 0}, {right + 1, 0, 0}, {right, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

View small_view() {
  View view;
  view.size = {240, 180};
  view.background = render::kWhiteBackground;
  return view;
}

Image part(const Image& image, int left, int top, int width, int height) {
  Image cut(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::ranges::copy(image.at(left + x, top + y), cut.at(x, y).begin());
  return cut;
}

std::size_t count_pixels(const Image& image,
                         const std::function<bool(std::span<const std::uint8_t, 4>)>& is) {
  std::size_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += is(image.at(x, y));
  return count;
}

class PictureTest : public testing::Test {
 protected:
  static Image draw(const View& view, std::vector<const TriangleMesh*> meshes,
                    const TriangleMesh* against = nullptr) {
    static Studio studio;
    return studio.draw(view, {std::move(meshes), against}).image;
  }
  const TriangleMesh torus_ = render::uneven_torus(24, 12);
};

TEST_F(PictureTest, osmesa_and_egl_give_the_same_bytes_as_often_as_one_draws) {
  View view = small_view();
  view.wire = true;
  for (const render::Shading shading : {render::Shading::flat, render::Shading::smooth}) {
    view.shading = shading;
    const Image first = draw(view, {&torus_});
    EXPECT_EQ(draw(view, {&torus_}), first);
    Studio egl(render::ContextKind::egl);
    EXPECT_EQ(egl.draw(view, {{&torus_}}).image, first);
  }
}

TEST_F(PictureTest, the_view_that_a_picture_comes_with_makes_it_again) {
  Studio studio;
  for (const char* camera : {"fit", "iso:orthographic", "front", "-20,80,3:z-up"}) {
    View view = small_view();
    view.camera = camera;
    view.color = ColorBy::area;
    view.range.rule = RangeRule::current;
    view.boundary = true;
    view.numbers = true;
    const Picture first = studio.draw(view, {{&torus_}});
    const View again = parse_view(to_json(first.view), "text");
    const Picture second = studio.draw(again, {{&torus_}});
    EXPECT_EQ(second.image, first.image) << camera;
    EXPECT_EQ(to_json(second.view), to_json(first.view));
  }
}

TEST_F(PictureTest, meshes_stand_side_by_side_under_one_camera_and_one_range) {
  View view = small_view();
  view.legend = false;
  view.size = {400, 180};
  const TriangleMesh left = triangle();
  TriangleMesh right = triangle();
  right.positions[2] = {0, 0.2, 0};
  const Image both = draw(view, {&left, &right});
  const Image same = draw(view, {&left, &left});
  EXPECT_EQ(part(both, 0, 0, 200, 180), part(same, 0, 0, 200, 180));
  EXPECT_EQ(part(same, 0, 0, 200, 180), part(same, 200, 0, 200, 180));
  EXPECT_FALSE(part(both, 200, 0, 200, 180) == part(both, 0, 0, 200, 180));
  // The range is fitted to both: alone, each would be in the middle of its own.
  view.range.rule = RangeRule::current;
  const View fixed = resolve(view, {{&left, &right}});
  EXPECT_NEAR(fixed.range.ends.low, std::atan(0.2) * 180 / M_PI, 1e-9);
  EXPECT_NEAR(fixed.range.ends.high, 45, 1e-9);
}

TEST_F(PictureTest, a_mesh_that_faces_inward_shows_its_quality_like_any_other) {
  TriangleMesh turned = torus_;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  const View view = small_view();
  EXPECT_EQ(draw(view, {&turned}), draw(view, {&torus_}));
}

TEST_F(PictureTest, the_legend_names_the_red_of_what_lies_upside_down) {
  const std::vector<double> values{10, 20};
  View view;
  const render::Coloring coloring = coloring_of(view, values);
  EXPECT_FALSE(legend_of(view, coloring, values).shows_backs);
  EXPECT_TRUE(legend_of(view, coloring, values, 1).shows_backs);
  view.only_worse_than = 15;
  EXPECT_FALSE(legend_of(view, coloring, values, 1).shows_backs) << "backs between what is left are no fault";
}

TEST_F(PictureTest, a_planar_mesh_looks_the_same_whichever_way_all_its_triangles_run) {
  TriangleMesh square;
  square.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0.4, 0}};
  square.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  TriangleMesh turned = square;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  View view = small_view();
  for (const char* camera : {"fit", "20,-30:perspective"}) {
    view.camera = camera;
    EXPECT_EQ(draw(view, {&turned}), draw(view, {&square})) << camera;
    TriangleMesh mixed = turned;
    std::swap(mixed.triangles[0][1], mixed.triangles[0][2]);
    EXPECT_FALSE(draw(view, {&mixed}) == draw(view, {&square})) << camera << ": one lies against the others";
  }
}

TEST_F(PictureTest, meshes_of_extreme_size_have_the_colours_of_ordinary_ones) {
  View view = small_view();
  for (const ColorBy color : {ColorBy::min_angle, ColorBy::area, ColorBy::energy}) {
    view.color = color;
    const auto wanted = measure(color, view.energy, torus_.positions, torus_.triangles);
    for (const int exponent : {500, -500}) {
      TriangleMesh resized = torus_;
      for (Vec3& p : resized.positions) p *= std::ldexp(1, exponent);
      EXPECT_EQ(measure(color, view.energy, resized.positions, resized.triangles), wanted) << exponent;
    }
  }
}

TEST_F(PictureTest, values_outside_the_range_are_grey) {
  View view = small_view();
  view.range = {RangeRule::ends, {50, 60}};
  view.legend = false;
  const TriangleMesh mesh = triangle();
  const render::Color grey = render::kBelowRange;
  EXPECT_GT(count_pixels(draw(view, {&mesh}),
                         [&](auto p) { return p[0] == grey.red && p[1] == grey.green && p[2] == grey.blue; }),
            3000U);
}

TEST_F(PictureTest, only_triangles_that_are_worse_are_drawn) {
  View view = small_view();
  view.legend = false;
  const auto drawn = [&](double limit) {
    view.only_worse_than = limit;
    const Image image = part(draw(view, {&torus_}), 0, 30, 240, 150);  // below the line that counts them
    return count_pixels(image, [](auto p) { return p[0] != 255 || p[1] != 255 || p[2] != 255; });
  };
  EXPECT_EQ(drawn(0), 0U);
  const std::size_t some = drawn(35);
  EXPECT_GT(some, 50U);
  EXPECT_LT(some, drawn(61));
  view.color = ColorBy::none;
  EXPECT_THROW((void)drawn(20), UsageError);
}

TEST(Filter, means_the_bad_end_of_each_quantity) {
  View view;
  view.only_worse_than = 30;
  EXPECT_TRUE(is_worse(view, 29));
  EXPECT_FALSE(is_worse(view, 31));
  view.color = ColorBy::max_angle;
  EXPECT_TRUE(is_worse(view, 31));
  view.color = ColorBy::area;
  EXPECT_TRUE(is_worse(view, 31));
  EXPECT_TRUE(is_worse(view, 1.0 / 31));
  EXPECT_FALSE(is_worse(view, 1.0 / 29));
  view.difference = true;
  view.color = ColorBy::min_angle;
  EXPECT_TRUE(is_worse(view, -31));
  EXPECT_FALSE(is_worse(view, 31));
}

TEST_F(PictureTest, a_transparent_background_is_transparent_and_the_mesh_is_not) {
  View view = small_view();
  const Image opaque = draw(view, {&torus_});
  view.transparent = true;
  const Image image = draw(view, {&torus_});
  EXPECT_EQ(image.at(0, 0)[3], 0);
  EXPECT_EQ(count_pixels(opaque, [](auto p) { return p[3] != 255; }), 0U);
  std::size_t same = 0, covered = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < 150; ++x) {
      if (image.at(x, y)[3] != 255) continue;
      ++covered;
      same += std::ranges::equal(image.at(x, y), opaque.at(x, y));
    }
  EXPECT_GT(covered, 4000U);
  EXPECT_EQ(same, covered);
  // Laid over white it is the opaque picture, rounding apart.
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < 150; ++x) {
      const auto p = image.at(x, y);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR((p[k] * p[3] + 255 * (255 - p[3])) / 255.0, opaque.at(x, y)[k], 2.5);
    }
}

TEST_F(PictureTest, supersampling_keeps_size_text_and_place_and_smooths_edges) {
  View view = small_view();
  const Image plain = draw(view, {&torus_});
  view.supersampling = 3;
  const Image fine = draw(view, {&torus_});
  ASSERT_EQ(fine.width, plain.width);
  EXPECT_FALSE(fine == plain);
  double sum = 0;
  for (std::size_t i = 0; i < fine.pixels.size(); ++i) sum += std::abs(fine.pixels[i] - plain.pixels[i]);
  EXPECT_LT(sum / static_cast<double>(fine.pixels.size()), 4);
  EXPECT_EQ(part(fine, 200, 60, 40, 60), part(plain, 200, 60, 40, 60)) << "the legend";
  view.size = {8192, 8192};
  EXPECT_THROW((void)draw(view, {&torus_}), UsageError);
}

TEST_F(PictureTest, arrows_lead_from_where_vertices_were) {
  View view = small_view();
  view.color = ColorBy::none;
  view.arrows = true;
  view.camera = "top:orthographic";
  TriangleMesh moved = triangle();
  moved.positions[0] += Vec3(0.5, 0.4, 0);
  const TriangleMesh start = triangle();
  const auto is_red = [](auto p) { return p[0] > 180 && p[1] < 90 && p[2] < 100; };
  const std::size_t one = count_pixels(draw(view, {&moved}, &start), is_red);
  EXPECT_GT(one, 20U);
  EXPECT_EQ(count_pixels(draw(view, {&start}, &start), is_red), 0U);
  view.arrow_scale = 0.3;
  EXPECT_LT(count_pixels(draw(view, {&moved}, &start), is_red), one);
  EXPECT_THROW((void)draw(view, {&moved}), UsageError);
  EXPECT_THROW((void)draw(view, {&moved}, &torus_), MeshError);
}

TEST_F(PictureTest, differences_have_the_colour_of_no_change_where_nothing_changed) {
  View view = small_view();
  view.difference = true;
  view.legend = false;
  view.camera = "top:orthographic";
  const TriangleMesh start = triangle();
  const render::Color middle = render::color_at({render::ColorMap::blue_orange, {}, {}, {}}, 0.5);
  const auto is_middle = [&](auto p) {
    return p[0] == middle.red && p[1] == middle.green && p[2] == middle.blue;
  };
  EXPECT_GT(count_pixels(draw(view, {&start}, &start), is_middle), 3000U);
  TriangleMesh worse = start;
  worse.positions[2] = {0, 0.5, 0};
  TriangleMesh better = start;
  better.positions[2] = {0.5, 0.87, 0};
  const auto orange = [](auto p) { return p[0] > p[2] + 40; };
  const auto blue = [](auto p) { return p[2] > p[0] + 40; };
  EXPECT_GT(count_pixels(draw(view, {&worse}, &start), orange), 1000U);
  EXPECT_GT(count_pixels(draw(view, {&better}, &start), blue), 1000U);
  view.color = ColorBy::energy;  // here more is worse
  EXPECT_GT(count_pixels(draw(view, {&worse}, &start), orange), 1000U);
}

TEST_F(PictureTest, classes_show_corners_and_borders) {
  View view = small_view();
  view.color = ColorBy::classes;
  view.legend = false;
  view.points = 1.5;  // lines wide enough to show their own colour
  const TriangleMesh mesh = render::jittered_square(4, 0.2);
  const Image image = draw(view, {&mesh});
  const auto near = [](render::Color c) {
    return [c](auto p) {
      return std::abs(p[0] - c.red) + std::abs(p[1] - c.green) + std::abs(p[2] - c.blue) < 60;
    };
  };
  EXPECT_GT(count_pixels(image, near(kBorderColor)), 200U);
  EXPECT_GT(count_pixels(image, near(kCornerColor)), 20U);
  EXPECT_LT(count_pixels(image, near(kCornerColor)), 800U);
}

TEST_F(PictureTest, numbers_and_labels_are_seen_when_asked_for) {
  View view = small_view();
  const Image plain = draw(view, {&torus_});
  view.numbers = true;
  const Image numbers = draw(view, {&torus_});
  EXPECT_FALSE(part(numbers, 0, 0, 120, 60) == part(plain, 0, 0, 120, 60));
  view.numbers = false;
  view.labels = {"label"};
  const Image labelled = draw(view, {&torus_});
  EXPECT_FALSE(part(labelled, 0, 150, 120, 30) == part(plain, 0, 150, 120, 30));
  EXPECT_EQ(part(labelled, 0, 0, 120, 60), part(plain, 0, 0, 120, 60));
}

TEST(Measures, energies_are_those_of_the_terms_and_references_asked_for) {
  const TriangleMesh mesh = triangle();
  const auto energy = [&](const EnergyTerms& terms) {
    return measure(ColorBy::energy, terms, mesh.positions, mesh.triangles).at(0);
  };
  EXPECT_NEAR(energy({1, 0, "equilateral"}), 4 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(energy({0, 1, "equilateral"}), 2, 1e-12);
  EXPECT_NEAR(energy({0.5, 2, "equilateral:1"}),
              2 / std::sqrt(3.0) + 2 * (std::sqrt(std::sqrt(0.75)) + 1 / std::sqrt(std::sqrt(0.75))), 1e-12);
  EXPECT_THROW((void)energy({1, 0, "equilateral:x"}), UsageError);
  const test::TemporaryFolder folder;
  (void)write_mesh(folder / "t.off", mesh);
  EXPECT_NEAR(energy({1, 0, (folder / "t.off").string()}), 2, 1e-12);
  (void)write_mesh(folder / "torus.off", render::torus(8, 6));
  EXPECT_THROW((void)energy({1, 0, (folder / "torus.off").string()}), MeshError);
}

}  // namespace
}  // namespace isorelax::view
