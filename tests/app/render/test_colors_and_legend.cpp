#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "mesh/error.h"
#include "render/colormap.h"
#include "render/font.h"
#include "render/legend.h"
#include "render/overlay.h"
#include "render/quantity.h"

namespace isorelax::render {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> all;
  all.reserve(ticks.size());
  for (const Tick& tick : ticks) all.push_back(tick.text);
  return all;
}

TEST(ColorMap, sequential_maps_get_brighter_all_the_way) {
  for (const ColorMap map : {ColorMap::viridis, ColorMap::cividis, ColorMap::inferno, ColorMap::magma}) {
    const auto colors = colors_of(map);
    for (std::size_t i = 8; i < colors.size(); ++i)
      EXPECT_GT(luminance(colors[i]), luminance(colors[i - 8])) << name_of(map) << " " << i;
  }
}

TEST(ColorMap, the_diverging_map_is_brightest_in_the_middle_and_alike_on_both_sides) {
  const auto colors = colors_of(ColorMap::blue_orange);
  for (std::size_t i = 0; i < 120; ++i) {
    EXPECT_LT(luminance(colors[i]), luminance(colors[i + 8])) << i;
    EXPECT_NEAR(luminance(colors[i]), luminance(colors[255 - i]), 0.12) << i;
  }
}

TEST(ColorMap, names_go_both_ways_and_an_unknown_one_is_told_the_list) {
  for (const ColorMap map : kColorMaps) EXPECT_EQ(parse_color_map(name_of(map)), map);
  try {
    parse_color_map("jet");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("viridis"), std::string::npos);
  }
}

TEST(Coloring, ends_are_the_maps_ends_and_reversal_swaps_them) {
  Coloring coloring{ColorMap::viridis, MapDirection::forward, ValueScale::linear, {10, 20}};
  EXPECT_EQ(color_of(coloring, 10), (Color{68, 1, 84}));
  EXPECT_EQ(color_of(coloring, 20), (Color{253, 231, 37}));
  coloring.direction = MapDirection::reversed;
  EXPECT_EQ(color_of(coloring, 20), (Color{68, 1, 84}));
}

TEST(Coloring, values_outside_the_range_and_missing_ones_are_grey) {
  const Coloring coloring{ColorMap::magma, MapDirection::forward, ValueScale::linear, {0, 60}};
  EXPECT_EQ(color_of(coloring, -0.1), kBelowRange);
  EXPECT_EQ(color_of(coloring, 60.1), kAboveRange);
  EXPECT_EQ(color_of(coloring, kInfinity), kAboveRange);
  EXPECT_EQ(color_of(coloring, -kInfinity), kBelowRange);
  EXPECT_EQ(color_of(coloring, kNan), kNoValue);
  EXPECT_EQ(color_of(coloring, 60 * (1 + 1e-12)), color_of(coloring, 60)) << "rounding is not outside";
}

TEST(Coloring, a_logarithmic_scale_has_its_middle_at_the_geometric_mean) {
  const Coloring coloring{ColorMap::blue_orange, MapDirection::forward, ValueScale::logarithmic, {0.25, 4}};
  EXPECT_DOUBLE_EQ(position_in_range(coloring, 1), 0.5);
  EXPECT_EQ(color_of(coloring, 0), kBelowRange);
  EXPECT_EQ(color_of(coloring, -3), kBelowRange);
  EXPECT_EQ(color_of(coloring, kInfinity), kAboveRange);
}

TEST(Coloring, a_range_of_no_width_still_has_a_color) {
  const Coloring coloring{ColorMap::viridis, MapDirection::forward, ValueScale::linear, {2, 2}};
  EXPECT_EQ(color_of(coloring, 2), color_at(coloring, 0.5));
  EXPECT_EQ(color_of(coloring, 1), kBelowRange);
  EXPECT_EQ(color_of(coloring, 3), kAboveRange);
}

TEST(Ticks, are_round_numbers_with_both_ends) {
  Coloring coloring;
  coloring.range = {0, 60};
  EXPECT_EQ(texts(legend_ticks(coloring, 7)),
            (std::vector<std::string>{"0", "10", "20", "30", "40", "50", "60"}));
  coloring.range = {0.05, 0.95};
  EXPECT_EQ(texts(legend_ticks(coloring, 6)),
            (std::vector<std::string>{"0.05", "0.20", "0.40", "0.60", "0.80", "0.95"}));
  coloring.range = {-2, 2};
  EXPECT_EQ(texts(legend_ticks(coloring, 5)), (std::vector<std::string>{"-2", "-1", "0", "1", "2"}));
}

TEST(Ticks, on_a_logarithmic_scale_are_round_too) {
  Coloring coloring;
  coloring.scale = ValueScale::logarithmic;
  coloring.range = {0.1, 10};
  EXPECT_EQ(texts(legend_ticks(coloring, 7)),
            (std::vector<std::string>{"0.1", "0.2", "0.5", "1", "2", "5", "10"}));
  coloring.range = {1, 1e9};
  EXPECT_LE(legend_ticks(coloring, 5).size(), 5U);
}

TEST(Ticks, are_few_ordered_and_apart_for_any_range) {
  const Range ranges[] = {{0, 1e-9},   {-1e9, 1e9},    {1e300, 1.5e300},     {3, 3},
                          {0, 5e-324}, {1, 1 + 1e-15}, {123456.7, 123456.8}, {1e-300, 1e300}};
  for (const ValueScale scale : {ValueScale::linear, ValueScale::logarithmic})
    for (const Range& range : ranges) {
      if (scale == ValueScale::logarithmic && range.low <= 0) continue;
      Coloring coloring;
      coloring.scale = scale;
      coloring.range = range;
      const auto ticks = legend_ticks(coloring, 6);
      ASSERT_FALSE(ticks.empty());
      EXPECT_LE(ticks.size(), 8U) << range.low << " " << range.high;
      for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_GT(ticks[i].position, ticks[i - 1].position);
    }
}

TEST(Quantity, the_brighter_end_is_the_worse_one) {
  const std::vector<double> values = {1, 59};
  const Coloring angle = default_coloring(Quantity::min_angle, values);
  EXPECT_GT(luminance(color_of(angle, 1)), luminance(color_of(angle, 59)));
  const Coloring largest = default_coloring(Quantity::max_angle, values);
  EXPECT_GT(luminance(color_of(largest, 179)), luminance(color_of(largest, 61)));
  EXPECT_EQ(make_legend(Quantity::min_angle, angle, values).low_note, "worst");
  EXPECT_EQ(make_legend(Quantity::max_angle, largest, values).high_note, "worst");
}

TEST(Quantity, areas_diverge_from_the_mean) {
  const std::vector<double> values = {0.5, 1, 8};
  const Coloring coloring = default_coloring(Quantity::area, values);
  EXPECT_DOUBLE_EQ(coloring.range.low, 0.125);
  EXPECT_DOUBLE_EQ(coloring.range.high, 8);
  EXPECT_DOUBLE_EQ(position_in_range(coloring, 1), 0.5);
}

TEST(Quantity, the_legend_shows_the_greys_that_occur) {
  const Coloring coloring{ColorMap::viridis, MapDirection::forward, ValueScale::linear, {10, 20}};
  const std::vector<double> inside = {10, 20};
  EXPECT_FALSE(make_legend(Quantity::energy, coloring, inside).shows_above);
  const std::vector<double> outside = {9, kNan, kInfinity};
  const Legend legend = make_legend(Quantity::energy, coloring, outside);
  EXPECT_TRUE(legend.shows_below && legend.shows_above && legend.shows_missing);
}

TEST(Quantity, values_without_a_finite_one_still_give_a_range) {
  const std::vector<double> values = {kNan, kInfinity, 0, -1};
  for (const Quantity q : {Quantity::min_angle, Quantity::max_angle, Quantity::area, Quantity::energy}) {
    const Coloring coloring = default_coloring(q, values);
    EXPECT_LE(coloring.range.low, coloring.range.high);
    EXPECT_FALSE(legend_ticks(coloring, 5).empty());
  }
}

TEST(Font, has_greek_and_aligned_digits) {
  Font font(20);
  for (const char32_t c : std::u32string(U"αβμΣκ°²–"))
    EXPECT_FALSE(font.glyph(c).coverage.empty()) << static_cast<unsigned>(c);
  EXPECT_DOUBLE_EQ(font.width("1111"), font.width("8888"));
  EXPECT_EQ(decode_utf8("a°\xff"), U"a°\xFFFD");
}

TEST(Overlay, the_legend_stays_inside_pictures_of_any_size) {
  Scene scene;
  scene.legend = Legend{"Min angle", "°", {}, "worst", "", true, true, true, {}};
  scene.legend->coloring.range = {0, 60};
  for (const PictureSize size : {PictureSize{320, 240}, PictureSize{400, 300}, PictureSize{4000, 3000},
                                 PictureSize{300, 1200}, PictureSize{1920, 400}}) {
    const auto overlays = make_overlays(scene, size);
    ASSERT_EQ(overlays.size(), 1U);
    const Overlay& legend = overlays[0];
    EXPECT_GE(legend.left, 0);
    EXPECT_GE(legend.top, 0);
    EXPECT_LE(legend.left + legend.bitmap.width, size.width);
    EXPECT_LE(legend.top + legend.bitmap.height, size.height);
    EXPECT_LE(legend_share(scene, size) * size.height, 0.4 * size.width) << size.width;
  }
}

TEST(Overlay, numbers_stay_whole_in_narrow_pictures) {
  Scene scene;
  scene.notes = {"Largest / least area\t1.23"};
  const auto end_of_notes = [&](PictureSize size) {
    const Overlay notes = make_overlays(scene, size).back();
    int last = 0;
    for (int y = 0; y < notes.bitmap.height; ++y)
      for (int x = 0; x < notes.bitmap.width; ++x)
        if (notes.bitmap.at(x, y)[0] > 150) last = std::max(last, notes.left + x);
    return last;
  };
  EXPECT_GT(end_of_notes({120, 200}), 90);
  EXPECT_LT(end_of_notes({120, 200}), 112);
  scene.notes.clear();
  scene.caption = "a_file_with_a_very_long_name.off";
  const Overlay caption = make_overlays(scene, {120, 200}).back();
  EXPECT_LT(caption.left + caption.bitmap.width, 120) << "it ends in an ellipsis";
  Font font(20);
  EXPECT_EQ(font.fitted("part.off", font.width("part\u2026") + 1), "part\u2026");
}

TEST(Overlay, text_on_nothing_is_legible_on_black_and_on_white) {
  Scene scene;
  scene.transparent = true;
  scene.caption = "part.off";
  const Image caption = make_overlays(scene, {1920, 1440}).back().bitmap;
  int dark = 0, light = 0;
  for (std::size_t k = 0; k < caption.pixels.size(); k += 4) {
    dark += caption.pixels[k + 3] > 230 && caption.pixels[k] < 60;
    light += caption.pixels[k + 3] > 200 && caption.pixels[k] > 180;
  }
  EXPECT_GT(dark, 50);
  EXPECT_GT(light, 50);
}

TEST(Background, is_read_from_names_and_numbers) {
  EXPECT_EQ(parse_background("white"), kWhiteBackground);
  EXPECT_EQ(parse_background("#102030").top, (Color{16, 32, 48}));
  EXPECT_EQ(parse_background("#fff"), kWhiteBackground);
  EXPECT_EQ(parse_background("1,2,3").bottom, (Color{1, 2, 3}));
  for (const char* text : {"", "whyte", "#12345", "#gg0000", "1,2", "1,2,3,4", "256,0,0", "-1,0,0", "1, 2,3"})
    EXPECT_THROW(parse_background(text), UsageError) << text;
}

}  // namespace
}  // namespace isorelax::render
