#include <gtest/gtest.h>

#include <algorithm>

#include "render/overlay.h"
#include "view/panels.h"

namespace isorelax::view {
namespace {

TEST(Panels, a_single_mesh_has_the_whole_picture) {
  const Panels panels = arrange({640, 480}, 1, 100);
  EXPECT_EQ(panels.cell, (render::PictureSize{640, 480}));
  EXPECT_EQ(panels.strip, 0);
}

TEST(Panels, cells_and_legend_share_the_width_and_rows_come_when_cells_get_narrow) {
  const Panels two = arrange({1000, 400}, 2, 99);
  EXPECT_EQ(two.rows, 1);
  EXPECT_EQ(two.cell, (render::PictureSize{450, 400}));
  EXPECT_EQ(two.strip, 100);
  const Panels four = arrange({500, 500}, 4, 0);
  EXPECT_EQ(four.rows, 2);
  EXPECT_EQ(four.cell, (render::PictureSize{250, 250}));
}

TEST(Panels, every_count_and_size_fits) {
  for (const int side : {1, 7, 100, 1001})
    for (std::size_t count = 1; count < 20; ++count) {
      const Panels panels = arrange({side, 300}, count, 50);
      EXPECT_GE(static_cast<std::size_t>(panels.rows * panels.columns), count);
      EXPECT_LE(panels.rows * panels.cell.height, 300);
      EXPECT_GE(panels.cell.width, 1);
    }
}

TEST(Overlay, the_legend_leaves_the_top_to_what_a_host_lays_there) {
  render::Scene scene;
  scene.legend.emplace().coloring.range = {0, 60};
  scene.pixels_per_point = 1;
  const render::PictureSize size{300, 300};
  const int middle = render::make_overlays(scene, size).front().top;
  scene.legend_top = middle - 1;
  EXPECT_EQ(render::make_overlays(scene, size).front().top, middle);
  scene.legend_top = middle + 10;
  EXPECT_EQ(render::make_overlays(scene, size).front().top, middle + 10);
  scene.legend_top = 1000;
  const render::Overlay lowest = render::make_overlays(scene, size).front();
  EXPECT_LE(lowest.top + lowest.bitmap.height, size.height);
}

TEST(Overlay, text_covers_what_is_behind_it_and_only_that) {
  render::Scene scene;
  scene.caption = "Text";
  scene.pixels_per_point = 1;
  render::Image picture(200, 100);
  std::ranges::fill(picture.pixels, std::uint8_t{100});
  render::Image clear(200, 100);
  overlay(scene, picture);
  scene.transparent = true;
  overlay(scene, clear);
  EXPECT_EQ(picture.at(199, 0)[0], 100);
  const auto bright = [](const render::Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) count += image.at(x, y)[0] > 200;
    return count;
  };
  EXPECT_GT(bright(picture), 20);
  // Straight alpha: the ink keeps its colour where it covers little.
  EXPECT_GT(bright(clear), bright(picture));
}

}  // namespace
}  // namespace isorelax::view
