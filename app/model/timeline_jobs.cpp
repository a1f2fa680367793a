#include "model/timeline_jobs.h"

#include <algorithm>
#include <utility>

#include "mesh/error.h"
#include "model/trace_jobs.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

/// Triangles up to which the gradients of every step that is looked into are checked.
constexpr Index kMostChecked = 200000;

MeshStatePtr state_at(const JobContext& context, const SeekRequest& request, const Place& place) {
  Workbench& bench = context.bench();
  auto state = std::make_shared<MeshState>();
  state->iteration = request.shown;
  const std::uint64_t recording = place.recording ? place.recording->number() : 0;
  state->geometry = bench.geometry(recording, place.iteration);
  if (!state->geometry) {
    state->geometry = measure_geometry(*request.document, positions_of(*request.document, place));
    bench.note_geometry(recording, place.iteration, state->geometry);
  }
  if (place.recording && place.recording->motion) {
    if (const auto& problem = place.recording->motion->measured_by)
      state->energy = measure_energy(*problem, request.settings, state->positions());
    return state;
  }
  try {
    state->energy = energy_at(bench, request.document, request.settings, place, state->positions());
  } catch (const Error&) {  // a mesh that cannot be smoothed can still be looked at
    state->energy.reset();
  }
  return state;
}

/// The mesh before a step, as the inside of the step is drawn on it.
MeshStatePtr state_before(const JobContext& context, const InspectRequest& request,
                          std::span<const Vec3> before) {
  const unsigned iteration = std::max(1U, request.place.iteration) - 1;
  const Place place{request.place.recording, iteration, {}};
  MeshStatePtr state = state_at(context, {0, request.document, request.settings, {}, iteration, {}}, place);
  if (std::ranges::equal(state->positions(), before)) return state;
  // Untangling was between the iteration and the step.
  auto untangled = std::make_shared<MeshState>(*state);
  untangled->geometry = measure_geometry(*request.document, {before.begin(), before.end()});
  untangled->energy =
      energy_at(context.bench(), request.document, request.settings, place, untangled->positions());
  return untangled;
}

}  // namespace

StepSummary summary_of(const StepRecord& record, unsigned iteration, std::size_t vertices) {
  return {.iteration = iteration,
          .kind = record.kind,
          .before = record.before,
          .after = record.after,
          .limits = count_limits(record.limits),
          .moved = record.moved,
          .vertices = vertices,
          .largest_move = record.largest_move,
          .fold_passes = record.fold_passes,
          .energy_passes = record.energy_passes};
}

Engine::Job seek_job(SeekRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    context.progress("Going to iteration " + std::to_string(request.shown), -1);
    Sought sought{request.number, request.document, state_at(context, request, request.place), {}};
    for (const Place& other : request.others) sought.others.push_back(state_at(context, request, other));
    context.publish(std::move(sought));
  };
}

Engine::Job inspect_job(InspectRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    context.bench().steps().set_budget(request.step_budget);
    const StepMaking making = making_of(context.bench(), request.document, request.settings, request.place);
    const SmoothingProblem& problem = *making.problem;
    FoundStep found = find_step(context, request.document, making, request.place);
    Inspected inspected;
    inspected.number = request.number;
    inspected.mismatch = std::move(found.mismatch);
    const Trace* trace = making.part != nullptr ? &request.place.recording->trace() : nullptr;
    if (trace != nullptr && (trace->parts.size() > 1 || says_more_than_words(*trace, *making.part)))
      inspected.made_with = part_text(*making.part);
    if (request.vertex)
      inspected.vertex =
          explain_vertex(problem, making.features, found.before, *found.record, *request.vertex);
    if (request.triangle && !found.record->shape.empty())
      inspected.triangle = explain_triangle(problem, found.before, *found.record, *request.triangle);
    if (problem.triangle_count() <= kMostChecked)
      inspected.check = check_gradients(problem, found.before, *found.record);
    if (request.inside) inspected.before_state = state_before(context, request, found.before);
    inspected.record = std::move(found.record);
    inspected.before = std::make_shared<const std::vector<Vec3>>(std::move(found.before));
    inspected.memory = {context.bench().steps().bytes(), context.bench().steps().count()};
    context.publish(std::move(inspected));
  };
}

Engine::Job scan_job(ScanRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    const Trace& trace = request.recording->trace();
    scan(context, request.range, [&](unsigned k, const ShowMoment& show) {
      const Place place{request.recording, k - request.start, {}};
      const FoundStep step =
          find_step(context, request.document,
                    making_of(context.bench(), request.document, request.settings, place), place);
      const std::vector<Vec3> after = request.recording->positions_at(place.iteration);
      show({.iteration = k,
            .numbers = trace.iterations[place.iteration - 1],
            .record = *step.record,
            .positions = after,
            .triangles = trace.triangles,
            .inverted_at_start = trace.quality.inverted,
            .stop = request.range.stops_at(k)});
    });
  };
}

Engine::Job follow_job(FollowRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    Followed followed{request.number, request.branch, request.vertex, {}};
    bool given_way = false;
    walk(request.path, [&](const std::vector<Vec3>& positions) {
      given_way = given_way || context.others_wait();
      if (!given_way) followed.positions.push_back(positions[request.vertex]);
    });
    if (!given_way) context.publish(std::move(followed));
  };
}

}  // namespace isorelax::model
