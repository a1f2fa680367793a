#pragma once

#include "model/redo.h"

namespace isorelax::model {

/// A branch as a recorded run of its own, from iteration 0 on.
struct PathRequest {
  DocumentPtr document;
  std::vector<Place> segments;  ///< each from the end of the one before to its iteration
};

/// The positions of a path, one iteration after the other: visit(positions, numbers), with null at its start.
/// Without a document nothing is visited for a segment that has not begun. Throws Error for a damaged delta.
void walk(const Document* document, std::span<const Place> segments,
          const std::function<void(const std::vector<Vec3>&, const TraceIteration*)>& visit);

/// A path as one trace whose parts say what its iterations are made with. Throws Error.
[[nodiscard]] Trace joined(const PathRequest& path);

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

}  // namespace isorelax::model
