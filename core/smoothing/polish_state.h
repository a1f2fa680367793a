#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "smoothing/angle_ring.h"
#include "smoothing/bounded_run.h"
#include "smoothing/step_record.h"
#include "smoothing/surface_limit.h"

namespace isorelax {

/// The mesh as the last stage sees it: where the vertices are by now, the extreme angles of the triangles
/// that can change, and the bounds that every move keeps. Keeps a reference to the problem.
class PolishState {
 public:
  explicit PolishState(const SmoothingProblem& problem);

  /// Goes to these positions and measures all angles there.
  void start(std::span<const Vec3> positions);

  [[nodiscard]] const SmoothingProblem& problem() const { return problem_; }
  [[nodiscard]] const std::vector<Vec3>& positions() const { return x_; }
  /// Whether a triangle is treated and can change: what the others are like is not up to us.
  [[nodiscard]] bool can_change(Index triangle) const { return can_change_[triangle] != 0; }
  /// The extreme angles of a triangle that can change.
  [[nodiscard]] const AngleRange& range(Index triangle) const { return ranges_[triangle]; }
  /// The smallest and the largest angle of all of them.
  [[nodiscard]] AngleRange worst() const;
  /// The mean of their smallest angles.
  [[nodiscard]] double mean() const;

  /// The triangles around this vertex as they are.
  AngleRing& look_at(Index vertex);
  /// Where one step of the looked-at vertex leads that raises `value`, of which `soft` tells the slope at
  /// `at`, if one does. No triangle turns over or gets angles beyond its bounds (by number), and the surface
  /// stays as near to where it was as it has to.
  [[nodiscard]] std::optional<Vec3> climb(Index vertex, const Vec3& at, const AngleRing::Soft& soft,
                                          const std::function<double(const Vec3&)>& value,
                                          std::span<const AngleRange> bounds);
  /// Bits of Limit that the last climb met with.
  [[nodiscard]] std::uint16_t held_back() const { return held_back_; }
  /// Moves the looked-at vertex. Returns how far.
  double move(Index vertex, const Vec3& there);

  /// Moves these vertices to where they are in `there`, by number, all or none. None where a triangle would
  /// turn over or the surface leave where it has to stay, on the way as well, one vertex after another.
  bool move_together(std::span<const Index> vertices, std::span<const Vec3> there);

  /// Notes that no climb of the looked-at vertex leads anywhere. One that asks for no more need not be tried
  /// before something around the vertex has changed.
  void note_stuck(Index vertex) { stuck_at_[vertex] = clock_; }
  [[nodiscard]] bool is_stuck(Index vertex) const { return stuck_at_[vertex] >= changed_at_[vertex]; }

  /// Says in the record how all vertices got here from `positions`, and is from now on where the record
  /// leads: the same up to rounding. Returns the triangles that have changed.
  std::vector<Index> settle(std::span<const Vec3> positions, StepRecord& record);

 private:
  void measure(Index triangle);
  void note_change(Index vertex);
  /// What holds a vertex back from going there; none where it may.
  enum class Hold : std::uint8_t { none, fold, angles, distance };
  /// What a climb starts from.
  struct Climb {
    Index vertex;
    const Vec3& at;
    const AngleRing::Soft& soft;
    const std::function<double(const Vec3&)>& value;
    std::span<const AngleRange> bounds;
  };
  [[nodiscard]] NewtonBlock model_of(const Climb& climb) const;
  /// Whether a place is higher, and nothing holds the vertex back from it.
  [[nodiscard]] bool leads_up_to(const Climb& climb, const Vec3& there);
  /// Where a move and its halves lead, if one of them may be made.
  [[nodiscard]] std::optional<Vec3> along(const Climb& climb, const Vec3& move, unsigned halvings);
  [[nodiscard]] std::optional<Vec3> along_bounds(const Climb& climb, const NewtonBlock& model);
  [[nodiscard]] Hold hold_of_triangles(const Vec3& there, std::span<const AngleRange> bounds);
  [[nodiscard]] Hold hold_at(Index vertex, const Vec3& there, std::span<const AngleRange> bounds);
  [[nodiscard]] bool keeps_near(Index vertex, const Vec3& there);

  const SmoothingProblem& problem_;
  AngleRing ring_;
  SurfaceLimit surface_;
  std::vector<std::uint8_t> can_change_;
  std::vector<Vec3> x_;
  std::vector<AngleRange> ranges_;
  std::uint16_t held_back_ = 0;
  Hold hold_ = Hold::none;   // of the last try; none where it was not higher
  std::uint64_t clock_ = 0;  // changes so far
  std::vector<std::uint64_t> changed_at_, stuck_at_;
};

/// One goal of the last stage, sweep by sweep.
class PolishGoalSweeps {
 public:
  PolishGoalSweeps() = default;
  PolishGoalSweeps(const PolishGoalSweeps&) = delete;
  PolishGoalSweeps& operator=(const PolishGoalSweeps&) = delete;
  virtual ~PolishGoalSweeps() = default;

  /// Makes the next sweep over the vertices that moves any. False, with the state as it was, once nothing is
  /// left to do.
  virtual bool sweep(PolishState& state) = 0;
};

std::unique_ptr<PolishGoalSweeps> raise_worst(const PolishOptions& options);
std::unique_ptr<PolishGoalSweeps> raise_mean(const PolishOptions& options);

}  // namespace isorelax
