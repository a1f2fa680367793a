#include "smoothing/initial_normals.h"

#include <algorithm>

namespace isorelax {
namespace {

/// A triangle whose doubled area is a smaller share of its longest edge squared is a sliver, of some six
/// degrees.
constexpr double kSliver = 0.1;
/// Normals agree whose sum is longer than this share of what it would be if all were the same.
constexpr double kAgreement = 0.8;
/// Cosine of the angle to its surroundings from which on a triangle stands on them.
constexpr double kStanding = 0.5;
/// Cosine of a turn of some 115 degrees, beyond which edges may come to count as folds.
constexpr double kFolding = -0.42;

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

InitialNormals initial_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                               const Topology& topology, const VertexClasses& classes) {
  const Faces faces{positions, triangles};
  std::vector<Vec3> own, sums(positions.size(), Vec3::Zero());
  std::vector<double> weights(positions.size(), 0);
  own.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Vec3 area = faces.area(t);
    own.push_back(area.stableNormalized());
    if (faces.is_sliver(t)) continue;
    for (const Index v : t) {
      sums[v] += area;
      weights[v] += area.norm();
    }
  }
  const auto is_smooth = [&](Index v) { return classes.classes[v] == VertexClass::smooth; };
  const auto folds_more = [&](std::size_t t, const Vec3& normal) {
    for (unsigned k = 0; k < 3; ++k) {
      const Corner across = topology.opposite(static_cast<Corner>(3 * t + k));
      if (across == kNone) continue;
      const double along = normal.dot(own[across / 3]);
      if (along < kFolding && along < own[t].dot(own[across / 3])) return true;
    }
    return false;
  };
  InitialNormals normals{own, {}};
  for (Index i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    // What lies about a ridge says nothing about either side of it.
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (const Index v : t) {
      if (!is_smooth(v)) continue;
      sum += sums[v];
      weight += weights[v];
    }
    if (!(weight > 0 && sum.norm() > kAgreement * weight)) continue;
    const Vec3 theirs = sum.normalized();
    const double along = theirs.dot(own[i]);
    if (faces.is_sliver(t) && along > 0 && !folds_more(i, theirs))
      normals.own[i] = theirs;
    else if (along < kStanding)
      normals.around.emplace(i, theirs);
  }
  return normals;
}

}  // namespace isorelax
