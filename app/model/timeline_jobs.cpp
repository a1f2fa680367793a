#include "model/timeline_jobs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <utility>

#include "mesh/error.h"
#include "model/arguments.h"
#include "trace/position_delta.h"
#include "trace/trace_file.h"

namespace isorelax::model {
namespace {

/// Triangles up to which the gradients of every step that is looked into are checked.
constexpr Index kMostChecked = 200000;

bool same_positions(std::span<const Vec3> a, std::span<const Vec3> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

std::vector<Vec3> positions_of(const Document& document, const Place& place) {
  return place.recording && place.recording->has_begun() ? place.recording->positions_at(place.iteration)
                                                         : document.mesh().positions;
}

MeshStatePtr state_at(const JobContext& context, const SeekRequest& request, const Place& place) {
  Workbench& bench = context.bench();
  auto state = std::make_shared<MeshState>();
  state->iteration = request.shown;
  state->geometry = bench.geometry(place.recording.get(), place.iteration);
  if (!state->geometry) {
    state->geometry = measure_geometry(*request.document, positions_of(*request.document, place));
    bench.note_geometry(place.recording.get(), place.iteration, state->geometry);
  }
  if (place.recording && place.recording->motion) {
    if (const auto& problem = place.recording->motion->measured_by)
      state->energy = measure_energy(*problem, request.settings, state->positions());
    return state;
  }
  try {
    state->energy = measure_energy(*bench.problem(request.document, request.settings), request.settings,
                                   state->positions());
  } catch (const Error&) {  // a mesh that cannot be smoothed can still be looked at
    state->energy.reset();
  }
  return state;
}

/// A step that was found again.
struct FoundStep {
  std::shared_ptr<const StepRecord> record;
  std::vector<Vec3> before;
  std::string mismatch;
};

/// One step of a smoother that knows nothing.
std::shared_ptr<StepRecord> lone_step(const SmoothingProblem& problem, const SmoothingSettings& settings,
                                      std::span<const Vec3> before) {
  auto record = std::make_shared<StepRecord>();
  make_smoother(problem, settings)->step(before, *record);
  return record;
}

bool leads_to(const StepRecord& record, std::vector<Vec3> positions, std::span<const Vec3> after) {
  apply_step(record, positions);
  return same_positions(positions, after);
}

/// Does all steps since the smoother last began afresh again, and keeps their records.
std::shared_ptr<StepRecord> replay(const JobContext& context, const SmoothingProblem& problem,
                                   const InspectRequest& request) {
  Recording& recording = *request.place.recording;
  unsigned from = 0;
  for (const unsigned start : recording.fresh_starts())
    if (start < request.place.iteration) from = start;
  std::vector<Vec3> positions = recording.positions_at(from);
  const auto smoother = make_smoother(problem, request.settings);
  for (unsigned k = from + 1;; ++k) {
    context.progress("Doing the steps again",
                     static_cast<double>(k - from) / (request.place.iteration - from));
    auto record = std::make_shared<StepRecord>();
    smoother->step(positions, *record);
    if (k == request.place.iteration) return record;
    if (context.cancelled()) throw Error("Doing the steps again was cancelled");
    apply_step(*record, positions);
    context.bench().steps().add(&recording, k, std::move(record));
  }
}

std::string parting_text(const StepRecord& record, std::vector<Vec3> before, std::span<const Vec3> after) {
  apply_step(record, before);
  const auto parting = find_parting(after, before, 0);
  if (!parting) return {};
  return "Done again, this step leads elsewhere: " + std::to_string(parting->vertices) +
         " vertices differ from the recording, the first is vertex " + std::to_string(parting->vertex) +
         ". The run was made by another program, or with options that are not known here.";
}

FoundStep find_step(const JobContext& context, const SmoothingProblem& problem,
                    const InspectRequest& request) {
  FoundStep found;
  Recording* recording = request.place.recording.get();
  if (recording == nullptr || !recording->has_begun() || request.place.iteration == 0 ||
      request.place.iteration > recording->size()) {
    // The step that would be made next.
    const unsigned last = recording != nullptr && recording->has_begun() ? recording->size() : 0;
    found.before = positions_of(*request.document, {request.place.recording, last, {}});
    found.record = lone_step(problem, request.settings, found.before);
    return found;
  }
  const unsigned k = request.place.iteration;
  found.before = recording->positions_at(k - 1);
  Workbench& bench = context.bench();
  found.record = bench.steps().find(recording, k);
  if (found.record) return found;
  if (!request.place.not_redone.empty())
    throw Error("The step cannot be looked into: " + request.place.not_redone);
  context.progress("Doing the step again", -1);
  const std::vector<Vec3> after = recording->positions_at(k);
  // Most steps depend on nothing but where they begin; the bits tell.
  auto record = lone_step(problem, request.settings, found.before);
  if (!leads_to(*record, found.before, after)) record = replay(context, problem, request);
  found.mismatch = parting_text(*record, found.before, after);
  if (found.mismatch.empty()) bench.steps().add(recording, k, record);
  found.record = std::move(record);
  return found;
}

/// Visits all positions of a path, one iteration after the other.
template <typename Visit>
void walk(const Document* document, const PathRequest& path, const Visit& visit) {
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const Place& segment = path.segments[s];
    if (!segment.recording || !segment.recording->has_begun()) {
      if (document != nullptr) visit(document->mesh().positions, nullptr);
      continue;
    }
    std::vector<Vec3> positions = segment.recording->positions_at(path.from[s]);
    if (s == 0) visit(positions, nullptr);
    for (unsigned k = path.from[s]; k < segment.iteration; ++k) {
      const TraceIteration& iteration = segment.recording->trace().iterations[k];
      if (!apply_delta(iteration.delta, positions)) throw Error("the recording is damaged");
      visit(positions, &iteration);
    }
  }
}

/// Iterations share nothing with the recording's: deltas are copied.
Trace joined(const PathRequest& path) {
  Trace trace = about(*path.document, path.settings);
  trace.positions = path.document->mesh().positions;
  trace.triangles = path.document->mesh().triangles;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const Place& segment = path.segments[s];
    if (!segment.recording || !segment.recording->has_begun()) continue;
    const Trace& part = segment.recording->trace();
    if (s == 0) trace.quality = part.quality, trace.positions = part.positions;
    trace.iterations.insert(trace.iterations.end(), part.iterations.begin() + path.from[s],
                            part.iterations.begin() + segment.iteration);
    trace.stopped = part.stopped;
    trace.stopped_because = part.stopped_because;
    if (!segment.recording->can_grow()) trace.arguments = part.arguments, trace.resources = part.resources;
  }
  if (path.segments.size() > 1) trace.stopped_because += " (with other arguments in the iterations before)";
  return trace;
}

StepSummary summary_of(const TraceIteration& step, unsigned iteration, std::size_t vertices) {
  return {iteration,
          step.before,
          step.after,
          step.limits,
          step.moved,
          vertices,
          step.largest_move,
          static_cast<unsigned>(step.fold_passes),
          static_cast<unsigned>(step.energy_passes)};
}

/// What the timeline shows of a trace, without going through its positions.
void read_numbers(const Trace& trace, TraceOpened& opened) {
  if (!trace.iterations.empty())
    opened.rows.push_back({0, trace.iterations.front().before.energy, trace.quality.min_angle_deg,
                           trace.quality.max_angle_deg, 0, 0});
  unsigned k = 0;
  for (const TraceIteration& step : trace.iterations) {
    ++k;
    opened.rows.push_back(
        {k, step.after.energy, step.quality.min_angle_deg, step.quality.max_angle_deg, step.largest_move, 0});
    opened.steps.push_back(summary_of(step, k, trace.positions.size()));
  }
}

DocumentPtr document_of(const Trace& trace, const std::filesystem::path& path) {
  MeshFile file;
  file.mesh.positions = trace.positions;
  file.mesh.triangles = trace.triangles;
  const std::filesystem::path input = trace.input.empty() ? path : std::filesystem::path(trace.input);
  return make_document(input, std::move(file));
}

}  // namespace

StepSummary summary_of(const StepRecord& record, unsigned iteration, std::size_t vertices) {
  return {iteration, record.before,       record.after,       count_limits(record.limits), record.moved,
          vertices,  record.largest_move, record.fold_passes, record.energy_passes};
}

bool is_trace(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kTraceMagic.size()> letters{};
  file.read(letters.data(), letters.size());
  return file && std::string_view(letters.data(), letters.size()) == kTraceMagic;
}

Engine::Job seek_job(SeekRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    context.progress("Going to iteration " + std::to_string(request.shown), -1);
    Sought sought{request.number, state_at(context, request, request.place), {}};
    for (const Place& other : request.others) sought.others.push_back(state_at(context, request, other));
    context.publish(std::move(sought));
  };
}

Engine::Job inspect_job(InspectRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    context.bench().steps().set_budget(request.step_budget);
    const Workbench::ProblemPtr problem = context.bench().problem(request.document, request.settings);
    FoundStep found = find_step(context, *problem, request);
    Inspected inspected;
    inspected.number = request.number;
    inspected.mismatch = std::move(found.mismatch);
    if (request.vertex)
      inspected.vertex = explain_vertex(*problem, problem_options(request.settings).features, found.before,
                                        *found.record, *request.vertex);
    if (request.triangle && !found.record->shape.empty())
      inspected.triangle = explain_triangle(*problem, found.before, *found.record, *request.triangle);
    if (problem->triangle_count() <= kMostChecked)
      inspected.check = check_gradients(*problem, found.before, *found.record);
    if (request.inside) {
      const unsigned before = std::max(1U, request.place.iteration) - 1;
      const SeekRequest seek{0, request.document, request.settings, {}, before, {}};
      inspected.before_state = state_at(context, seek, {request.place.recording, before, {}});
    }
    inspected.record = std::move(found.record);
    inspected.before = std::make_shared<const std::vector<Vec3>>(std::move(found.before));
    inspected.memory = {context.bench().steps().bytes(), context.bench().steps().count()};
    context.publish(std::move(inspected));
  };
}

Engine::Job scan_job(ScanRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    try {
      const Workbench::ProblemPtr problem = context.bench().problem(request.document, request.settings);
      const Trace& trace = request.recording->trace();
      Scanned scanned;
      for (unsigned k = request.from + 1; k <= request.to && !scanned.stop && !context.cancelled(); ++k) {
        context.progress("Looking at iteration " + std::to_string(k), -1);
        const Place place{request.recording, k - request.start, {}};
        const FoundStep step =
            find_step(context, *problem, {0, request.document, request.settings, place, {}, {}, false});
        const std::vector<Vec3> after = request.recording->positions_at(place.iteration);
        const Moment now{.iteration = k,
                         .numbers = trace.iterations[place.iteration - 1],
                         .record = *step.record,
                         .positions = after,
                         .triangles = trace.triangles,
                         .inverted_at_start = trace.quality.inverted,
                         .stop = false};
        for (const Breakpoint& point : request.breakpoints) {
          if (!point.enabled || !point.predicate || !point.predicate->holds(now)) continue;
          scanned.hits.push_back({request.branch, k, point.text, point.action});
          if (point.action == BreakAction::stop && !scanned.stop) {
            scanned.stop = k;
            scanned.broken_by = point.text;
          }
        }
      }
      if (context.cancelled() && !scanned.stop) scanned.stop = request.from;
      context.publish(std::move(scanned));
    } catch (const Error& error) {
      context.publish(RunFailed{error.what()});
    }
  };
}

Engine::Job follow_job(FollowRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    Followed followed{request.branch, request.vertex, {}};
    const PathRequest path{{}, {}, request.segments, request.from};
    bool given_way = false;
    walk(nullptr, path, [&](const std::vector<Vec3>& positions, const TraceIteration*) {
      given_way = given_way || context.others_wait();
      if (!given_way) followed.positions.push_back(positions[request.vertex]);
    });
    if (!given_way) context.publish(std::move(followed));
  };
}

Engine::Job save_trace_job(PathRequest path, std::filesystem::path file) {
  return [path = std::move(path), file = std::move(file)](const JobContext& context) {
    context.progress("Saving " + file.filename().string(), -1);
    write_trace(file, joined(path));
    context.publish(Wrote{file});
  };
}

Engine::Job compare_job(PathRequest first, PathRequest second, unsigned first_branch,
                        unsigned second_branch) {
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
    if (document && document->mesh().triangles != trace.triangles)
      throw MeshError(path.string() + ": the run is of another mesh than the open one");
    read_numbers(trace, opened);
    opened.settings = from_words(trace.arguments);
    opened.head.program = trace.program;
    opened.head.input = trace.input;
    opened.head.arguments = trace.arguments;
    opened.head.stopped = trace.stopped;
    opened.head.stopped_because = trace.stopped_because;
    if (!document) {
      context.bench().forget();
      opened.document = document_of(trace, path);
      auto state = std::make_shared<MeshState>();
      state->geometry = measure_geometry(*opened.document, trace.positions);
      const SmoothingSettings settings = opened.settings.value_or(SmoothingSettings{});
      try {
        state->energy =
            measure_energy(*context.bench().problem(opened.document, settings), settings, state->positions());
      } catch (const Error&) {  // it can still be looked at
        state->energy.reset();
      }
      opened.state = std::move(state);
    }
    opened.recording = std::make_shared<Recording>();
    opened.recording->take(std::move(trace));
    context.publish(std::move(opened));
  };
}

}  // namespace isorelax::model
