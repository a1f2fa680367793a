#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/image.h"

namespace isorelax::compare {

/// What two pictures may differ by and still pass: all of it has to hold. No single number would do: a mean
/// lets a missing label through, a largest difference fails on another graphics card's rounding.
struct ImageLimits {
  int tolerance = 6;              ///< a channel may differ by this much of 255 without being counted
  double share_beyond = 0.0002;   ///< most pixels with a channel beyond the tolerance, of all pixels
  int largest = 255;              ///< largest difference of a channel
  double mean_ssim = 0.999;       ///< least mean structural similarity
  double worst_tile_ssim = 0.95;  ///< least mean structural similarity of a 16 x 16 tile
  double flip_mean = 0.005;       ///< largest mean perceptual difference, 0..1
  double flip_p99 = 0.05;         ///< largest 99th percentile of the perceptual difference, 0..1
};

/// Sides of the tiles, pixels.
inline constexpr int kTileSide = 16;

/// How two pictures of one size differ.
struct ImageFigures {
  std::size_t pixels = 0;
  std::size_t equal_pixels = 0;  ///< all four channels the same
  int largest = 0;               ///< largest difference of a channel, alpha included, 0..255
  double share_beyond = 0;       ///< pixels with a channel beyond the tolerance
  double mean_ssim = 1;
  double worst_tile_ssim = 1;
  int worst_tile_x = 0;  ///< upper left corner of the worst tile, pixels
  int worst_tile_y = 0;
  double flip_mean = 0;
  double flip_p99 = 0;

  [[nodiscard]] bool is_equal() const { return equal_pixels == pixels; }
};

/// A limit with what was found.
struct Verdict {
  std::string name;     ///< as its option is called: "share-beyond"
  std::string meaning;  ///< for people
  double found = 0;
  double limit = 0;
  bool at_least = false;  ///< the limit is the least value, not the largest
  bool holds = true;
};

/// Every limit, in the order of the options.
[[nodiscard]] std::vector<Verdict> judge(const ImageFigures& figures, const ImageLimits& limits);
[[nodiscard]] bool all_hold(const std::vector<Verdict>& verdicts);

/// A comparison with the map that a page shows.
struct ImageComparison {
  ImageFigures figures;
  std::vector<float> flip;  ///< of each pixel, 0..1, rows from the top
};

/// Compares pictures; see ssim.h and flip.h. Partly transparent pixels are laid over mid-grey for both.
/// `tolerance`: see ImageLimits. Throws UsageError naming both sizes where they differ.
[[nodiscard]] ImageComparison compare_images(const render::Image& a, const render::Image& b, int tolerance);

/// The perceptual difference in colours, black where equal: what people look at.
[[nodiscard]] render::Image heat_map(const render::Image& size_of, const std::vector<float>& flip);

}  // namespace isorelax::compare
