#include "smoothing/baselines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/angle.h"
#include "mesh/parallel.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/renumbered_smoother.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

StepGuard step_guard(BaselineGuard guard) {
  return guard == BaselineGuard::on ? StepGuard::folds : StepGuard::none;
}

/// What Laplacian and angle-based smoothing share: each vertex looks at its neighbours and moves in its
/// tangent space.
class Baseline : public GuardedSmoother {
 public:
  [[nodiscard]] bool descends() const override { return false; }

 protected:
  Baseline(const SmoothingProblem& problem, StepKind kind, RecordDetail detail, BaselineGuard guard)
      : GuardedSmoother(problem, kind, detail, step_guard(guard)),
        sweep_(problem),
        axes_(problem.vertex_count()) {}

  /// Looks at all triangles before any vertex is asked.
  virtual void prepare(std::span<const Vec3> /*x*/) {}
  /// The move that vertex v would make were it free in space.
  [[nodiscard]] virtual Vec3 wish(std::span<const Vec3> x, Index v) const = 0;

 private:
  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const double norm = sweep_.find_tangents(here, positions, record.gradient, axes_);
    prepare(positions);
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) move(positions, static_cast<Index>(v), record);
    });
    return norm;
  }

  void move(std::span<const Vec3> x, Index v, StepRecord& record) const {
    const bool free = problem_.mobility[v] != Mobility::none;
    set_move(record, v, free ? tangent_part(problem_.mobility[v], axes_[v], wish(x, v)) : Vec3::Zero());
  }

  TangentSweep sweep_;
  std::vector<Vec3> axes_;
};

class Laplacian : public Baseline {
 public:
  Laplacian(const SmoothingProblem& problem, const LaplacianOptions& options)
      : Baseline(problem, StepKind::laplacian, options.detail, options.guard),
        weighting_(options.weighting),
        relaxation_(options.relaxation.value_or(weighting_ == LaplacianWeighting::uniform ? 1 : 0.5)) {}

 private:
  [[nodiscard]] Vec3 wish(std::span<const Vec3> x, Index v) const override {
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (const Corner c : problem_.topology.corners_of(v)) {
      const unsigned k = c % 3;
      for (const unsigned other : {next(k), previous(k)}) {
        // An edge is met once in each of its triangles.
        const unsigned third = 3 - k - other;
        const double share = 1.0 / problem_.topology.edge_triangle_count(c - k + third);
        const Vec3 edge = x[problem_.triangles[c / 3][other]] - x[v];
        const double weight = weighting_ == LaplacianWeighting::uniform ? share : share * edge.norm();
        sum += weight * edge;
        total += weight;
      }
    }
    return total > 0 ? Vec3(relaxation_ / total * sum) : Vec3::Zero();
  }

  LaplacianWeighting weighting_;
  double relaxation_;
};

class AngleBased : public Baseline {
 public:
  AngleBased(const SmoothingProblem& problem, const AngleBasedOptions& options)
      : Baseline(problem, StepKind::angle_based, options.detail, options.guard),
        weighting_(options.weighting),
        relaxation_(options.relaxation),
        angles_(problem.triangle_count()) {}

 private:
  void prepare(std::span<const Vec3> x) override {
    parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto [a, b, c] = problem_.triangles[t];
        const double at_a = angle_between(x[b] - x[a], x[c] - x[a]);
        const double at_b = angle_between(x[c] - x[b], x[a] - x[b]);
        angles_[t] = {at_a, at_b, std::numbers::pi - at_a - at_b};
      }
    });
  }

  [[nodiscard]] Vec3 wish(std::span<const Vec3> x, Index v) const override {
    const Vec3 normal = mean_normal(x, v);
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (const Corner c : problem_.topology.corners_of(v)) {
      // The edge to the previous corner j, whose other triangle lies beyond the corner in between.
      const unsigned k = c % 3;
      const Index t = c / 3;
      const Corner beyond = problem_.topology.opposite(c - k + next(k));
      if (beyond == kNone) continue;
      const Index j = problem_.triangles[t][previous(k)];
      const double a1 = angles_[t][previous(k)];
      const double a2 = angle_at(beyond / 3, j);
      if (!(a1 + a2 > 0)) continue;
      const Vec3 edge = x[v] - x[j];
      const double weight = weighting_ == AngleWeighting::plain ? 1 : 1 / ((a1 + a2) * (a1 + a2));
      const double turn = 0.5 * (a1 - a2);
      sum += weight * ((std::cos(turn) - 1) * edge + std::sin(turn) * normal.cross(edge));
      total += weight;
    }
    return total > 0 ? Vec3(relaxation_ / total * sum) : Vec3::Zero();
  }

  /// Mean unit normal of the triangles around a vertex, weighted by area: unlike the axis of a tangent plane
  /// it has a sign.
  [[nodiscard]] Vec3 mean_normal(std::span<const Vec3> x, Index v) const {
    if (problem_.plane_normal) return *problem_.plane_normal;
    Vec3 sum = Vec3::Zero();
    for (const Corner c : problem_.topology.corners_of(v)) {
      const Triangle& t = problem_.triangles[c / 3];
      sum += area_vector(x[t[0]], x[t[1]], x[t[2]]);
    }
    return sum.stableNormalized();
  }

  [[nodiscard]] double angle_at(Index t, Index vertex) const {
    const Triangle& v = problem_.triangles[t];
    return angles_[t][v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2];
  }

  AngleWeighting weighting_;
  double relaxation_;
  std::vector<std::array<double, 3>> angles_;
};

}  // namespace

std::unique_ptr<Smoother> make_laplacian(const SmoothingProblem& problem, const LaplacianOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<Laplacian>(numbered, options);
  });
}

std::unique_ptr<Smoother> make_angle_based(const SmoothingProblem& problem,
                                           const AngleBasedOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<AngleBased>(numbered, options);
  });
}

}  // namespace isorelax
