#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compare/planes.h"

namespace isorelax::compare {
namespace {

using render::Image;
using Triple = std::array<float, 3>;
/// Luminance, red-green and blue-yellow of the opponent space YCxCz.
using Opponent = std::array<Plane, 3>;

// Constants of the paper, Sections 4.1 and 4.2.
constexpr double kColorExponent = 0.7;    // q_c
constexpr double kCutoff = 0.4;           // p_c
constexpr double kTarget = 0.95;          // p_t
constexpr double kFeatureExponent = 0.5;  // q_f
constexpr double kFeatureWidth = 0.082;   // w, degrees

constexpr std::array<Triple, 3> kToXyz{{{0.41238656F, 0.35759149F, 0.18045049F},
                                        {0.21263682F, 0.71518298F, 0.07218020F},
                                        {0.01933062F, 0.11919716F, 0.95037259F}}};
constexpr std::array<Triple, 3> kFromXyz{{{3.24100326F, -1.53739899F, -0.49861587F},
                                          {-0.96922426F, 1.87592999F, 0.04155422F},
                                          {0.05563942F, -0.20401120F, 1.05714897F}}};
/// D65: the sums of the rows of kToXyz.
constexpr Triple kWhite{0.95042854F, 1.0F, 1.08890037F};

Triple times(const std::array<Triple, 3>& matrix, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return result;
}

float to_linear(std::uint8_t channel) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double c = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table[channel];
}

Opponent opponent_of(const Image& image) {
  Opponent planes;
  planes.fill(Plane(image.width, image.height));
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    const std::uint8_t* p = image.pixels.data() + 4 * i;
    Triple xyz = times(kToXyz, {to_linear(p[0]), to_linear(p[1]), to_linear(p[2])});
    for (std::size_t k = 0; k < 3; ++k) xyz[k] /= kWhite[k];
    planes[0].values[i] = 116 * xyz[1] - 16;
    planes[1].values[i] = 500 * (xyz[0] - xyz[1]);
    planes[2].values[i] = 200 * (xyz[1] - xyz[2]);
  }
  return planes;
}

/// A term of a contrast sensitivity function in space: a * sqrt(pi / b) * exp(-pi^2 x^2 / b).
struct Term {
  double a;
  double b;
};
constexpr std::array<std::array<Term, 2>, 3> kSensitivity{
    {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};

/// The plane blurred by a sum of two Gaussians; each of them goes across and down by itself.
Plane blurred(const Plane& plane, const std::array<Term, 2>& terms, double pixels_per_degree) {
  const double widest = 0.04;
  const int radius = static_cast<int>(
      std::ceil(3 * std::sqrt(widest / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  Plane result(plane.width, plane.height);
  std::array<double, 2> weights{};
  std::array<Kernel, 2> kernels;
  for (std::size_t i = 0; i < 2; ++i) {
    const double sigma =
        std::sqrt(terms[i].b / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree;
    kernels[i] = gaussian(sigma, radius);
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
    weights[i] = terms[i].a * std::sqrt(std::numbers::pi / terms[i].b) * sum * sum;
  }
  const double total = weights[0] + weights[1];
  for (std::size_t i = 0; i < 2; ++i) {
    if (weights[i] == 0) continue;
    const Plane part = convolve(plane, kernels[i], kernels[i]);
    const auto share = static_cast<float>(weights[i] / total);
    for (std::size_t p = 0; p < result.values.size(); ++p) result.values[p] += share * part.values[p];
  }
  return result;
}

float lab_root(float t) {
  constexpr float kDelta = 6.0F / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0F / 29;
}

/// L*a*b* of a linear colour, a and b less where it is dark: Hunt's effect.
Triple hunt_lab(const Triple& linear) {
  Triple xyz = times(kToXyz, linear);
  for (std::size_t k = 0; k < 3; ++k) xyz[k] = lab_root(xyz[k] / kWhite[k]);
  const float lightness = 116 * xyz[1] - 16;
  return {lightness, 0.01F * lightness * 500 * (xyz[0] - xyz[1]),
          0.01F * lightness * 200 * (xyz[1] - xyz[2])};
}

Triple lab_of_opponent(float y, float cx, float cz) {
  const float relative_y = (y + 16) / 116;
  Triple xyz{(relative_y + cx / 500) * kWhite[0], relative_y * kWhite[1],
             (relative_y - cz / 200) * kWhite[2]};
  Triple linear = times(kFromXyz, xyz);
  for (float& channel : linear) channel = std::clamp(channel, 0.0F, 1.0F);
  return hunt_lab(linear);
}

double hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Color difference, 0..1: steep at first, then slower.
double redistributed(double difference) {
  static const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorExponent);
  const double powered = std::pow(difference, kColorExponent);
  const double knee = kCutoff * most;
  if (powered < knee) return kTarget / knee * powered;
  return std::min(1.0, kTarget + (powered - knee) / (most - knee) * (1 - kTarget));
}

std::vector<float> color_differences(const Opponent& a, const Opponent& b, double pixels_per_degree) {
  Opponent x, y;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = blurred(a[k], kSensitivity[k], pixels_per_degree);
    y[k] = blurred(b[k], kSensitivity[k], pixels_per_degree);
  }
  std::vector<float> result(x[0].values.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Triple lab_a = lab_of_opponent(x[0].values[i], x[1].values[i], x[2].values[i]);
    const Triple lab_b = lab_of_opponent(y[0].values[i], y[1].values[i], y[2].values[i]);
    result[i] = static_cast<float>(redistributed(hyab(lab_a, lab_b)));
  }
  return result;
}

/// First or second derivative of a Gaussian, positive and negative weights of sum 1 each.
Kernel derivative(double sigma, int radius, int order) {
  std::vector<double> weights;
  double positive = 0, negative = 0;
  for (int x = -radius; x <= radius; ++x) {
    const double bell = std::exp(-0.5 * x * x / (sigma * sigma));
    const double weight = order == 1 ? -x * bell : (x * x / (sigma * sigma) - 1) * bell;
    weights.push_back(weight);
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  Kernel kernel;
  for (const double weight : weights)
    kernel.push_back(static_cast<float>(weight > 0 ? weight / positive : weight / negative));
  return kernel;
}

/// Length of the first or second derivative of the luminance.
Plane features(const Plane& luminance, double pixels_per_degree, int order) {
  Plane scaled = luminance;
  for (float& v : scaled.values) v = (v + 16) / 116;
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel along = derivative(sigma, radius, order);
  const Kernel beside = gaussian(sigma, radius);
  Plane x = convolve(scaled, along, beside);
  const Plane y = convolve(scaled, beside, along);
  for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
  return x;
}

}  // namespace

std::vector<float> flip_difference(const Image& a, const Image& b, double pixels_per_degree) {
  const Opponent x = opponent_of(a);
  const Opponent y = opponent_of(b);
  std::vector<float> result = color_differences(x, y, pixels_per_degree);
  const Plane edges_x = features(x[0], pixels_per_degree, 1);
  const Plane edges_y = features(y[0], pixels_per_degree, 1);
  const Plane points_x = features(x[0], pixels_per_degree, 2);
  const Plane points_y = features(y[0], pixels_per_degree, 2);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double edges = std::abs(edges_x.values[i] - edges_y.values[i]);
    const double points = std::abs(points_x.values[i] - points_y.values[i]);
    const double feature = std::pow(std::max(edges, points) / std::numbers::sqrt2, kFeatureExponent);
    result[i] = static_cast<float>(std::pow(static_cast<double>(result[i]), 1 - std::min(1.0, feature)));
  }
  return result;
}

}  // namespace isorelax::compare
