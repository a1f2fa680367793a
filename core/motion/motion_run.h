#pragma once

#include <optional>

#include "motion/dense_copy.h"
#include "motion/motion_choices.h"
#include "motion/motion_measure.h"

namespace isorelax {

/// What is known about a moving mesh after one step.
struct MotionEntry {
  std::size_t step = 0;
  double time = 0;
  MotionMeasure measure;
  double volume_change = 0;  ///< (now - start) / start; 0 for a start that encloses none
  bool encloses = false;     ///< the start encloses a volume
  MovingReport report;
  /// Where the exact motion is known, length units: of vertices that go with the flow from where it takes
  /// them, of others from where it takes the start surface's points nearest to them.
  std::optional<Distances> error;
  std::optional<std::pair<Distances, Distances>> exact;  ///< from the dense copy, and of it
  double seconds = 0;                                    ///< of the step, without what is measured
};

/// Runs a set-up step by step and measures.
class MotionRun {
 public:
  /// `dense_levels`: of the dense copy; none where 0. Throws as MovingSurface.
  MotionRun(MotionSetup setup, unsigned dense_levels);

  [[nodiscard]] const MotionSetup& setup() const { return setup_; }
  [[nodiscard]] const MovingSurface& surface() const { return surface_; }
  [[nodiscard]] bool done() const { return !(surface_.state().time < setup_.until); }
  /// The mesh now, without attributes.
  [[nodiscard]] TriangleMesh mesh() const;

  /// Takes up a state of an earlier run.
  void restore(const MovingState& state);
  /// One step. Throws MotionError.
  void advance();
  /// Measures the state; the dense copy only when asked to (it is slow).
  enum class Detail { plain, exact };
  [[nodiscard]] MotionEntry measure(Detail detail) const;

 private:
  [[nodiscard]] std::optional<Distances> known_error() const;
  [[nodiscard]] Distances error_of_place() const;

  MotionSetup setup_;
  MovingSurface surface_;
  std::optional<DenseCopy> dense_;
  SurfacePlacement nearest_;  ///< of the start surface's points; null where none is asked for
  double start_volume_ = 0;
  bool encloses_ = false;
  double seconds_ = 0;
};

}  // namespace isorelax
