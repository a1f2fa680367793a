#pragma once

#include <gtest/gtest.h>

#include <string>

#include "render/image.h"

namespace isorelax::test {

/// What two pictures may differ by and still be the same picture. Both limits must hold: the share finds
/// specks, the worst tile finds small things that moved or are missing.
struct ImageLimits {
  int channel_tolerance = 6;     ///< differences up to this many of 255 steps are not counted
  double share_beyond = 0.0002;  ///< of all pixels
  double worst_tile_mean = 1.0;  ///< mean difference of channels in the worst tile, of 255
};

/// Tiles are squares of this many pixels.
inline constexpr int kTileSide = 16;

struct ImageDifference {
  bool same_size = false;
  int largest = 0;          ///< of all channels
  double share_beyond = 0;  ///< pixels with a channel beyond the tolerance
  double worst_tile_mean = 0;

  [[nodiscard]] bool within(const ImageLimits& limits) const {
    return same_size && share_beyond <= limits.share_beyond && worst_tile_mean <= limits.worst_tile_mean;
  }
};

ImageDifference compare_images(const render::Image& a, const render::Image& b, const ImageLimits& limits);

/// tests/baselines/NAME.png. Throws InputError when there is none.
render::Image read_baseline(const std::string& name);

/// Whether `actual` is the accepted picture. If not, or if there is none yet, actual, expected and difference
/// are left in the build folder under image_failures/, and the message says where;
/// tests/support/promote_baselines.sh accepts them.
testing::AssertionResult matches_baseline(const render::Image& actual, const std::string& name,
                                          const ImageLimits& limits = {});

}  // namespace isorelax::test
