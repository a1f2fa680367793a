#pragma once

#include "model/redo.h"

namespace isorelax::model {

/// The way to an iteration from 0 on: the places at which its segments end. Each begins where the one before
/// ends.
using Path = std::vector<Place>;

/// Visits the positions of a path, one iteration after the other, from its start on. Throws Error for a
/// damaged delta.
void walk(const Path& path, const std::function<void(const std::vector<Vec3>&)>& visit);

/// A path as one trace whose parts say what its iterations are made with. Throws Error.
[[nodiscard]] Trace joined(const Path& path);

/// Writes a branch as a trace file: Wrote or Failed.
[[nodiscard]] Engine::Job save_trace_job(Path path, std::filesystem::path file);
/// Compares two branches: Compared or Failed.
[[nodiscard]] Engine::Job compare_job(Path first, Path second, unsigned first_branch, unsigned second_branch);

/// Reads a recorded run: TraceOpened or Failed. With a document, whose triangles it must have, it joins the
/// document's timeline.
[[nodiscard]] Engine::Job open_trace_job(std::filesystem::path path, DocumentPtr document);

}  // namespace isorelax::model
