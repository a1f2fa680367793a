#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"
#include "smoothing/guarded_smoother.h"
#include "smoothing/tangent.h"

namespace isorelax {
namespace {

class JacobiSmoother : public GuardedSmoother {
 public:
  JacobiSmoother(const SmoothingProblem& problem, const JacobiOptions& options)
      : GuardedSmoother(problem, options.detail),
        relaxation_(options.relaxation),
        norm_partials_(block_count(problem.vertex_count())) {}

 private:
  /// Gradient and the displacement of Eq. 9 for every vertex.
  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const double small = smallest_move();
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double squares = 0;
      std::array<VertexSums, kLanes> sums;
      for (std::size_t first = begin; first < end; first += kLanes) {
        const std::size_t count = std::min<std::size_t>(kLanes, end - first);
        for (std::size_t i = 0; i < count; ++i) sums[i] = here.gather(static_cast<Index>(first + i));
        const auto axes =
            tangent_axes(problem_, positions, static_cast<Index>(first), std::span(sums).first(count));
        for (std::size_t i = 0; i < count; ++i) {
          const Index v = static_cast<Index>(first + i);
          const Vec3 tangent = tangent_part(problem_.mobility[v], axes[i], sums[i].gradient);
          squares += tangent.squaredNorm();
          record.gradient[v] = sums[i].gradient;
          Vec3& d = record.displacement[v];
          d = sums[i].stiffness > 0 ? Vec3(-relaxation_ / sums[i].stiffness * tangent) : Vec3::Zero();
          if (problem_.mobility[v] != Mobility::none && d.squaredNorm() <= small * small) {
            d.setZero();
            record.limits[v] |= kLimitConverged;
          }
        }
      }
      norm_partials_[begin / kBlockSize] = squares;
    });
    double squares = 0;
    for (const double partial : norm_partials_) squares += partial;
    return std::sqrt(squares);
  }

  double relaxation_;
  std::vector<double> norm_partials_;
};

}  // namespace

std::unique_ptr<Smoother> make_jacobi(const SmoothingProblem& problem, const JacobiOptions& options) {
  return std::make_unique<JacobiSmoother>(problem, options);
}

}  // namespace isorelax
