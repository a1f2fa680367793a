#include "support/image_compare.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace isorelax::test {
namespace {

namespace fs = std::filesystem;
using render::Image;

fs::path baseline_path(const std::string& name) {
  return fs::path(ISORELAX_SOURCE_DIR) / "tests" / "baselines" / (name + ".png");
}

fs::path failure_path(const std::string& name, const std::string& kind) {
  const fs::path folder = fs::path(ISORELAX_BINARY_DIR) / "image_failures";
  fs::create_directories(folder);
  return folder / (name + "." + kind + ".png");
}

int difference_at(const Image& a, const Image& b, int x, int y) {
  int largest = 0;
  for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, std::abs(a.at(x, y)[k] - b.at(x, y)[k]));
  return largest;
}

double tile_mean(const Image& a, const Image& b, int x0, int y0) {
  const int x1 = std::min(x0 + kTileSide, a.width);
  const int y1 = std::min(y0 + kTileSide, a.height);
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (std::size_t k = 0; k < 3; ++k) sum += std::abs(a.at(x, y)[k] - b.at(x, y)[k]);
  return sum / (3.0 * (x1 - x0) * (y1 - y0));
}

/// Black where equal; differences are made eight times larger to be seen.
Image difference_image(const Image& a, const Image& b) {
  Image difference(a.width, a.height);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto pixel = difference.at(x, y);
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(std::min(255, 8 * std::abs(a.at(x, y)[k] - b.at(x, y)[k])));
      pixel[3] = 255;
    }
  return difference;
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b, const ImageLimits& limits) {
  ImageDifference result;
  result.same_size = a.width == b.width && a.height == b.height;
  if (!result.same_size) return result;
  std::size_t beyond = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const int difference = difference_at(a, b, x, y);
      result.largest = std::max(result.largest, difference);
      beyond += difference > limits.channel_tolerance;
    }
  result.share_beyond = static_cast<double>(beyond) / std::max(1.0, static_cast<double>(a.width) * a.height);
  for (int y = 0; y < a.height; y += kTileSide)
    for (int x = 0; x < a.width; x += kTileSide)
      result.worst_tile_mean = std::max(result.worst_tile_mean, tile_mean(a, b, x, y));
  return result;
}

Image read_baseline(const std::string& name) {
  return render::read_png(baseline_path(name));
}

testing::AssertionResult matches_baseline(const Image& actual, const std::string& name,
                                          const ImageLimits& limits) {
  const fs::path actual_path = failure_path(name, "actual");
  if (!fs::exists(baseline_path(name))) {
    write_png(actual_path, actual);
    return testing::AssertionFailure()
           << "there is no baseline " << baseline_path(name).string() << "\nactual: " << actual_path.string();
  }
  const Image expected = read_baseline(name);
  const ImageDifference difference = compare_images(actual, expected, limits);
  if (difference.within(limits)) {
    for (const char* kind : {"actual", "expected", "difference"}) fs::remove(failure_path(name, kind));
    return testing::AssertionSuccess();
  }
  write_png(actual_path, actual);
  write_png(failure_path(name, "expected"), expected);
  auto failure = testing::AssertionFailure() << name;
  if (difference.same_size) {
    write_png(failure_path(name, "difference"), difference_image(actual, expected));
    failure << ": share beyond " << limits.channel_tolerance << "/255: " << difference.share_beyond
            << " (limit " << limits.share_beyond << "), worst tile " << difference.worst_tile_mean
            << " (limit " << limits.worst_tile_mean << "), largest " << difference.largest
            << "\ndifference: " << failure_path(name, "difference").string();
  } else {
    failure << ": " << actual.width << "x" << actual.height << " instead of " << expected.width << "x"
            << expected.height;
  }
  return failure << "\nactual: " << actual_path.string()
                 << "\nexpected: " << failure_path(name, "expected").string();
}

}  // namespace isorelax::test
