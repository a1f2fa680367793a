#include "generate/predicates.h"

#include <cmath>

namespace isorelax {
namespace {

__extension__ using Wide = __int128;

int sign_of(Wide value) {
  return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

/// Bound of the relative rounding error of the determinants below, generous.
constexpr double kDeterminantRounding = 1e-14;

}  // namespace

int orient_plane(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return sign_of(Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x));
}

int in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const std::int64_t ax = a.x - d.x;
  const std::int64_t ay = a.y - d.y;
  const std::int64_t bx = b.x - d.x;
  const std::int64_t by = b.y - d.y;
  const std::int64_t cx = c.x - d.x;
  const std::int64_t cy = c.y - d.y;
  const std::int64_t a2 = ax * ax + ay * ay;
  const std::int64_t b2 = bx * bx + by * by;
  const std::int64_t c2 = cx * cx + cy * cy;
  const std::int64_t bc = bx * cy - by * cx;
  const std::int64_t ca = cx * ay - cy * ax;
  const std::int64_t ab = ax * by - ay * bx;
  const double pa = static_cast<double>(a2) * static_cast<double>(bc);
  const double pb = static_cast<double>(b2) * static_cast<double>(ca);
  const double pc = static_cast<double>(c2) * static_cast<double>(ab);
  const double value = pa + pb + pc;
  if (std::abs(value) > kDeterminantRounding * (std::abs(pa) + std::abs(pb) + std::abs(pc)))
    return value > 0 ? 1 : -1;
  return sign_of(Wide{a2} * bc + Wide{b2} * ca + Wide{c2} * ab);
}

int orient_space(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const std::int64_t u[3] = {b.x - a.x, b.y - a.y, b.z - a.z};
  const std::int64_t v[3] = {c.x - a.x, c.y - a.y, c.z - a.z};
  const std::int64_t w[3] = {d.x - a.x, d.y - a.y, d.z - a.z};
  double value = 0;
  double size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double first = static_cast<double>(u[j]) * static_cast<double>(v[k]);
    const double second = static_cast<double>(u[k]) * static_cast<double>(v[j]);
    value += (first - second) * static_cast<double>(w[i]);
    size += (std::abs(first) + std::abs(second)) * std::abs(static_cast<double>(w[i]));
  }
  if (std::abs(value) > kDeterminantRounding * size) return value > 0 ? 1 : -1;
  Wide exact = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    exact += (Wide{u[j]} * v[k] - Wide{u[k]} * v[j]) * w[i];
  }
  return sign_of(exact);
}

}  // namespace isorelax
