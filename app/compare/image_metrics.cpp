#include "compare/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "compare/flip.h"
#include "compare/ssim.h"
#include "mesh/error.h"
#include "render/colormap.h"

namespace isorelax::compare {
namespace {

using render::Image;

/// Rows that are worked on at once, so that large pictures need little memory; a multiple of the tiles.
constexpr int kBandPixels = 1 << 19;
/// Rows beside a band that its pixels' neighbourhoods reach into.
constexpr int kHalo = 32;

std::string size_text(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

/// Rows [first, last) as a picture of their own, over mid-grey where they are transparent.
Image rows_of(const Image& image, int first, int last) {
  Image band(image.width, last - first);
  std::copy_n(image.pixels.begin() + 4 * std::ptrdiff_t{image.width} * first, band.pixels.size(),
              band.pixels.begin());
  for (std::size_t i = 0; i < band.pixels.size(); i += 4) {
    const unsigned alpha = band.pixels[i + 3];
    if (alpha == 255) continue;
    for (std::size_t k = 0; k < 3; ++k)
      band.pixels[i + k] =
          static_cast<std::uint8_t>((band.pixels[i + k] * alpha + 128 * (255 - alpha) + 127) / 255);
  }
  return band;
}

/// Luma of Rec. 601, 0..255: what structural similarity is defined for.
Plane luma_of(const Image& image) {
  Plane plane(image.width, image.height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) {
    const std::uint8_t* p = image.pixels.data() + 4 * i;
    plane.values[i] = 0.299F * p[0] + 0.587F * p[1] + 0.114F * p[2];
  }
  return plane;
}

void count_differences(const Image& a, const Image& b, int tolerance, ImageFigures& figures) {
  figures.pixels = a.pixels.size() / 4;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    int largest = 0;
    for (std::size_t k = 0; k < 4; ++k)
      largest = std::max(largest, std::abs(a.pixels[i + k] - b.pixels[i + k]));
    figures.equal_pixels += largest == 0;
    figures.largest = std::max(figures.largest, largest);
    beyond += largest > tolerance;
  }
  if (figures.pixels > 0)
    figures.share_beyond = static_cast<double>(beyond) / static_cast<double>(figures.pixels);
}

/// Takes the similarity of rows [from, to) of a band into the figures; `top` is the band's row 0 in the
/// picture.
double add_tiles(const Plane& similarity, int from, int to, int top, ImageFigures& figures) {
  double all = 0;
  for (int y0 = from; y0 < to; y0 += kTileSide)
    for (int x0 = 0; x0 < similarity.width; x0 += kTileSide) {
      const int y1 = std::min(y0 + kTileSide, to);
      const int x1 = std::min(x0 + kTileSide, similarity.width);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        sum = std::accumulate(similarity.row(y) + x0, similarity.row(y) + x1, sum);
      all += sum;
      const double mean = sum / ((y1 - y0) * (x1 - x0));
      if (mean >= figures.worst_tile_ssim) continue;
      figures.worst_tile_ssim = mean;
      figures.worst_tile_x = x0;
      figures.worst_tile_y = top + y0;
    }
  return all;
}

void summarize_flip(std::vector<float> flip, ImageFigures& figures) {
  if (flip.empty()) return;
  figures.flip_mean = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
  const auto at =
      flip.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.99 * static_cast<double>(flip.size())) - 1);
  std::nth_element(flip.begin(), at, flip.end());
  figures.flip_p99 = *at;
}

}  // namespace

ImageComparison compare_images(const Image& a, const Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height)
    throw UsageError("the pictures have different sizes, " + size_text(a) + " and " + size_text(b) +
                     ": only pictures of one size can be compared");
  ImageComparison result;
  count_differences(a, b, tolerance, result.figures);
  result.flip.assign(result.figures.pixels, 0.0F);
  if (result.figures.is_equal()) return result;
  const int rows = std::max(1, kBandPixels / a.width / kTileSide) * kTileSide;
  double similarity = 0;
  for (int first = 0; first < a.height; first += rows) {
    const int last = std::min(a.height, first + rows);
    const int top = std::max(0, first - kHalo);
    const Image band_a = rows_of(a, top, std::min(a.height, last + kHalo));
    const Image band_b = rows_of(b, top, std::min(a.height, last + kHalo));
    similarity += add_tiles(structural_similarity(luma_of(band_a), luma_of(band_b)), first - top, last - top,
                            top, result.figures);
    const std::vector<float> flip = flip_difference(band_a, band_b);
    const std::ptrdiff_t skipped = std::ptrdiff_t{first - top} * a.width;
    std::copy_n(flip.begin() + skipped, std::ptrdiff_t{last - first} * a.width,
                result.flip.begin() + std::ptrdiff_t{first} * a.width);
  }
  result.figures.mean_ssim = similarity / static_cast<double>(result.figures.pixels);
  summarize_flip(result.flip, result.figures);
  return result;
}

std::vector<Verdict> judge(const ImageFigures& figures, const ImageLimits& limits) {
  std::vector<Verdict> verdicts;
  const auto most = [&](const char* name, const char* meaning, double found, double limit) {
    verdicts.push_back({name, meaning, found, limit, false, found <= limit});
  };
  const auto least = [&](const char* name, const char* meaning, double found, double limit) {
    verdicts.push_back({name, meaning, found, limit, true, found >= limit});
  };
  most("max-difference", "largest difference of a channel, of 255", figures.largest, limits.largest);
  most("max-share", "share of pixels beyond the tolerance", figures.share_beyond, limits.share_beyond);
  least("min-ssim", "mean structural similarity", figures.mean_ssim, limits.mean_ssim);
  least("min-tile-ssim", "structural similarity of the worst tile", figures.worst_tile_ssim,
        limits.worst_tile_ssim);
  most("max-flip", "mean perceptual difference (FLIP)", figures.flip_mean, limits.flip_mean);
  most("max-flip-p99", "99th percentile of the perceptual difference (FLIP)", figures.flip_p99,
       limits.flip_p99);
  return verdicts;
}

bool all_hold(const std::vector<Verdict>& verdicts) {
  return std::ranges::all_of(verdicts, &Verdict::holds);
}

Image heat_map(const Image& size_of, const std::vector<float>& flip) {
  const render::Coloring coloring{render::ColorMap::magma, {}, {}, {0, 1}};
  Image map(size_of.width, size_of.height);
  for (std::size_t i = 0; i < flip.size(); ++i) {
    const render::Color color = render::color_at(coloring, flip[i]);
    std::uint8_t* pixel = map.pixels.data() + 4 * i;
    pixel[0] = color.red;
    pixel[1] = color.green;
    pixel[2] = color.blue;
    pixel[3] = 255;
  }
  return map;
}

}  // namespace isorelax::compare
