#include "smoothing/turn_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/parallel.h"
#include "quality/folded_patches.h"
#include "quality/inverted.h"

namespace isorelax {
namespace {

/// Cosines of the turns from which on edges count as folds of either kind, and of a degree less, which they
/// may not come to.
struct Kind {
  double cosine, allowed;
};
constexpr std::array<Kind, 2> kKinds = {
    {{kPatchFoldCosine, -0.48480962024633706}, {kFoldCosine, -0.85716730070211233}}};
constexpr double kRounding = 1e-9;
constexpr std::uint8_t kNever = 255;

}  // namespace

bool faces_away(const ClosestPointIndex& surface, const Vec3& initial_normal,
                const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const SurfacePoint beside = surface.closest((a + b + c) / 3);
  if (beside.triangle == kNone) return false;
  const PreparedTriangle& there = surface.prepared(beside.triangle);
  const Vec3 normal = area_vector(there.a, there.b, there.c);
  return area_vector(a, b, c).dot(normal) < 0 && initial_normal.dot(normal) > 0;
}

TurnLimit::TurnLimit(const SmoothingProblem& problem) : problem_(problem) {
  if (!applies()) return;
  if (problem.surface)
    surface_ = problem.surface->flat().get();
  else if (problem.near)
    surface_ = problem.near->surface.get();
  needed_.resize(problem.triangle_count());
  folding_cosines_.resize(problem.triangle_count());
  unfolded_cosines_.resize(problem.triangle_count());
  parallel_for_blocks(problem.triangle_count(), problem.threads, [&](std::size_t begin, std::size_t end) {
    for (Index t = static_cast<Index>(begin); t < end; ++t) {
      needed_[t] = folds_to_turn_back(t);
      const double cosine = std::cos(0.5 * room_of(t));
      folding_cosines_[t] = cosine * cosine;
      const double room = room_beside_others(t);
      unfolded_cosines_[t] = room > 0 ? std::cos(room) * std::cos(room) : 2;
    }
  });
}

bool TurnLimit::lets_go(Index triangle, const Vec3& before, const Vec3& after) const {
  const Vec3 is = after.stableNormalized();
  const Vec3& initial = problem_.initial_normals[triangle];
  if (is.dot(initial) >= before.stableNormalized().dot(initial)) return true;
  const auto around = problem_.surrounding_normals.find(triangle);
  return around != problem_.surrounding_normals.end() && is.dot(around->second) > kLeastCosine;
}

double TurnLimit::cosine_at_start(Index t, Index u) const {
  return std::clamp(problem_.initial_normals[t].dot(problem_.initial_normals[u]), -1.0, 1.0);
}

/// One that had turned back at the start may do what it likes.
std::uint8_t TurnLimit::folds_to_turn_back(Index t) const {
  std::uint8_t neighbours = 0, folds = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * t + k);
    if (across == kNone) continue;
    ++neighbours;
    if (cosine_at_start(t, across / 3) < kKinds[1].cosine) ++folds;
  }
  const std::uint8_t needed = std::min<std::uint8_t>(2, neighbours);
  return needed == 0 || folds >= needed ? kNever : needed;
}

/// By how much, in radians, an edge of triangle t may turn more than at the start before it is a fresh fold:
/// where it turned by f and comes to turn by g, its triangles have turned by g - f together.
double TurnLimit::room_of(Index t) const {
  double room = std::numbers::pi;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * t + k);
    if (across == kNone) continue;
    const double at_start = cosine_at_start(t, across / 3);
    for (const Kind& kind : kKinds) {
      if (!(at_start > kind.cosine)) continue;
      room = std::min(room, std::acos(std::min(kind.allowed, at_start)) - std::acos(at_start));
      break;
    }
  }
  return room;
}

/// By how much, in radians, triangle t may turn before it has a fold to a neighbour that turns as far as it
/// may; up to a right angle.
double TurnLimit::room_beside_others(Index t) const {
  constexpr double kRoundingAngle = 0.01;
  const double largest_turn = std::acos(kLeastCosine) + kRoundingAngle;
  double room = std::numbers::pi / 2;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * t + k);
    if (across == kNone) continue;
    room = std::min(room,
                    std::acos(kKinds[0].allowed) - std::acos(cosine_at_start(t, across / 3)) - largest_turn);
  }
  return room;
}

Folds TurnLimit::fold_between(Index t, const Vec3& area_of_t, Index u, const Vec3& area_of_u) const {
  Folds folds;
  const double along = area_of_t.dot(area_of_u);
  if (!(along < 0)) return folds;
  const double squares = area_of_t.squaredNorm() * area_of_u.squaredNorm();
  const auto is_over = [&](double cosine) { return along * along > cosine * cosine * squares; };
  if (!is_over(kKinds[0].allowed)) return folds;
  const double at_start = cosine_at_start(t, u);
  // Between what is allowed and what counts as a fold it may stay.
  const auto is_fresh = [&](const Kind& kind) {
    return at_start > kind.cosine && is_over(std::min(kind.allowed, at_start) - kRounding);
  };
  folds.all = 1;
  folds.fresh = is_fresh(kKinds[0]) ? 1 : 0;
  folds.fresh_sharp = is_fresh(kKinds[1]) ? 1 : 0;
  return folds;
}

bool TurnLimit::faces_away(Index triangle, const std::array<Vec3, 3>& corners) const {
  return surface_ != nullptr && isorelax::faces_away(*surface_, problem_.initial_normals[triangle], corners);
}

Vec3 TurnLimit::area_at(std::span<const Vec3> x, Index triangle) const {
  const auto& [a, b, c] = problem_.triangles[triangle];
  return area_vector(x[a], x[b], x[c]);
}

Folds TurnLimit::folds_of(std::span<const Vec3> x, Index triangle, Index except) const {
  Folds folds;
  const Vec3 area = area_at(x, triangle);
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * triangle + k);
    if (across == kNone || across / 3 == except) continue;
    folds += fold_between(triangle, area, across / 3, area_at(x, across / 3));
  }
  return folds;
}

Index TurnLimit::over_fold(std::span<const Vec3> x, Index triangle, unsigned corner) const {
  const Corner across = problem_.topology.opposite(3 * triangle + corner);
  if (across == kNone) return kNone;
  const Folds fold = fold_between(triangle, area_at(x, triangle), across / 3, area_at(x, across / 3));
  return fold.any() ? across / 3 : kNone;
}

bool TurnLimit::turns_back(Index triangle, const Folds& folds) const {
  if (needed_[triangle] == kNever) return false;
  return folds.fresh_sharp > 0 || (folds.fresh > 0 && folds.all >= needed_[triangle]);
}

}  // namespace isorelax
