#include "mesh/lane_math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesh/angle.h"

namespace isorelax {
namespace {

constexpr double kTanOf22Deg5 = 0.41421356237309503;
/// atan(q) / q as a polynomial of q^2 from 0 to tan^2(22.5 deg): interpolated at Chebyshev's points, to
/// 6e-17.
constexpr std::array kAtan = {1.0,
                              -0.3333333333333312,
                              0.19999999999940893,
                              -0.14285714279259173,
                              0.11111110745647881,
                              -0.0909089683490742,
                              0.07692045840168628,
                              -0.06662957885001021,
                              0.05846923181644064,
                              -0.05035303886037713,
                              0.03797028858645916,
                              -0.01781076663959897};

/// e^r from -ln(2) / 2 to ln(2) / 2 by its series.
constexpr std::array kExp = {
    1.0,        1.0,         1.0 / 2,      1.0 / 6,       1.0 / 24,       1.0 / 120,       1.0 / 720,
    1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
constexpr double kLeastExponent = -700;
/// Added to a small number, it leaves the nearest integer in the lowest bits.
constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52
/// ln(2) in two parts, the first of which is exact times any exponent.
constexpr double kLn2High = 0.693147180369123816490;
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr std::int64_t kExponentBias = 1023;

template <std::size_t kCount>
[[gnu::always_inline]] inline double polynomial(const std::array<double, kCount>& c, double z) {
  double sum = c[kCount - 1];
#pragma GCC unroll 16
  for (std::size_t i = kCount - 1; i > 0; --i) sum = sum * z + c[i - 1];
  return sum;
}

}  // namespace

// atan(s / l) with the shorter over the longer side, less an eighth of a turn where that makes it smaller.
ISORELAX_VECTOR_CLONES
void angles_deg(const Lanes& y, const Lanes& x, Lanes& angles) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double up = y.at[i];
    const double along = x.at[i] < 0 ? -x.at[i] : x.at[i];
    const double s = up < along ? up : along;
    const double l = up < along ? along : up;
    const bool turns = s > kTanOf22Deg5 * l;
    const double over = turns ? s - l : s;
    const double under = turns ? s + l : l;
    const double q = over / (under > 0 ? under : 1);
    const double part = kDegrees * (q * polynomial(kAtan, q * q));
    const double from_longer = turns ? 45 + part : part;
    const double from_axis = up <= along ? from_longer : 90 - from_longer;
    angles.at[i] = x.at[i] < 0 ? 180 - from_axis : from_axis;
  }
}

ISORELAX_VECTOR_CLONES
void exp_of_negative(const Lanes& x, Lanes& powers) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double exponent = x.at[i] > kLeastExponent ? x.at[i] : kLeastExponent;
    const double rounded = exponent * std::numbers::log2e + kRounder;
    const double n = rounded - kRounder;
    const double r = (exponent - n * kLn2High) - n * kLn2Low;
    const auto bits = std::bit_cast<std::int64_t>(rounded) - std::bit_cast<std::int64_t>(kRounder);
    const auto scale = std::bit_cast<double>((bits + kExponentBias) << 52);
    powers.at[i] = x.at[i] > kLeastExponent ? scale * polynomial(kExp, r) : 0;
  }
}

}  // namespace isorelax
