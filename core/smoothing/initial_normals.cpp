#include "smoothing/initial_normals.h"

#include <algorithm>

#include "smoothing/turn_limit.h"

namespace isorelax {
namespace {

/// A triangle whose doubled area is a smaller share of its longest edge squared is a sliver, of some six
/// degrees.
constexpr double kSliver = 0.1;
/// Normals agree whose sum is longer than this share of what it would be if all were the same.
constexpr double kAgreement = 0.9;

struct Faces {
  std::span<const Vec3> x;
  std::span<const Triangle> triangles;

  [[nodiscard]] Vec3 area(const Triangle& t) const { return area_vector(x[t[0]], x[t[1]], x[t[2]]); }
  [[nodiscard]] bool is_sliver(const Triangle& t) const {
    double longest2 = 0;
    for (unsigned k = 0; k < 3; ++k) longest2 = std::max(longest2, (x[t[next(k)]] - x[t[k]]).squaredNorm());
    return area(t).norm() < kSliver * longest2;
  }
};

}  // namespace

std::vector<Vec3> initial_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const VertexClasses& classes) {
  const Faces faces{positions, triangles};
  std::vector<Vec3> normals, sums(positions.size(), Vec3::Zero());
  std::vector<double> weights(positions.size(), 0);
  normals.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Vec3 area = faces.area(t);
    normals.push_back(area.stableNormalized());
    if (faces.is_sliver(t)) continue;
    for (const Index v : t) {
      sums[v] += area;
      weights[v] += area.norm();
    }
  }
  const auto is_smooth = [&](Index v) { return classes.classes[v] == VertexClass::smooth; };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if (!std::ranges::all_of(t, is_smooth) || !faces.is_sliver(t)) continue;
    const Vec3 sum = sums[t[0]] + sums[t[1]] + sums[t[2]];
    if (!(sum.norm() > kAgreement * (weights[t[0]] + weights[t[1]] + weights[t[2]]))) continue;
    const Vec3 theirs = sum.normalized();
    const double along = theirs.dot(normals[i]);
    if (along > 0 && along < TurnLimit::kLeastCosine) normals[i] = theirs;
  }
  return normals;
}

}  // namespace isorelax
