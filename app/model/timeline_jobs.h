#pragma once

#include "model/engine.h"
#include "model/timeline.h"

namespace isorelax::model {

/// An iteration of a recording; a null recording is the mesh as opened.
struct Place {
  std::shared_ptr<Recording> recording;
  unsigned iteration = 0;    ///< of the recording, from its start
  std::string not_redone{};  ///< why its steps cannot be done again; empty: they can
};

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
  unsigned branch = 0;
  unsigned start = 0;         ///< of the branch, on the timeline
  unsigned from = 0, to = 0;  ///< on the timeline: from + 1 to `to` are looked at
  std::vector<Breakpoint> breakpoints;
};
/// Looks whether breakpoints hold at recorded iterations: Scanned or RunFailed.
[[nodiscard]] Engine::Job scan_job(ScanRequest request);

struct FollowRequest {
  unsigned branch = 0;
  Index vertex = 0;
  std::vector<Place> segments;  ///< from iteration 0 on: each from the end of the one before to its iteration
  std::vector<unsigned> from;   ///< where in its recording each begins
};
/// Where a vertex was: Followed. Gives way to other jobs, and then publishes nothing.
[[nodiscard]] Engine::Job follow_job(FollowRequest request);

/// A branch as a recorded run of its own, from iteration 0 on.
struct PathRequest {
  DocumentPtr document;
  SmoothingSettings settings;
  std::vector<Place> segments;
  std::vector<unsigned> from;
};
/// Writes a branch as a trace file: Wrote or Failed.
[[nodiscard]] Engine::Job save_trace_job(PathRequest path, std::filesystem::path file);
/// Compares two branches: Compared or Failed.
[[nodiscard]] Engine::Job compare_job(PathRequest first, PathRequest second, unsigned first_branch,
                                      unsigned second_branch);

/// Reads a recorded run: TraceOpened or Failed. With a document, whose triangles it must have, it joins the
/// document's timeline.
[[nodiscard]] Engine::Job open_trace_job(std::filesystem::path path, DocumentPtr document);

/// Whether a file begins as traces do.
[[nodiscard]] bool is_trace(const std::filesystem::path& path);

/// What a step's record says, without its arrays.
[[nodiscard]] StepSummary summary_of(const StepRecord& record, unsigned iteration, std::size_t vertices);

}  // namespace isorelax::model
