#include "smoothing/renumbering.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isorelax {
namespace {

/// Numbers count as random where the ends of an edge are farther apart than this many rows of a square grid,
/// in the mean.
constexpr double kFarRows = 8;
constexpr unsigned kCurveBits = 20;

/// Every third bit, from the lowest on, one of the number's.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | (x << 32U)) & 0x1f00000000ffffU;
  x = (x | (x << 16U)) & 0x1f0000ff0000ffU;
  x = (x | (x << 8U)) & 0x100f00f00f00f00fU;
  x = (x | (x << 4U)) & 0x10c30c30c30c30c3U;
  return (x | (x << 2U)) & 0x1249249249249249U;
}

bool is_random(std::span<const Triangle> triangles, std::size_t vertices) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += t[0] < t[1] ? t[1] - t[0] : t[0] - t[1];
  return sum > kFarRows * std::sqrt(static_cast<double>(vertices)) * static_cast<double>(triangles.size());
}

std::vector<Index> sorted_by(const std::vector<std::uint64_t>& keys) {
  std::vector<Index> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  return order;
}

}  // namespace

Renumbering::Renumbering(std::span<const Vec3> positions, std::span<const Triangle> of) {
  if (!is_random(of, positions.size())) return;
  Vec3 low = positions.front();
  Vec3 high = low;
  for (const Vec3& x : positions) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double extent = (high - low).maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent)) return;
  const double scale = static_cast<double>((1U << kCurveBits) - 1) / extent;
  std::vector<std::uint64_t> keys;
  keys.reserve(positions.size());
  for (const Vec3& x : positions) {
    std::uint64_t key = 0;
    for (unsigned k = 0; k < 3; ++k)
      key |= spread_bits(static_cast<std::uint64_t>((x[k] - low[k]) * scale)) << k;
    keys.push_back(key);
  }
  vertices = sorted_by(keys);
  std::vector<std::uint64_t> first(of.size());
  for (std::size_t t = 0; t < of.size(); ++t)
    first[t] = std::min({keys[of[t][0]], keys[of[t][1]], keys[of[t][2]]});
  triangles = sorted_by(first);
}

std::vector<Index> inverse(std::span<const Index> order) {
  std::vector<Index> places(order.size());
  for (Index place = 0; place < order.size(); ++place) places[order[place]] = place;
  return places;
}

}  // namespace isorelax
