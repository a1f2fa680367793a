#include "compare/planes.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"

namespace isorelax::compare {
namespace {

/// Blocks of about so many pixels: rows of one block are done together.
template <class Body>
void for_rows(const Plane& plane, const Body& body) {
  const int rows = std::max(1, static_cast<int>(kBlockSize) / std::max(1, plane.width));
  const int count = plane.height / rows + (plane.height % rows == 0 ? 0 : 1);
  const auto blocks = static_cast<std::size_t>(count);
  // One block of the scheduler for each block of rows.
  parallel_for_blocks(blocks * kBlockSize, 0, [&](std::size_t begin, std::size_t) {
    const int first = static_cast<int>(begin / kBlockSize) * rows;
    for (int y = first; y < std::min(plane.height, first + rows); ++y) body(y);
  });
}

void filter_row(const float* from, int width, const Kernel& kernel, std::vector<float>& padded, float* to) {
  const int radius = static_cast<int>(kernel.size() / 2);
  padded.assign(static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(radius), 0.0F);
  for (int x = 0; x < width + 2 * radius; ++x)
    padded[static_cast<std::size_t>(x)] = from[std::clamp(x - radius, 0, width - 1)];
  std::fill(to, to + width, 0.0F);
  for (std::size_t k = 0; k < kernel.size(); ++k) {
    const float weight = kernel[k];
    const float* shifted = padded.data() + k;
    for (int x = 0; x < width; ++x) to[x] += weight * shifted[x];
  }
}

}  // namespace

Kernel gaussian(double sigma, int radius) {
  Kernel kernel;
  double sum = 0;
  const auto weight = [&](int x) { return std::exp(-0.5 * x * x / (sigma * sigma)); };
  for (int x = -radius; x <= radius; ++x) sum += weight(x);
  for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(weight(x) / sum));
  return kernel;
}

Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down) {
  Plane rows(plane.width, plane.height);
  for_rows(plane, [&](int y) {
    std::vector<float> padded;
    filter_row(plane.row(y), plane.width, across, padded, rows.row(y));
  });
  Plane result(plane.width, plane.height);
  const int radius = static_cast<int>(down.size() / 2);
  for_rows(plane, [&](int y) {
    float* to = result.row(y);
    for (int k = 0; k < static_cast<int>(down.size()); ++k) {
      const float weight = down[static_cast<std::size_t>(k)];
      const float* from = rows.row(std::clamp(y + k - radius, 0, plane.height - 1));
      for (int x = 0; x < plane.width; ++x) to[x] += weight * from[x];
    }
  });
  return result;
}

}  // namespace isorelax::compare
