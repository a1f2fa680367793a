#include "smoothing/fold_control.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Going to the root itself would make triangles without area.
constexpr double kSafety = 0.6;
constexpr unsigned kMaxRounds = 12;

/// First root of c + b a + q a^2 in (0, infinity), c > 0; infinity if there is none.
double first_positive_root(double c, double b, double q) {
  const double discriminant = b * b - 4 * q * c;
  if (discriminant < 0) return INFINITY;
  // 2 c / (-b + sqrt(D)) is the smaller positive root for q > 0 and the positive one for q < 0, without
  // cancellation where b < 0.
  const double denominator = -b + std::sqrt(discriminant);
  return denominator > 0 ? 2 * c / denominator : INFINITY;
}

}  // namespace

double fold_free_share(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& d, double safety) {
  const Vec3 t1 = x[1] - x[0];
  const Vec3 t2 = x[2] - x[0];
  const Vec3 d1 = d[1] - d[0];
  const Vec3 d2 = d[2] - d[0];
  const Vec3 normal = t1.cross(t2);
  const double c = normal.squaredNorm();
  const double b = (d1.cross(t2) + t1.cross(d2)).dot(normal);
  const double q = d1.cross(d2).dot(normal);
  // A lower bound of the polynomial on [0, 1 / safety]: most triangles end here.
  if (c + std::min(b, 0.0) / safety + std::min(q, 0.0) / (safety * safety) > 0) return 1;
  return std::min(1.0, safety * first_positive_root(c, b, q));
}

FoldControl::FoldControl(const SmoothingProblem& problem)
    : problem_(problem), cuts_(block_count(problem.triangle_count())) {}

void FoldControl::limit(std::span<const Vec3> positions, StepRecord& record) {
  for (unsigned round = 0;; ++round) {
    parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Cut>& cuts = cuts_[begin / kBlockSize];
      cuts.clear();
      for (std::size_t t = begin; t < end; ++t) {
        if (problem_.treated[t] == 0) continue;
        const Triangle& v = problem_.triangles[t];
        const double share = fold_free_share(
            {positions[v[0]], positions[v[1]], positions[v[2]]},
            {record.alpha[v[0]] * record.displacement[v[0]], record.alpha[v[1]] * record.displacement[v[1]],
             record.alpha[v[2]] * record.displacement[v[2]]},
            kSafety);
        if (share < 1) cuts.push_back({static_cast<Index>(t), share});
      }
    });
    // Every vertex takes the smallest share of its triangles; the triangles' shares were all found for the
    // same moves.
    std::vector<std::pair<Index, double>> vertex_share;
    for (const auto& cuts : cuts_) {
      for (const Cut& cut : cuts) {
        for (const Index v : problem_.triangles[cut.triangle]) vertex_share.emplace_back(v, cut.share);
      }
    }
    if (vertex_share.empty()) return;
    ++record.fold_passes;
    std::sort(vertex_share.begin(), vertex_share.end());
    const bool give_up = round + 1 >= kMaxRounds;
    for (std::size_t i = 0; i < vertex_share.size(); ++i) {
      const auto [v, share] = vertex_share[i];
      if (i > 0 && vertex_share[i - 1].first == v) continue;
      if (record.displacement[v].isZero(0) || record.alpha[v] == 0) continue;
      record.alpha[v] = give_up ? 0 : record.alpha[v] * share;
      record.limits[v] |= kLimitFold;
    }
  }
}

}  // namespace isorelax
