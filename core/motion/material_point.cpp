#include "motion/material_point.h"

#include <algorithm>
#include <cmath>

#include "mesh/degenerate.h"

namespace isorelax {

MaterialSurface::MaterialSurface(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                 const Topology& topology, const EdgeWalls& walls)
    : x_(positions.begin(), positions.end()), triangles_(triangles.begin(), triangles.end()) {
  opposite_.resize(3 * triangles_.size(), kNone);
  frames_.resize(triangles_.size());
  gradients_.resize(triangles_.size());
  for (Index t = 0; t < triangle_count(); ++t) {
    const Triangle& v = triangles_[t];
    const Vec3 normal = area_vector(x_[v[0]], x_[v[1]], x_[v[2]]);
    gradients_[t].setZero();
    frames_[t] = {Vec3::UnitX(), Vec3::UnitY()};
    if (has_no_area(x_[v[0]], x_[v[1]], x_[v[2]])) continue;
    const Vec3 first = (x_[v[1]] - x_[v[0]]).normalized();
    const Vec3 second = normal.normalized().cross(first);
    frames_[t] = {first, second};
    for (unsigned k = 0; k < 3; ++k) {
      const Vec3 edge = x_[v[previous(k)]] - x_[v[next(k)]];
      const Vec3 gradient = normal.cross(edge) / normal.squaredNorm();
      gradients_[t].row(k) << gradient.dot(first), gradient.dot(second);
      const Corner corner = 3 * t + k;
      if (walls.empty() || walls[corner] == 0) opposite_[corner] = topology.opposite(corner);
    }
  }
}

Vec3 MaterialSurface::point(const MaterialPoint& m) const {
  const Triangle& v = triangles_[m.triangle];
  return m.weights[0] * x_[v[0]] + m.weights[1] * x_[v[1]] + m.weights[2] * x_[v[2]];
}

MaterialPoint MaterialSurface::walk(const MaterialPoint& from, const Eigen::Vector2d& move) const {
  constexpr int kMostTriangles = 64;
  MaterialPoint at = from;
  Eigen::Vector2d rest = move;
  unsigned entered = 3;  // the corner opposite to the edge that was crossed last
  for (int i = 0; i < kMostTriangles; ++i) {
    const Vec3 change = gradients_[at.triangle] * rest;
    double share = 1;
    unsigned leaves = 3;
    for (unsigned k = 0; k < 3; ++k) {
      if (k == entered || !(change[k] < 0)) continue;
      const double reach = std::max(0.0, at.weights[k]) / -change[k];
      if (reach < share) share = reach, leaves = k;
    }
    at.weights = (at.weights + share * change).cwiseMax(0);
    at.weights /= at.weights.sum();
    if (leaves == 3) return at;
    rest *= 1 - share;
    const Corner beyond = opposite_[3 * at.triangle + leaves];
    if (beyond == kNone || gradients_[beyond / 3].isZero(0)) return at;

    // Unfold: the part along the edge stays, the part across it goes on.
    const Triangle& here = triangles_[at.triangle];
    const Vec3 along = (x_[here[previous(leaves)]] - x_[here[next(leaves)]]).normalized();
    const Vec3 rest3 = rest[0] * frames_[at.triangle][0] + rest[1] * frames_[at.triangle][1];
    const double parallel = rest3.dot(along);
    const double across = std::sqrt(std::max(0.0, rest.squaredNorm() - parallel * parallel));
    const Index next_triangle = beyond / 3;
    const unsigned k = beyond % 3;
    const Triangle& there = triangles_[next_triangle];
    Vec3 weights = Vec3::Zero();
    for (const unsigned j : {next(k), previous(k)})
      weights[j] = there[j] == here[next(leaves)] ? at.weights[next(leaves)] : at.weights[previous(leaves)];
    const auto& frame = frames_[next_triangle];
    const Eigen::Vector2d edge(along.dot(frame[0]), along.dot(frame[1]));
    const Eigen::Vector2d inward = gradients_[next_triangle].row(k).transpose().normalized();
    rest = parallel * edge + across * inward;
    at = {next_triangle, weights};
    entered = k;
  }
  return at;
}

}  // namespace isorelax
