// How far apart pictures are: figures against plain second computations, limits each on its own.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "compare/flip.h"
#include "compare/image_metrics.h"
#include "compare/ssim.h"
#include "mesh/error.h"

namespace isorelax::compare {
namespace {

using render::Image;

Image filled(int width, int height, std::uint8_t value) {
  Image image(width, height);
  std::ranges::fill(image.pixels, value);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

/// Smooth stripes and a disk: something for every measure to hold on to.
Image scene(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool inside = std::hypot(x - 0.5 * width, y - 0.5 * height) < 0.3 * height;
      const auto p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(127 + 100 * std::sin(0.2 * x));
      p[1] = static_cast<std::uint8_t>(inside ? 220 : 60 + y % 50);
      p[2] = static_cast<std::uint8_t>(127 + 100 * std::cos(0.15 * (x + y)));
      p[3] = 255;
    }
  return image;
}

/// Which limits do not hold.
std::vector<std::string> broken(const Image& a, const Image& b, const ImageLimits& limits = {}) {
  std::vector<std::string> names;
  for (const Verdict& v : judge(compare_images(a, b, limits.tolerance).figures, limits))
    if (!v.holds) names.push_back(v.name);
  return names;
}

ImageLimits allowing_all() {
  return {.tolerance = 255,
          .share_beyond = 1,
          .largest = 255,
          .mean_ssim = -1,
          .worst_tile_ssim = -1,
          .flip_mean = 1,
          .flip_p99 = 1};
}

TEST(ImageFigures, of_equal_pictures_are_perfect) {
  const ImageFigures figures = compare_images(scene(70, 50), scene(70, 50), 0).figures;
  EXPECT_TRUE(figures.is_equal());
  EXPECT_EQ(figures.pixels, 3500U);
  EXPECT_EQ(figures.largest, 0);
  EXPECT_EQ(figures.share_beyond, 0);
  EXPECT_EQ(figures.mean_ssim, 1);
  EXPECT_EQ(figures.worst_tile_ssim, 1);
  EXPECT_EQ(figures.flip_mean, 0);
  EXPECT_EQ(figures.flip_p99, 0);
  EXPECT_TRUE(broken(scene(70, 50), scene(70, 50)).empty());
}

TEST(ImageFigures, count_pixels_beyond_the_tolerance_and_find_the_largest_difference) {
  const Image a = filled(50, 40, 100);
  Image b = a;
  b.at(3, 4)[1] = 105;
  b.at(5, 6)[2] = 92;
  b.at(7, 8)[3] = 254;
  const ImageFigures figures = compare_images(a, b, 5).figures;
  EXPECT_EQ(figures.equal_pixels, 1997U);
  EXPECT_EQ(figures.largest, 8);
  EXPECT_DOUBLE_EQ(figures.share_beyond, 1.0 / 2000);
}

TEST(ImageFigures, other_sizes_are_refused_by_name) {
  try {
    (void)compare_images(filled(4, 5, 0), filled(5, 4, 0), 0);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("4x5 and 5x4"), std::string::npos) << error.what();
  }
}

TEST(ImageFigures, do_not_depend_on_how_the_picture_is_cut_into_bands) {
  // Taller than a band; what differs lies across the seam of two.
  const Image a = filled(512, 1100, 90);
  Image b = a;
  for (int y = 1016; y < 1032; ++y)
    for (int x = 100; x < 116; ++x) b.at(x, y)[1] = 220;
  Image a_part(512, 96), b_part(512, 96);
  std::copy_n(a.pixels.begin() + 4 * 512 * 976, a_part.pixels.size(), a_part.pixels.begin());
  std::copy_n(b.pixels.begin() + 4 * 512 * 976, b_part.pixels.size(), b_part.pixels.begin());
  const ImageFigures whole = compare_images(a, b, 0).figures;
  const ImageFigures part = compare_images(a_part, b_part, 0).figures;
  EXPECT_NEAR(whole.flip_mean * 1100, part.flip_mean * 96, 1e-6);
  EXPECT_NEAR((1 - whole.mean_ssim) * 1100, (1 - part.mean_ssim) * 96, 1e-4);
  EXPECT_EQ(whole.worst_tile_x, part.worst_tile_x);
  EXPECT_EQ(whole.worst_tile_y, part.worst_tile_y + 976);
}

TEST(Ssim, is_that_of_the_definition) {
  // One pixel in the middle, by sums over the 11 x 11 window.
  Plane a(31, 31), b(31, 31);
  std::mt19937 random(5);
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    a.values[i] = static_cast<float>(random() % 256);
    b.values[i] = static_cast<float>(random() % 256);
  }
  double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (int y = -5; y <= 5; ++y)
    for (int x = -5; x <= 5; ++x) {
      const double w = std::exp(-(x * x + y * y) / (2 * 1.5 * 1.5));
      const double p = a.row(15 + y)[15 + x], q = b.row(15 + y)[15 + x];
      weights += w, ma += w * p, mb += w * q, aa += w * p * p, bb += w * q * q, ab += w * p * q;
    }
  ma /= weights, mb /= weights;
  const double va = aa / weights - ma * ma, vb = bb / weights - mb * mb, cov = ab / weights - ma * mb;
  const double c1 = 6.5025, c2 = 58.5225;
  const double expected = (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  EXPECT_NEAR(structural_similarity(a, b).row(15)[15], expected, 1e-4);
  for (const float s : structural_similarity(a, a).values) EXPECT_NEAR(s, 1, 1e-4);
}

TEST(Flip, is_nothing_for_equal_one_for_opposite_and_the_same_both_ways) {
  const Image black = filled(40, 40, 0);
  const Image white = filled(40, 40, 255);
  for (const float v : flip_difference(white, white)) EXPECT_EQ(v, 0);
  const std::vector<float> most = flip_difference(black, white);
  EXPECT_NEAR(most[20 * 40 + 20], 0.96738, 1e-4) << "lightness 100: beyond the knee of the scale";
  const Image a = scene(60, 50);
  Image b = a;
  for (int y = 10; y < 20; ++y) b.at(30, y)[0] = 0;
  const std::vector<float> ab = flip_difference(a, b);
  const std::vector<float> ba = flip_difference(b, a);
  for (std::size_t i = 0; i < ab.size(); ++i) EXPECT_NEAR(ab[i], ba[i], 1e-6);
}

TEST(Flip, grows_with_the_difference_and_stays_near_it) {
  const Image a = filled(80, 80, 120);
  double last = 0;
  for (const int step : {4, 16, 64}) {
    Image b = a;
    for (int y = 36; y < 44; ++y)
      for (int x = 36; x < 44; ++x) b.at(x, y)[1] = static_cast<std::uint8_t>(120 + step);
    const std::vector<float> flip = flip_difference(a, b);
    EXPECT_GT(flip[40 * 80 + 40], last);
    EXPECT_LT(flip[5 * 80 + 5], 1e-3);
    last = flip[40 * 80 + 40];
  }
}

TEST(ImageLimits, each_breaks_on_its_own) {
  const Image a = scene(160, 120);
  Image speck = a;
  for (int k = 0; k < 12; ++k) speck.at(13 * k, 9 * k + 3)[0] ^= 8;
  ImageLimits limits = allowing_all();
  limits.tolerance = 6;
  limits.share_beyond = 0.0002;
  EXPECT_EQ(broken(a, speck, limits), std::vector<std::string>{"max-share"});
  limits = allowing_all();
  limits.largest = 7;
  EXPECT_EQ(broken(a, speck, limits), std::vector<std::string>{"max-difference"});

  Image noisy = a;
  std::mt19937 random(3);
  for (std::size_t i = 0; i < noisy.pixels.size(); i += 4)
    noisy.pixels[i + 1] = static_cast<std::uint8_t>(
        std::clamp<int>(noisy.pixels[i + 1] + static_cast<int>(random() % 21) - 10, 0, 255));
  limits = allowing_all();
  limits.mean_ssim = 0.999;
  EXPECT_EQ(broken(a, noisy, limits), std::vector<std::string>{"min-ssim"});
  limits = allowing_all();
  limits.flip_mean = 0.001;
  EXPECT_EQ(broken(a, noisy, limits), std::vector<std::string>{"max-flip"});

  Image missing = a;  // one small thing
  for (int y = 60; y < 66; ++y)
    for (int x = 80; x < 86; ++x) missing.at(x, y)[1] = 150;
  limits = allowing_all();
  limits.worst_tile_ssim = 0.95;
  EXPECT_EQ(broken(a, missing, limits), std::vector<std::string>{"min-tile-ssim"});
  limits.worst_tile_ssim = -1;
  limits.mean_ssim = 0.98;
  limits.flip_mean = 0.01;
  EXPECT_TRUE(broken(a, missing, limits).empty()) << "means let it through";
  limits = allowing_all();
  limits.flip_p99 = 0.01;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 4; ++x) missing.at(x, y)[1] = 250;
  EXPECT_EQ(broken(a, missing, limits), std::vector<std::string>{"max-flip-p99"});
}

TEST(ImageLimits, let_another_computers_rounding_pass) {
  const Image a = scene(320, 240);
  Image b = a;
  std::mt19937 random(7);
  for (std::size_t i = 0; i < b.pixels.size(); i += 4)
    if (random() % 20 == 0) b.pixels[i + random() % 3] ^= 1;
  EXPECT_TRUE(broken(a, b).empty());
}

}  // namespace
}  // namespace isorelax::compare
