#include "smoothing/bounded_move.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isorelax {
namespace {

using Vec2 = Eigen::Vector2d;

struct PlaneBound {
  Vec2 gradient;
  double slack;

  [[nodiscard]] double left(const Vec2& m) const { return gradient.dot(m) + slack; }
};

/// The best move on the line where `on` is just kept, within the others.
Vec2 best_on_line(const Eigen::Matrix2d& h, const Vec2& g, const PlaneBound& on,
                  std::span<const PlaneBound> others) {
  const double squared = on.gradient.squaredNorm();
  const Vec2 from = -on.slack / squared * on.gradient;
  const Vec2 along(-on.gradient.y(), on.gradient.x());
  double low = -INFINITY, high = INFINITY;
  for (const PlaneBound& bound : others) {
    const double change = bound.gradient.dot(along);
    const double end = -bound.left(from) / change;
    if (change > 0) low = std::max(low, end);
    if (change < 0) high = std::min(high, end);
  }
  const double best = along.dot(g - h * from) / along.dot(h * along);
  return from + std::max(low, std::min(high, best)) * along;
}

}  // namespace

Vec3 best_move(const NewtonBlock& block, const Vec3& g, std::span<const MoveBound> bounds) {
  const auto in_plane = [&](const Vec3& v) { return Vec2(block.t1.dot(v), block.t2.dot(v)); };
  Eigen::Matrix2d h;
  h << block.h11, block.h12, block.h12, block.h22;
  const Vec2 slope = in_plane(g);
  Vec2 m = in_plane(block.solve(g));
  std::vector<PlaneBound> seen;
  seen.reserve(bounds.size());
  for (const MoveBound& bound : bounds) {
    const PlaneBound next{in_plane(bound.gradient), bound.slack};
    if (next.left(m) < 0 && next.gradient.squaredNorm() > 0) m = best_on_line(h, slope, next, seen);
    seen.push_back(next);
  }
  return block.t1 * m.x() + block.t2 * m.y();
}

}  // namespace isorelax
