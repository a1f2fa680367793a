#include <cmath>
#include <deque>

#include "mesh/parallel.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/newton_block.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

using Field = std::vector<Vec3>;  // one vector per vertex, zero where nothing may move

/// Share of a proposed step below which what was accepted of it counts as nothing.
constexpr double kUseless = 0.02;

/// A move and the change of the gradient along it.
struct Pair {
  Field move, change;
  double curvature;  // move . change > 0
};

class LbfgsSmoother : public GuardedSmoother {
 public:
  LbfgsSmoother(const SmoothingProblem& problem, const LbfgsOptions& options)
      : GuardedSmoother(problem, options.detail),
        memory_(options.memory),
        partials_(block_count(problem.vertex_count())),
        tangent_(problem.vertex_count()),
        axes_(problem.vertex_count()) {}

 private:
  /// The first step is a Newton step, in which every vertex may be cut back alone.
  [[nodiscard]] bool cuts_all_alike() const override { return !pairs_.empty(); }

  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    gather(positions, here, record);
    remember(positions);
    Field& d = record.displacement;
    d = tangent_;
    std::vector<double> alphas(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alphas[k] = dot(pairs_[k].move, d) / pairs_[k].curvature;
      add(d, -alphas[k], pairs_[k].change);
    }
    for_vertices([&](Index v) { d[v] = NewtonBlock(problem_, here, positions, v, axes_[v]).solve(d[v]); });
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double beta = dot(pairs_[k].change, d) / pairs_[k].curvature;
      add(d, alphas[k] - beta, pairs_[k].move);
    }
    for_vertices([&](Index v) { d[v] = -tangent_part(problem_.mobility[v], axes_[v], d[v]); });
    if (!(dot(d, tangent_) < 0)) start_afresh(positions, here, d);
    finish_proposal(record);
    return std::sqrt(dot(tangent_, tangent_));
  }

  void gather(std::span<const Vec3> positions, const Objective& here, StepRecord& record) {
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      std::array<VertexSums, kLanes> sums;
      for (std::size_t first = begin; first < end; first += kLanes) {
        const std::size_t count = std::min<std::size_t>(kLanes, end - first);
        for (std::size_t i = 0; i < count; ++i) sums[i] = here.gather(static_cast<Index>(first + i));
        const auto axes =
            tangent_axes(problem_, positions, static_cast<Index>(first), std::span(sums).first(count));
        for (std::size_t i = 0; i < count; ++i) {
          record.gradient[first + i] = sums[i].gradient;
          axes_[first + i] = axes[i];
          tangent_[first + i] = tangent_part(problem_.mobility[first + i], axes[i], sums[i].gradient);
        }
      }
    });
  }

  /// Adds the last move to the memory if the energy curves upward along it.
  void remember(std::span<const Vec3> positions) {
    if (!last_positions_.empty()) {
      Pair pair{Field(positions.begin(), positions.end()), tangent_, 0};
      add(pair.move, -1, last_positions_);
      add(pair.change, -1, last_tangent_);
      pair.curvature = dot(pair.move, pair.change);
      const double scale = std::sqrt(dot(pair.move, pair.move) * dot(pair.change, pair.change));
      // A step of which next to nothing was accepted: what is remembered does not fit here.
      if (dot(pair.move, pair.move) < kUseless * kUseless * proposed_squares_) {
        pairs_.clear();
      } else if (pair.curvature > 1e-8 * scale) {
        if (pairs_.size() == memory_) pairs_.pop_front();
        pairs_.push_back(std::move(pair));
      }
    }
    last_positions_.assign(positions.begin(), positions.end());
    last_tangent_ = tangent_;
  }

  /// The remembered curvature pointed uphill: the preconditioned gradient never does.
  void start_afresh(std::span<const Vec3> positions, const Objective& here, Field& d) {
    pairs_.clear();
    for_vertices(
        [&](Index v) { d[v] = -NewtonBlock(problem_, here, positions, v, axes_[v]).solve(tangent_[v]); });
  }

  void finish_proposal(StepRecord& record) {
    const double small = smallest_move();
    // The preconditioner alone overshoots where neighbours move at once.
    const double factor = pairs_.empty() ? NewtonOptions{}.relaxation : 1;
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      Vec3& d = record.displacement[v];
      d *= factor;
      if (problem_.mobility[v] == Mobility::none || d.squaredNorm() > small * small) continue;
      d.setZero();
      record.limits[v] |= kLimitConverged;
    }
    proposed_squares_ = dot(record.displacement, record.displacement);
  }

  template <typename Body>
  void for_vertices(const Body& body) const {
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) body(static_cast<Index>(v));
    });
  }

  [[nodiscard]] double dot(const Field& a, const Field& b) {
    parallel_for_blocks(a.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t v = begin; v < end; ++v) sum += a[v].dot(b[v]);
      partials_[begin / kBlockSize] = sum;
    });
    double sum = 0;
    for (const double partial : partials_) sum += partial;
    return sum;
  }

  void add(Field& to, double factor, const Field& what) const {
    for_vertices([&](Index v) { to[v] += factor * what[v]; });
  }

  std::size_t memory_;
  std::vector<double> partials_;
  Field tangent_, axes_;
  Field last_positions_, last_tangent_;
  double proposed_squares_ = 0;
  std::deque<Pair> pairs_;
};

}  // namespace

std::unique_ptr<Smoother> make_lbfgs(const SmoothingProblem& problem, const LbfgsOptions& options) {
  return std::make_unique<LbfgsSmoother>(problem, options);
}

}  // namespace isorelax
