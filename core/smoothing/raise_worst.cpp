#include <algorithm>
#include <array>
#include <cmath>

#include "smoothing/group_climb.h"
#include "smoothing/polish_state.h"

namespace isorelax {
namespace {

/// Stages of one kind: how sharp the soft minimum is in each, per degree, and the most steps of all of them.
struct WorstRound {
  bool in_groups;
  std::span<const double> sharpness;
  unsigned most_steps;
};
constexpr std::array kSharpness = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
constexpr std::array kGroupSharpness = {2.0, 4.0, 8.0, 16.0, 32.0};
constexpr std::array kWorstRounds = {WorstRound{false, kSharpness, 300},
                                     WorstRound{true, kGroupSharpness, 100}};
/// A stage of single vertices ends after this many steps, or when in this many in a row neither of the worst
/// angles, nor the soft minimum of all scores, gains kGain degrees; one of groups when no group gains that.
constexpr unsigned kStageSteps = 60;
constexpr unsigned kPolishIdleSteps = 5;
constexpr double kGain = 0.002;
/// Groups go through their stages again after a round that gained more.
constexpr double kRoundGain = 0.02;
/// Triangles within this many degrees of the worst are treated; halved where the mean would fall too
/// far, down to the least.
constexpr double kWindow = 5;
constexpr double kLeastWindow = 0.5;
/// In groups, those within this many.
constexpr double kGroupWindow = 3;
constexpr unsigned kStepsPerVisit = 2;
/// Degrees of the mean that may be lost for the sake of triangles that are not the worst.
constexpr double kFreeLoss = 0.1;

class RaiseWorst : public PolishGoalSweeps {
 public:
  explicit RaiseWorst(const PolishOptions& options) : options_(options) {}

  bool sweep(PolishState& state) override {
    if (!goal_) begin(state);
    while (round_ < kWorstRounds.size()) {
      if (done_ == round().most_steps) {
        begin_round(round_ + 1);
        continue;
      }
      if (round().in_groups ? sweep_groups(state) : sweep_singles(state)) {
        ++done_;
        return true;
      }
    }
    return false;
  }

 private:
  void begin(PolishState& state) {
    worst_ = state.worst();
    before_ = reached_ = worst_;
    goal_ = {worst_, options_.obtuse_weight};
    mean_ = state.mean();
    const auto triangles = static_cast<Index>(state.problem().triangle_count());
    for (Index t = 0; t < triangles; ++t) count_ += state.can_change(t) ? 1 : 0;
    bounds_.assign(triangles, worst_);
    groups_.emplace(state.problem());
  }

  [[nodiscard]] const WorstRound& round() const { return kWorstRounds.at(round_); }
  [[nodiscard]] double sharpness() const { return round().sharpness[stage_]; }

  void begin_round(std::size_t number) {
    if (number != round_) done_ = 0;
    round_ = number;
    stage_ = 0;
    before_ = reached_ = worst_;
  }

  void end_stage() {
    steps_ = idle_ = 0;
    reached_ = worst_;
    if (++stage_ == round().sharpness.size()) end_round();
  }

  void end_round() {
    const bool gained = worst_.min > before_.min + kRoundGain || worst_.max < before_.max - kRoundGain;
    begin_round(round().in_groups && gained ? round_ : round_ + 1);
  }

  /// False if that came to nothing, and another stage or fewer triangles are next.
  bool sweep_singles(PolishState& state) {
    worst_ = state.worst();
    const AngleRange before = worst_;
    const std::vector<Vec3> start = state.positions();
    const double merit_before = merit(state);
    double largest = 0;
    for (const Index v : vertices_in_order(state)) largest = std::max(largest, visit(state, v));
    worst_ = state.worst();
    if (mean_ - state.mean() > allowed_loss()) {
      // Back to where the step began, and on with fewer triangles.
      state.start(start);
      worst_ = before;
      window_ /= 2;
      if (window_ < kLeastWindow) end_round();
      return false;
    }
    const bool gained = worst_.min > before.min + kGain || worst_.max < before.max - kGain;
    const bool idle = !gained && merit(state) < merit_before + kGain;
    idle_ = idle ? idle_ + 1 : 0;
    if (largest > 0 && ++steps_ < kStageSteps && idle_ < kPolishIdleSteps) return true;
    end_stage();
    return largest > 0;
  }

  /// Scores are those beyond what was reached before this stage, and nothing gets worse than that.
  bool sweep_groups(PolishState& state) {
    worst_ = state.worst();
    std::vector<std::uint8_t> flags(bounds_.size(), 0);
    for (Index t = 0; t < flags.size(); ++t)
      flags[t] = state.can_change(t) && lead(state.range(t)) <= kGroupWindow ? 1 : 0;
    const double spare = std::max(0.0, state.mean() - mean_ + allowed_loss());
    const double gain = groups_->sweep(
        state, {{reached_, options_.obtuse_weight}, sharpness(), reached_, spare * count_}, flags);
    worst_ = state.worst();
    if (gain < kGain) end_stage();
    return gain > 0;
  }

  /// Where the worst of all gain nothing, the next ones are not worth much of the mean.
  [[nodiscard]] double allowed_loss() const {
    const double gain = std::max(worst_.min - goal_->start.min, goal_->start.max - worst_.max);
    return std::min(options_.largest_mean_loss, kFreeLoss + gain);
  }

  /// How far a triangle is from the worst of the mesh, in the angle in which it is nearer: where the largest
  /// angle of all can fall no more, the smallest can still rise.
  [[nodiscard]] double lead(const AngleRange& range) const {
    return std::min(goal_->of_small(range.min) - goal_->of_small(worst_.min),
                    goal_->of_large(range.max) - goal_->of_large(worst_.max));
  }

  /// The soft minimum of the scores of all triangles, in degrees, as sharp as this stage.
  [[nodiscard]] double merit(const PolishState& state) const {
    const double sharpness = this->sharpness();
    double sum = 0;
    const double worst = std::min(goal_->of_small(worst_.min), goal_->of_large(worst_.max));
    for (Index t = 0; t < state.problem().triangle_count(); ++t) {
      if (!state.can_change(t)) continue;
      const AngleRange& range = state.range(t);
      const double score = std::min(goal_->of_small(range.min), goal_->of_large(range.max));
      sum += std::exp(-sharpness * (score - worst));
    }
    return worst - std::log(sum) / sharpness;
  }

  /// Free vertices of the triangles to be treated, those of the worst triangles first.
  [[nodiscard]] std::vector<Index> vertices_in_order(const PolishState& state) const {
    const SmoothingProblem& problem = state.problem();
    std::vector<std::pair<double, Index>> led;
    for (Index t = 0; t < problem.triangle_count(); ++t) {
      if (!state.can_change(t) || lead(state.range(t)) > window_) continue;
      for (const Index v : problem.triangles[t])
        if (problem.mobility[v] != Mobility::none) led.emplace_back(lead(state.range(t)), v);
    }
    std::sort(led.begin(), led.end());
    std::vector<Index> order;
    std::vector<std::uint8_t> seen(problem.vertex_count(), 0);
    for (const auto& [lead, v] : led) {
      if (seen[v] == 0) order.push_back(v);
      seen[v] = 1;
    }
    return order;
  }

  /// Moves a vertex to where the triangles around it are better, if it can. Returns how far.
  double visit(PolishState& state, Index v) {
    if (state.is_stuck(v)) return 0;  // with sharper minima, too
    AngleRing& ring = state.look_at(v);
    ring.aim_at(*goal_);
    const Vec3 start = state.positions()[v];
    Vec3 at = start;
    // What a blunt minimum asks for may be too bad for the worst triangle: then a sharper one decides.
    for (std::size_t s = stage_; s < kSharpness.size() && at == start; ++s) {
      for (unsigned i = 0; i < kStepsPerVisit; ++i)
        if (!climb(state, ring, v, kSharpness[s], at)) break;
    }
    if (at != start) return state.move(v, at);
    state.note_stuck(v);
    return 0;
  }

  /// One step of a vertex from `at` to a higher soft minimum. False if there is none.
  bool climb(PolishState& state, AngleRing& ring, Index v, double sharpness, Vec3& at) {
    const auto value = [&](const Vec3& there) { return ring.soft_minimum_value(there, sharpness); };
    const auto there = state.climb(v, at, ring.soft_minimum(at, sharpness), value, bounds_);
    if (there) at = *there;
    return there.has_value();
  }

  PolishOptions options_;
  std::optional<AngleGoal> goal_;
  std::optional<GroupClimb> groups_;
  std::vector<AngleRange> bounds_;                 // no angle gets worse than the worst at the start
  AngleRange worst_{0, 180};                       // of the mesh now
  AngleRange before_ = worst_, reached_ = worst_;  // before this round, this stage
  double count_ = 0;                               // of triangles that can change
  double mean_ = 0;                                // of their smallest angles at the start
  double window_ = kWindow;
  std::size_t round_ = 0, stage_ = 0;
  unsigned steps_ = 0, idle_ = 0, done_ = 0;  // of the stage; of the round
};

}  // namespace

std::unique_ptr<PolishGoalSweeps> raise_worst(const PolishOptions& options) {
  return std::make_unique<RaiseWorst>(options);
}

}  // namespace isorelax
