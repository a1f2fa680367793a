#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace isorelax::compare {

/// One number per pixel, rows from the top.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  Plane() = default;
  Plane(int plane_width, int plane_height)
      : width(plane_width),
        height(plane_height),
        values(static_cast<std::size_t>(plane_width) * static_cast<std::size_t>(plane_height)) {}

  [[nodiscard]] float* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
  [[nodiscard]] const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// Weights of 2 r + 1 neighbours, the middle one at r.
using Kernel = std::vector<float>;

/// exp(-x^2 / (2 sigma^2)), sum 1, x = -radius..radius.
[[nodiscard]] Kernel gaussian(double sigma, int radius);

/// Across with one kernel, then down with the other; beyond the edge the edge goes on. Parallel, the same for
/// any number of threads.
[[nodiscard]] Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down);

}  // namespace isorelax::compare
