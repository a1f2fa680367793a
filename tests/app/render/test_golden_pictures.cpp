// Accepted pictures, and proof that each of them would notice.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/render/render_fixtures.h"
#include "support/golden.h"
#include "view/picture.h"

namespace isorelax::view {
namespace {

using namespace render;
using test::matches_baseline;
using test::passes_for_baseline;

enum class Solid { square, torus };

struct Golden {
  const char* name;
  Solid solid = Solid::torus;
  ColorBy color = ColorBy::min_angle;
  Shading shading = Shading::flat;
  bool wire = false;
  Background background = kWhiteBackground;
};

const Golden kGoldens[] = {
    {.name = "torus_angle", .color = ColorBy::min_angle},
    {.name = "torus_max_angle", .color = ColorBy::max_angle},
    {.name = "torus_area", .color = ColorBy::area},
    {.name = "torus_energy", .color = ColorBy::energy},
    {.name = "torus_none", .color = ColorBy::none},
    {.name = "torus_angle_smooth", .color = ColorBy::min_angle, .shading = Shading::smooth},
    {.name = "torus_none_smooth_wire_dark",
     .color = ColorBy::none,
     .shading = Shading::smooth,
     .wire = true,
     .background = kDarkBackground},
    {.name = "square_angle_wire", .solid = Solid::square, .color = ColorBy::min_angle, .wire = true},
};

TriangleMesh mesh_of(const Golden& golden) {
  return golden.solid == Solid::square ? jittered_square(8, 0.3) : uneven_torus(24, 12);
}

View view_of(const Golden& golden) {
  View view;
  view.color = golden.color;
  view.energy = {1, 0, "equilateral"};
  view.size = {320, 240};
  view.shading = golden.shading;
  view.wire = golden.wire;
  view.background = golden.background;
  return view;
}

Image picture_of(const TriangleMesh& mesh, const View& view) {
  static Studio studio;
  return studio.draw(view, {{&mesh}}).image;
}

class GoldenPicture : public testing::TestWithParam<Golden> {
 protected:
  /// Whether the accepted picture passes for the given one.
  static bool passes(const Image& picture) { return passes_for_baseline(picture, GetParam().name); }
};

/// Those with a colour map and a legend.
class ColoredGoldenPicture : public GoldenPicture {};

TEST_P(GoldenPicture, is_the_accepted_one) {
  const Golden& golden = GetParam();
  EXPECT_TRUE(matches_baseline(picture_of(mesh_of(golden), view_of(golden)), golden.name));
}

TEST_P(GoldenPicture, notices_another_camera_by_one_degree) {
  const Golden& golden = GetParam();
  const TriangleMesh mesh = mesh_of(golden);
  View view = resolve(view_of(golden), {{&mesh}});
  std::get<Camera>(view.camera).azimuth_deg += 1;
  EXPECT_FALSE(passes(picture_of(mesh, view)));
}

TEST_P(GoldenPicture, notices_one_vertex_moved_by_a_tenth_of_an_edge) {
  const Golden& golden = GetParam();
  TriangleMesh mesh = mesh_of(golden);
  const CameraAxes axes = axes_of(default_camera(mesh.positions, {320, 240}));
  Index nearest = 40;  // on the square all are as near
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if ((mesh.positions[v] - mesh.positions[nearest]).dot(axes.toward_eye) > 1e-9) nearest = v;
  const Triangle* touching = nullptr;
  for (const Triangle& t : mesh.triangles)
    if (std::ranges::find(t, nearest) != t.end()) touching = &t;
  ASSERT_NE(touching, nullptr);
  const double edge = (mesh.positions[(*touching)[0]] - mesh.positions[(*touching)[1]]).norm();
  mesh.positions[nearest] += 0.1 * edge * axes.right;
  EXPECT_FALSE(passes(picture_of(mesh, view_of(golden))));
}

TEST_P(ColoredGoldenPicture, notices_another_color_map) {
  const Golden& golden = GetParam();
  View view = view_of(golden);
  view.color_map = ColorMap::cividis;
  EXPECT_FALSE(passes(picture_of(mesh_of(golden), view)));
}

TEST_P(ColoredGoldenPicture, notices_a_missing_legend) {
  const Golden& golden = GetParam();
  const TriangleMesh mesh = mesh_of(golden);
  View view = resolve(view_of(golden), {{&mesh}});
  view.legend = false;  // the mesh stays where it was
  EXPECT_FALSE(passes(picture_of(mesh, view)));
}

TEST_P(GoldenPicture, refuses_another_size) {
  const Golden& golden = GetParam();
  View view = view_of(golden);
  view.size = {321, 240};
  EXPECT_FALSE(passes(picture_of(mesh_of(golden), view)));
}

std::vector<Golden> colored_goldens() {
  std::vector<Golden> colored;
  std::ranges::copy_if(kGoldens, std::back_inserter(colored),
                       [](const Golden& g) { return g.color != ColorBy::none; });
  return colored;
}

std::string test_name(const testing::TestParamInfo<Golden>& golden) {
  return golden.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPicture, testing::ValuesIn(kGoldens), test_name);
INSTANTIATE_TEST_SUITE_P(All, ColoredGoldenPicture, testing::ValuesIn(colored_goldens()), test_name);

std::filesystem::path left_behind(const std::string& file) {
  return std::filesystem::path(ISORELAX_BINARY_DIR) / "image_failures" / file;
}

TEST(Baseline, a_missing_one_fails_and_leaves_the_actual_picture) {
  Image picture(8, 8);
  std::ranges::fill(picture.pixels, std::uint8_t{200});
  EXPECT_FALSE(matches_baseline(picture, "never_accepted"));
  EXPECT_EQ(read_png(left_behind("never_accepted.actual.png")), picture);
  std::filesystem::remove(left_behind("never_accepted.actual.png"));
}

TEST(Baseline, one_that_differs_fails_with_its_figures_and_leaves_all_three_pictures) {
  const std::string name = kGoldens[0].name;
  const Image accepted = test::read_baseline(name);
  Image other = accepted;
  for (int x = 0; x < 40; ++x) other.at(x, 10)[0] = 0;
  const auto result = matches_baseline(other, name);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("BROKEN"), std::string::npos) << result.message();
  EXPECT_EQ(read_png(left_behind(name + ".actual.png")), other);
  EXPECT_EQ(read_png(left_behind(name + ".expected.png")), accepted);
  const Image difference = read_png(left_behind(name + ".difference.png"));
  EXPECT_GT(difference.at(20, 10)[0], difference.at(20, 100)[0]);
  EXPECT_TRUE(matches_baseline(accepted, name));
  EXPECT_FALSE(std::filesystem::exists(left_behind(name + ".actual.png"))) << "success tidies up";
}

}  // namespace
}  // namespace isorelax::view
