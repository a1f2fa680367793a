#include "compare/ssim.h"

namespace isorelax::compare {
namespace {

constexpr double kSigma = 1.5;
constexpr int kRadius = 5;
constexpr float kC1 = (0.01F * 255) * (0.01F * 255);
constexpr float kC2 = (0.03F * 255) * (0.03F * 255);

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  for (std::size_t i = 0; i < a.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
  return result;
}

}  // namespace

Plane structural_similarity(const Plane& a, const Plane& b) {
  const Kernel window = gaussian(kSigma, kRadius);
  // Variances are differences of large numbers: about mid-grey the numbers are smaller.
  constexpr float kMiddle = 127.5F;
  Plane x = a;
  Plane y = b;
  for (float& v : x.values) v -= kMiddle;
  for (float& v : y.values) v -= kMiddle;
  const Plane mean_x = convolve(x, window, window);
  const Plane mean_y = convolve(y, window, window);
  const Plane xx = convolve(product(x, x), window, window);
  const Plane yy = convolve(product(y, y), window, window);
  const Plane xy = convolve(product(x, y), window, window);
  Plane result(a.width, a.height);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const float mx = mean_x.values[i];
    const float my = mean_y.values[i];
    const float var_x = xx.values[i] - mx * mx;
    const float var_y = yy.values[i] - my * my;
    const float cov = xy.values[i] - mx * my;
    const float ux = mx + kMiddle;
    const float uy = my + kMiddle;
    result.values[i] =
        (2 * ux * uy + kC1) * (2 * cov + kC2) / ((ux * ux + uy * uy + kC1) * (var_x + var_y + kC2));
  }
  return result;
}

}  // namespace isorelax::compare
