#pragma once

#include "model/redo.h"
#include "model/scan.h"
#include "model/timeline.h"
#include "model/trace_jobs.h"

namespace isorelax::model {

struct SeekRequest {
  std::uint64_t number = 0;
  DocumentPtr document;
  SmoothingSettings settings;  ///< whose energy is measured
  Place place;
  unsigned shown = 0;  ///< iteration on the timeline
  std::vector<Place> others;
};
/// Finds the positions of an iteration and measures them: Sought or Failed.
[[nodiscard]] Engine::Job seek_job(SeekRequest request);

struct InspectRequest {
  std::uint64_t number = 0;
  DocumentPtr document;
  SmoothingSettings settings;  ///< of the recording
  Place place;  ///< after the step; its iteration is 1 or more, or the step is still to be made
  std::optional<Index> vertex, triangle;
  bool inside = false;  ///< the mesh before the step is to be shown
  std::size_t step_budget = StepStore::kDefaultBudget;
};
/// Finds the full record of a step, by doing it again where it is not kept: Inspected or Failed.
[[nodiscard]] Engine::Job inspect_job(InspectRequest request);

struct ScanRequest {
  DocumentPtr document;
  SmoothingSettings settings;
  std::shared_ptr<Recording> recording;
  unsigned start = 0;  ///< of the branch, on the timeline
  ScanRange range;
};
/// Looks whether breakpoints hold at recorded iterations: Scanned or RunFailed.
[[nodiscard]] Engine::Job scan_job(ScanRequest request);

struct FollowRequest {
  std::uint64_t number = 0;
  unsigned branch = 0;
  Index vertex = 0;
  Path path;
};
/// Where a vertex was: Followed. Gives way to other jobs, and then publishes nothing.
[[nodiscard]] Engine::Job follow_job(FollowRequest request);

/// What a step's record says, without its arrays.
[[nodiscard]] StepSummary summary_of(const StepRecord& record, unsigned iteration, std::size_t vertices);

}  // namespace isorelax::model
