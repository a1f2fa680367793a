#include "smoothing/turn_limit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Cosines of the turns over an edge that make folds, 120 and 150 degrees, and of a degree less, up to which
/// other edges may turn.
struct Fold {
  double cosine, allowed;
};
constexpr std::array<Fold, 2> kFolds = {
    {{-0.5, -0.48480962024633706}, {-0.86602540378443865, -0.85716730070211233}}};
constexpr double kRounding = 1e-9;

/// Cosine of the largest turn of an edge whose turn had this cosine at the start.
double least_cosine(double at_start) {
  for (const Fold& fold : kFolds)
    if (at_start > fold.cosine) return std::min(fold.allowed, at_start) - kRounding;
  return -INFINITY;
}

}  // namespace

TurnLimit::TurnLimit(const SmoothingProblem& problem) : problem_(problem) {
  if (!applies()) return;
  turned_back_.resize(problem.triangle_count());
  folding_cosines_.resize(problem.triangle_count());
  const auto for_triangles = [&](const auto& body) {
    parallel_for_blocks(problem.triangle_count(), problem.threads, [&](std::size_t begin, std::size_t end) {
      for (Index t = static_cast<Index>(begin); t < end; ++t) body(t);
    });
  };
  for_triangles([&](Index t) { turned_back_[t] = turns_back(t) ? 1 : 0; });
  for_triangles([&](Index t) {
    const double cosine = std::cos(0.5 * room_of(t));
    folding_cosines_[t] = cosine * cosine;
  });
}

/// Whether triangle t turned back from its neighbours at the start.
bool TurnLimit::turns_back(Index t) const {
  unsigned neighbours = 0, folds = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * t + k);
    if (across == kNone) continue;
    ++neighbours;
    if (cosine_at_start(t, across / 3) < kFolds[1].cosine) ++folds;
  }
  return folds > 0 && folds >= std::min(2U, neighbours);
}

/// By how much, in radians, an edge of triangle t may turn more than at the start: where it turned by f and
/// comes to turn by g, its triangles have turned by g - f together.
double TurnLimit::room_of(Index t) const {
  double room = std::numbers::pi;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * t + k);
    if (across == kNone || is_free(t, across / 3)) continue;
    const double at_start = cosine_at_start(t, across / 3);
    room = std::min(room, std::acos(least_cosine(at_start)) - std::acos(at_start));
  }
  return room;
}

double TurnLimit::cosine_at_start(Index t, Index u) const {
  return std::clamp(problem_.initial_normals[t].dot(problem_.initial_normals[u]), -1.0, 1.0);
}

bool TurnLimit::is_free(Index t, Index u) const {
  return turned_back_[t] != 0 || turned_back_[u] != 0 || least_cosine(cosine_at_start(t, u)) < -1;
}

bool TurnLimit::is_fold(Index t, const Vec3& area_of_t, Index u, const Vec3& area_of_u) const {
  const double along = area_of_t.dot(area_of_u);
  const double squares = area_of_t.squaredNorm() * area_of_u.squaredNorm();
  const auto is_over = [&](double cosine) { return along < 0 && along * along > cosine * cosine * squares; };
  return is_over(kFolds[0].allowed) && !is_free(t, u) && is_over(least_cosine(cosine_at_start(t, u)));
}

std::array<Index, 3> TurnLimit::folds_onto(std::span<const Vec3> x, Index triangle) const {
  const auto area_of = [&](Index t) {
    const auto& [a, b, c] = problem_.triangles[t];
    return area_vector(x[a], x[b], x[c]);
  };
  const Vec3 area = area_of(triangle);
  std::array<Index, 3> found = {kNone, kNone, kNone};
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * triangle + k);
    if (across != kNone && is_fold(triangle, area, across / 3, area_of(across / 3))) found[k] = across / 3;
  }
  return found;
}

}  // namespace isorelax
