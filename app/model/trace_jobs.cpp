#include "model/trace_jobs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/error.h"
#include "model/arguments.h"
#include "trace/position_delta.h"
#include "trace/trace_file.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

bool has_begun(const Place& place) {
  return place.recording && place.recording->has_begun();
}

/// Adds the parts of a recording that made iterations up to `last`, which stand in `whole` after `offset`
/// others.
void add_parts(Trace& whole, const Trace& segment, std::size_t last, std::size_t offset) {
  const bool same_start = same_bits(whole.positions, segment.positions);
  for (const TracePart& part : segment.parts) {
    if (part.done >= last) continue;
    TracePart added = part;
    added.done += offset;
    added.words = words_of(segment, part);
    if (!same_start) added.base = encode_delta(whole.positions, base_of(segment, part));
    whole.parts.push_back(std::move(added));
  }
}

StepSummary recorded_summary(const TraceIteration& step, unsigned iteration, std::size_t vertices) {
  return {.iteration = iteration,
          .kind = step.kind,
          .before = step.before,
          .after = step.after,
          .limits = step.limits,
          .moved = step.moved,
          .vertices = vertices,
          .largest_move = step.largest_move,
          .fold_passes = static_cast<unsigned>(step.fold_passes),
          .energy_passes = static_cast<unsigned>(step.energy_passes)};
}

/// Whether the energy gets another meaning with the step to this iteration.
bool measures_anew(const Trace& trace, unsigned iteration) {
  const TracePart* part = part_of(trace, iteration);
  if (part == nullptr || part->done == 0 || part->done + 1 != iteration) return false;
  const TracePart* before = std::prev(part);
  return part->exponent != before->exponent || words_of(trace, *part) != words_of(trace, *before);
}

/// What the timeline shows of a trace, without going through its positions.
void read_numbers(const Trace& trace, TraceOpened& opened) {
  if (!trace.iterations.empty())
    opened.rows.push_back({0, trace.iterations.front().before.energy, trace.quality.min_angle_deg,
                           trace.quality.max_angle_deg, 0, 0});
  unsigned k = 0;
  unsigned series = 0;
  for (const TraceIteration& step : trace.iterations) {
    ++k;
    if (measures_anew(trace, k)) {  // the iteration before has an energy of each kind
      opened.rows.push_back(opened.rows.back());
      opened.rows.back().energy = step.before.energy;
      opened.rows.back().series = ++series;
    }
    opened.rows.push_back({k, step.after.energy, step.quality.min_angle_deg, step.quality.max_angle_deg,
                           step.largest_move, series});
    opened.steps.push_back(recorded_summary(step, k, trace.positions.size()));
  }
}

DocumentPtr document_of(const Trace& trace, const std::filesystem::path& path) {
  MeshFile file;
  file.mesh.positions = trace.positions;
  file.mesh.triangles = trace.triangles;
  const std::filesystem::path input = trace.input.empty() ? path : std::filesystem::path(trace.input);
  return make_document(input, std::move(file));
}

/// Whether run_bounded makes the steps of this mesh at another size.
bool is_of_extreme_size(const Trace& trace) {
  constexpr int kLargestExponent = 100;
  double largest = 0;
  for (const Vec3& p : trace.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest > 0 && std::abs(std::ilogb(largest)) > kLargestExponent;
}

/// How the trace is understood, with why its steps cannot be made again where it is not. One of which no
/// parts are known gets the part that its words ask for.
ReadAs understand(const Workbench& bench, Trace& trace, TraceOpened& opened) {
  const bool knows_parts = !trace.parts.empty();
  if (!knows_parts) trace.parts.emplace_back();
  ReadAs as;
  try {
    as.plans = bench.read_plans(trace);
    if (!knows_parts)
      trace.parts.front().exponent = as.plans.front()->problem.exponent.value_or(kDefaultExponent);
  } catch (const Error& error) {
    opened.not_redone = error.what();
  }
  if (opened.not_redone.empty() && !trace.parts.front().words && is_of_extreme_size(trace))
    opened.not_redone = "the mesh is of extreme size, its steps were made at a size near one";
  SmoothingSettings nearest = nearest_settings(trace.arguments, {}, opened.unknown_words);
  if (std::ranges::find(trace.arguments, "--exponent") == trace.arguments.end())
    nearest.exponent = trace.parts.back().exponent;
  as.settings = opened.settings = nearest;
  as.exact = opened.unknown_words.empty() &&
             std::ranges::none_of(trace.parts, [](const TracePart& part) { return part.words.has_value(); });
  return as;
}

}  // namespace

void walk(const Path& path, const std::function<void(const std::vector<Vec3>&)>& visit) {
  bool started = false;
  for (const Place& segment : path) {
    if (!has_begun(segment)) continue;
    std::vector<Vec3> positions = segment.recording->positions_at(0);
    if (!std::exchange(started, true)) visit(positions);
    for (unsigned k = 0; k < segment.iteration; ++k) {
      if (!apply_delta(segment.recording->trace().iterations[k].delta, positions))
        throw Error("the recording is damaged");
      visit(positions);
    }
  }
}

Trace joined(const Path& path) {
  const auto first = std::ranges::find_if(path, has_begun);
  if (first == path.end()) throw Error("there is no run to save yet");
  Trace whole;
  const Trace& start = first->recording->trace();
  if (path.size() == 1 && !first->recording->can_grow()) return start;  // as it was read
  whole.positions = start.positions;
  whole.triangles = start.triangles;
  whole.quality = start.quality;
  for (const Place& segment : path) {
    if (!has_begun(segment)) continue;
    // Iterations share nothing with the recording's: deltas are copied.
    const Trace& part = segment.recording->trace();
    add_parts(whole, part, segment.iteration, whole.iterations.size());
    whole.iterations.insert(whole.iterations.end(), part.iterations.begin(),
                            part.iterations.begin() + segment.iteration);
    static_cast<RunWords&>(whole) = part;
    whole.program = part.program;
    whole.input = part.input;
    whole.stopped = part.stopped;
    whole.stopped_because = part.stopped_because;
  }
  return whole;
}

Engine::Job save_trace_job(Path path, std::filesystem::path file) {
  return [path = std::move(path), file = std::move(file)](const JobContext& context) {
    context.progress("Saving " + file.filename().string(), -1);
    write_trace(file, joined(path));
    context.publish(Wrote{file});
  };
}

Engine::Job compare_job(Path first, Path second, unsigned first_branch, unsigned second_branch) {
  return [first = std::move(first), second = std::move(second), first_branch,
          second_branch](const JobContext& context) {
    context.progress("Comparing two runs", -1);
    context.publish(Compared{first_branch, second_branch, compare_traces(joined(first), joined(second))});
  };
}

Engine::Job open_trace_job(std::filesystem::path path, DocumentPtr document) {
  return [path = std::move(path), document = std::move(document)](const JobContext& context) {
    context.progress("Opening " + path.filename().string(), -1);
    Trace trace = read_trace(path);
    TraceOpened opened;
    opened.path = path;
    opened.joins = document;
    if (document && document->mesh().triangles != trace.triangles)
      throw MeshError(path.string() + ": the run is of another mesh than the open one");
    read_numbers(trace, opened);
    opened.head.program = trace.program;
    opened.head.stopped_because = trace.stopped_because;
    ReadAs as = understand(context.bench(), trace, opened);
    if (!document) {
      context.bench().forget();
      opened.document = document_of(trace, path);
    }
    opened.recording = std::make_shared<Recording>();
    opened.recording->take(std::move(trace), std::move(as));
    if (!document) {
      auto state = std::make_shared<MeshState>();
      state->geometry = measure_geometry(*opened.document, opened.document->mesh().positions);
      try {
        state->energy = energy_at(context.bench(), opened.document, opened.settings,
                                  {opened.recording, 0, {}}, state->positions());
      } catch (const Error&) {  // it can still be looked at
        state->energy.reset();
      }
      opened.state = std::move(state);
    }
    context.publish(std::move(opened));
  };
}

}  // namespace isorelax::model
