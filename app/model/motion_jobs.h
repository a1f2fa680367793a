#pragma once

#include "model/engine.h"
#include "model/recording.h"
#include "model/timeline_jobs.h"
#include "motion/motion_share.h"

namespace isorelax::model {

/// A time of a motion for people: four digits that count.
[[nodiscard]] std::string time_text(double time);

struct MotionRequest {
  DocumentPtr document;
  MotionChoices motion;
  SmoothingSettings settings;         ///< stand in the states
  MeshStatePtr start;                 ///< where the motion begins; of a recording that goes on, what is shown
  std::optional<SphereStart> sphere;  ///< what `start` is
  unsigned steps = 0;                 ///< 0: to the end
  unsigned series = 0;                ///< for the rows
  std::shared_ptr<Recording> recording;  ///< a new one begins at the start
  unsigned branch = 0;
  unsigned first = 0;  ///< the iteration of the timeline at which the motion begins
  std::vector<Breakpoint> breakpoints;
};
/// Moves the surface: Moved as often as the view keeps up, then MotionEnded; or RunFailed, what was recorded
/// before having come with a last Moved.
[[nodiscard]] Engine::Job motion_job(MotionRequest request);

struct MotionInspectRequest {
  std::uint64_t number = 0;
  DocumentPtr document;
  std::shared_ptr<Recording> recording;
  unsigned step = 0;  ///< of the recording: the one that led to what is shown; 0: the start is
  StepPlace place;
  std::optional<Index> vertex, triangle;
};
/// What the shown step did to a vertex, or a triangle as it stands: MotionInspected or Failed.
[[nodiscard]] Engine::Job motion_inspect_job(MotionInspectRequest request);

struct MotionFollowRequest {
  std::uint64_t number = 0;
  unsigned branch = 0;
  Index vertex = 0;
  std::shared_ptr<Recording> recording;
  std::vector<StepPlace> places;  ///< of its steps
};
/// The way of a vertex: MovingPath. Gives way to other jobs, and then publishes nothing.
[[nodiscard]] Engine::Job motion_follow_job(MotionFollowRequest request);

struct MotionScanRequest {
  std::shared_ptr<Recording> recording;
  unsigned first = 0;         ///< the iteration of the timeline at which the motion begins
  std::vector<double> times;  ///< of the recording's states
  ScanRange range;
};
/// Looks whether breakpoints hold at recorded steps: Scanned or RunFailed.
[[nodiscard]] Engine::Job motion_scan_job(MotionScanRequest request);

/// A step of a moving surface as predicates see it: moves, and nothing that a smoother would know.
[[nodiscard]] StepRecord record_of_motion(std::span<const Vec3> before, std::span<const Vec3> after);

}  // namespace isorelax::model
