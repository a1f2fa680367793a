#include "smoothing/even_out.h"

#include "mesh/parallel.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/renumbered_smoother.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

/// Sweeps over all vertices that make one step.
constexpr unsigned kSweeps = 20;

class EvenOutSmoother : public GuardedSmoother {
 public:
  EvenOutSmoother(const SmoothingProblem& problem, RecordDetail detail)
      : GuardedSmoother(problem, StepKind::even_out, detail, StepGuard::all_or_nothing),
        sweep_(problem),
        axes_(problem.vertex_count()),
        x_(problem.vertex_count()),
        next_(problem.vertex_count()) {
    find_neighbours();
  }

 private:
  /// Inside, the triangles about a vertex name each neighbour once as the next one; at a border, where they
  /// leave one out, those inside are named twice.
  void find_neighbours() {
    offsets_.push_back(0);
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      for (const Corner c : problem_.topology.corners_of(v)) {
        const Triangle& t = problem_.triangles[c / 3];
        neighbours_.push_back(t[next(c % 3)]);
        if (problem_.topology.is_boundary(v)) neighbours_.push_back(t[previous(c % 3)]);
      }
      offsets_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }
  }

  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const double norm = sweep_.find_tangents(here, positions, record.gradient, axes_);
    x_.assign(positions.begin(), positions.end());
    for (unsigned k = 0; k < kSweeps; ++k) {
      for_vertices([&](Index v) { next_[v] = swept(v); });
      x_.swap(next_);
    }
    for_vertices([&](Index v) { set_move(record, v, x_[v] - positions[v]); });
    return norm;
  }

  template <typename Body>
  void for_vertices(const Body& body) const {
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) body(static_cast<Index>(v));
    });
  }

  /// The mean of the neighbours, as far as the tangent space leads there.
  [[nodiscard]] Vec3 swept(Index v) const {
    const Mobility mobility = problem_.mobility[v];
    if (mobility == Mobility::none) return x_[v];
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = offsets_[v]; i < offsets_[v + 1]; ++i) sum += x_[neighbours_[i]];
    const Vec3 mean = sum / static_cast<double>(offsets_[v + 1] - offsets_[v]);
    return x_[v] + tangent_part(mobility, axes_[v], mean - x_[v]);
  }

  TangentSweep sweep_;
  std::vector<Vec3> axes_;
  std::vector<std::uint32_t> offsets_;  // of each vertex' neighbours, one more at the end
  std::vector<Index> neighbours_;
  std::vector<Vec3> x_, next_;
};

}  // namespace

bool wants_even(const SmoothingProblem& problem) {
  return problem.reference.is_uniform() && problem.weights.area <= problem.weights.shape &&
         problem.exponent <= kDefaultExponent;
}

std::unique_ptr<Smoother> make_even_out(const SmoothingProblem& problem, RecordDetail detail) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<EvenOutSmoother>(numbered, detail);
  });
}

}  // namespace isorelax
