// Accepted pictures, and proof that each of them would notice.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/render/render_fixtures.h"
#include "render/picture.h"
#include "support/image_compare.h"

namespace isorelax::render {
namespace {

using test::compare_images;
using test::ImageLimits;
using test::matches_baseline;
using test::read_baseline;

enum class Solid { square, torus };

struct Golden {
  const char* name;
  Solid solid = Solid::torus;
  std::optional<Quantity> quantity;
  Shading shading = Shading::flat;
  bool wire = false;
  Background background = kWhiteBackground;
};

const Golden kGoldens[] = {
    {.name = "torus_angle", .quantity = Quantity::min_angle},
    {.name = "torus_max_angle", .quantity = Quantity::max_angle},
    {.name = "torus_area", .quantity = Quantity::area},
    {.name = "torus_energy", .quantity = Quantity::energy},
    {.name = "torus_none", .quantity = {}},
    {.name = "torus_angle_smooth", .quantity = Quantity::min_angle, .shading = Shading::smooth},
    {.name = "torus_none_smooth_wire_dark",
     .quantity = {},
     .shading = Shading::smooth,
     .wire = true,
     .background = kDarkBackground},
    {.name = "square_angle_wire", .solid = Solid::square, .quantity = Quantity::min_angle, .wire = true},
};

TriangleMesh mesh_of(const Golden& golden) {
  return golden.solid == Solid::square ? jittered_square(8, 0.3) : uneven_torus(24, 12);
}

std::vector<double> values_of(const Golden& golden, const TriangleMesh& mesh) {
  if (!golden.quantity) return {};
  switch (*golden.quantity) {
    case Quantity::min_angle:
      return min_angles(mesh);
    case Quantity::max_angle:
      return max_angles(mesh);
    case Quantity::area:
      return relative_areas(mesh);
    case Quantity::energy:
      break;
  }
  return shape_energies(mesh);
}

PictureOptions options_of(const Golden& golden) {
  PictureOptions options;
  options.size = {320, 240};
  options.shading = golden.shading;
  options.wire = golden.wire;
  options.background = golden.background;
  return options;
}

Image picture_of(const Golden& golden, const TriangleMesh& mesh, const PictureOptions& options) {
  const std::vector<double> values = values_of(golden, mesh);
  if (!golden.quantity) return render_picture(mesh, {}, options);
  return render_picture(mesh, FaceColors{*golden.quantity, values}, options);
}

class GoldenPicture : public testing::TestWithParam<Golden> {
 protected:
  /// Whether the accepted picture passes for the given one.
  static bool passes(const Image& picture) {
    const ImageLimits limits;
    return compare_images(picture, read_baseline(GetParam().name), limits).within(limits);
  }
};

/// Those with a colour map and a legend.
class ColoredGoldenPicture : public GoldenPicture {};

TEST_P(GoldenPicture, is_the_accepted_one) {
  const Golden& golden = GetParam();
  EXPECT_TRUE(matches_baseline(picture_of(golden, mesh_of(golden), options_of(golden)), golden.name));
}

TEST_P(GoldenPicture, notices_another_camera_by_one_degree) {
  const Golden& golden = GetParam();
  PictureOptions options = options_of(golden);
  options.camera = golden.solid == Solid::square ? "1,90:z-up" : "31,20";
  EXPECT_FALSE(passes(picture_of(golden, mesh_of(golden), options)));
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
  EXPECT_FALSE(passes(picture_of(golden, mesh, options_of(golden))));
}

TEST_P(ColoredGoldenPicture, notices_another_color_map) {
  const Golden& golden = GetParam();
  PictureOptions options = options_of(golden);
  options.color_map = ColorMap::cividis;
  EXPECT_FALSE(passes(picture_of(golden, mesh_of(golden), options)));
}

TEST_P(ColoredGoldenPicture, notices_a_missing_legend) {
  const Golden& golden = GetParam();
  const TriangleMesh mesh = mesh_of(golden);
  const std::vector<double> values = values_of(golden, mesh);
  // The legend alone: the mesh stays where it was.
  PictureOptions options = options_of(golden);
  Image picture = picture_of(golden, mesh, options);
  const Image white = render_picture(TriangleMesh(), {}, options);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 242; x < picture.width; ++x) std::ranges::copy(white.at(x, y), picture.at(x, y).begin());
  EXPECT_FALSE(passes(picture));
  options.legend = false;
  EXPECT_FALSE(passes(picture_of(golden, mesh, options)));
}

TEST_P(GoldenPicture, refuses_another_size) {
  const Golden& golden = GetParam();
  PictureOptions options = options_of(golden);
  options.size = {321, 240};
  EXPECT_FALSE(passes(picture_of(golden, mesh_of(golden), options)));
}

std::vector<Golden> colored_goldens() {
  std::vector<Golden> colored;
  std::ranges::copy_if(kGoldens, std::back_inserter(colored),
                       [](const Golden& g) { return g.quantity.has_value(); });
  return colored;
}

std::string test_name(const testing::TestParamInfo<Golden>& golden) {
  return golden.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPicture, testing::ValuesIn(kGoldens), test_name);
INSTANTIATE_TEST_SUITE_P(All, ColoredGoldenPicture, testing::ValuesIn(colored_goldens()), test_name);

TEST(Baseline, a_missing_one_fails_and_leaves_the_actual_picture) {
  Image picture(8, 8);
  std::ranges::fill(picture.pixels, std::uint8_t{200});
  const auto result = matches_baseline(picture, "never_accepted");
  EXPECT_FALSE(result);
  const std::filesystem::path left =
      std::filesystem::path(ISORELAX_BINARY_DIR) / "image_failures" / "never_accepted.actual.png";
  EXPECT_EQ(read_png(left), picture);
  std::filesystem::remove(left);
}

}  // namespace
}  // namespace isorelax::render
