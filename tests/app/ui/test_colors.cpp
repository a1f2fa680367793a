// Colours that tell things apart do so for everybody.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "ui/theme.h"

namespace isorelax::ui {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

// Linear sRGB as it is seen with all cones, without the green and without the red ones (Machado, Oliveira and
// Fernandes 2009).
constexpr std::array<Matrix, 3> kEyes{{
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
}};
constexpr Matrix kToXyz{{{0.4124564, 0.3575761, 0.1804375},
                         {0.2126729, 0.7151522, 0.0721750},
                         {0.0193339, 0.1191920, 0.9503041}}};

Triple times(const Matrix& m, const Triple& v) {
  Triple product{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) product.at(r) += m.at(r).at(c) * v.at(c);
  return product;
}

Triple lab_of(ImU32 color, const Matrix& eye) {
  Triple linear{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double s = (color >> 8 * k & 0xFFU) / 255.0;
    linear.at(k) = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  Triple seen = times(eye, linear);
  for (double& c : seen) c = std::clamp(c, 0.0, 1.0);
  Triple f = times(kToXyz, seen);
  f = {f[0] / 0.95047, f[1], f[2] / 1.08883};
  for (double& t : f) t = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16 / 116.0;
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

void expect_apart(std::span<const ImU32> colors) {
  for (std::size_t eye = 0; eye < kEyes.size(); ++eye)
    for (std::size_t a = 0; a < colors.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const Triple p = lab_of(colors[a], kEyes.at(eye));
        const Triple q = lab_of(colors[b], kEyes.at(eye));
        EXPECT_GT(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), 12) << a << ", " << b << ": eye " << eye;
      }
}

TEST(Colors, StayApartWithoutRedOrGreenCones) {
  expect_apart(color::kLimits);
  expect_apart(color::kBranches);
  expect_apart(color::kStages);
  expect_apart(std::array{color::kBetter, color::kWorse, color::kText});
}

}  // namespace
}  // namespace isorelax::ui
