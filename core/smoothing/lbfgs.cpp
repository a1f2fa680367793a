#include <algorithm>
#include <cmath>

#include "smoothing/guarded_smoother.h"
#include "smoothing/lbfgs_memory.h"
#include "smoothing/renumbered_smoother.h"

namespace isorelax {
namespace {

/// Share of a proposed step below which what was accepted of it counts as nothing.
constexpr double kUseless = 0.02;
/// Share of its proposed move that a vertex must have made, relative to the vertex that made most of its own,
/// to be moved together with all others again.
constexpr double kBlockedShare = 0.3;
/// Directions for all that come after one that was far too long (kManyFolds) reach less far, by kShorter, and
/// so much farther again while they lead on.
constexpr double kLonger = 2;
/// Rounds against a rising energy after which what is remembered does not fit, either.
constexpr unsigned kMostEnergyRounds = 2;
/// Steps after which the second level of the preconditioner is made anew, and the Newton blocks too where no
/// tangent space changes.
constexpr unsigned kPreconditionerSteps = 10;

class LbfgsSmoother : public GuardedSmoother {
 public:
  LbfgsSmoother(const SmoothingProblem& problem, const LbfgsOptions& options)
      : GuardedSmoother(problem, StepKind::lbfgs, options.detail),
        in_fixed_planes_(problem.plane_normal && problem.border.empty()),
        sweep_(problem),
        memory_(problem.vertex_count(), options.memory, problem.threads),
        tangent_(problem.vertex_count()),
        wanted_(problem.vertex_count()),
        blocks_(problem.vertex_count()),
        squares_(block_count(problem.vertex_count())) {}

 private:
  /// The first step is a Newton step, in which every vertex may be cut back alone.
  [[nodiscard]] bool cuts_all_alike() const override { return !memory_.empty(); }

  [[nodiscard]] bool go_together() const override { return is_joint_; }

  double propose(std::span<const Vec3> positions, const Objective& here, StepRecord& record) override {
    const bool keeps_blocks = continues() && in_fixed_planes_ && steps_ % kPreconditionerSteps != 0;
    const double norm = sweep_.run(here, positions, [&](const TangentBatch& batch) {
      for (unsigned i = 0; i < batch.count; ++i) {
        record.gradient[batch.vertices[i]] = batch.sums[i].gradient;
        tangent_[batch.vertices[i]] = batch.gradients[i];
      }
      if (keeps_blocks) return;
      const auto blocks = newton_blocks(problem_, here, batch);
      for (unsigned i = 0; i < batch.count; ++i) blocks_[batch.vertices[i]] = blocks[i];
    });
    if (!continues()) {
      memory_.start_anew();
      proposal_.clear();
      coarse_.emplace(problem_, here);
      steps_ = 0;
    }
    if (steps_++ % kPreconditionerSteps == 0) coarse_->refresh(here, blocks_);
    find_blocked(positions);
    find_reach();
    memory_.arrive(positions, tangent_, wanted_, kUseless * proposed_);
    if (continues() && last_energy_rounds() > kMostEnergyRounds) memory_.clear();
    find_direction(record);
    finish_proposal(record);
    last_.assign(positions.begin(), positions.end());
    proposal_ = record.displacement;
    return norm;
  }

  /// Vertices that could not go where they were sent, because a triangle would have folded, would be sent
  /// there again, and without them the others' moves do not lead downhill: they go on their own until they
  /// get free.
  void find_blocked(std::span<const Vec3> positions) {
    wanted_ = tangent_;
    blocked_.clear();
    if (proposal_.empty()) return;
    const auto share2 = [&](Index v) {
      const double asked2 = proposal_[v].squaredNorm();
      return asked2 > 0 ? (positions[v] - last_[v]).squaredNorm() / asked2 : 0;
    };
    double best2 = 0;
    for (Index v = 0; v < problem_.vertex_count(); ++v) best2 = std::max(best2, share2(v));
    for (Index v = 0; v < problem_.vertex_count(); ++v) {
      if (proposal_[v].isZero(0) || share2(v) >= kBlockedShare * kBlockedShare * std::min(best2, 1.0))
        continue;
      blocked_.push_back(v);
      wanted_[v].setZero();
    }
  }

  void find_reach() {
    if (!continues()) reach_ = 1;
    if (!is_joint_ || proposal_.empty()) return;
    const bool too_far = static_cast<double>(last_folded()) > kManyFolds * problem_.vertex_count();
    reach_ = too_far ? kShorter * reach_ : std::min(1.0, kLonger * reach_);
  }

  void find_direction(StepRecord& record) {
    // A memory that was cleared on the way had gone wrong: one step in which every vertex sees only its own.
    CoarseCorrection* coarse = memory_.empty() && steps_ > 1 ? nullptr : &*coarse_;
    is_joint_ = coarse != nullptr;
    if (!(memory_.direction(wanted_, blocks_, coarse, record.displacement) < 0)) {
      // The remembered curvature pointed uphill: the preconditioned gradient never does.
      memory_.clear();
      memory_.direction(wanted_, blocks_, nullptr, record.displacement);
      is_joint_ = false;
    }
  }

  void finish_proposal(StepRecord& record) {
    // The preconditioner alone overshoots where neighbours move at once.
    const double alone = NewtonOptions{}.relaxation;
    for (const Index v : blocked_) record.displacement[v] = -alone * blocks_[v].solve(tangent_[v]);
    const double factor = (memory_.empty() ? alone : 1) * (is_joint_ ? reach_ : 1);
    parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
      double squares = 0;
      for (std::size_t v = begin; v < end; ++v) {
        set_move(record, static_cast<Index>(v), factor * record.displacement[v]);
        squares += record.displacement[v].squaredNorm();
      }
      squares_[begin / kBlockSize] = squares;
    });
    double squares = 0;
    for (const double s : squares_) squares += s;
    proposed_ = std::sqrt(squares);
  }

  bool in_fixed_planes_;  // no tangent space changes
  TangentSweep sweep_;
  LbfgsMemory memory_;
  std::optional<CoarseCorrection> coarse_;
  unsigned steps_ = 0;
  Field tangent_, wanted_;  // the gradient, and its part at vertices that are not blocked
  Field proposal_;          // the last step as proposed
  std::vector<Vec3> last_;  // where it started
  std::vector<Index> blocked_;
  std::vector<NewtonBlock> blocks_;
  std::vector<double> squares_;
  double proposed_ = 0;    // length of the last step as proposed
  bool is_joint_ = false;  // whether vertices were sent together: by what is remembered, or the second level
  double reach_ = 1;       // share of such a direction that is tried
};

}  // namespace

std::unique_ptr<Smoother> make_lbfgs(const SmoothingProblem& problem, const LbfgsOptions& options) {
  return make_near_in_memory(problem, [=](const SmoothingProblem& numbered) {
    return std::make_unique<LbfgsSmoother>(numbered, options);
  });
}

}  // namespace isorelax
