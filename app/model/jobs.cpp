#include "model/jobs.h"

#include <chrono>
#include <utility>

#include "mesh/error.h"
#include "model/arguments.h"
#include "model/timeline_jobs.h"
#include "model/trace_jobs.h"
#include "smoothing/polish.h"
#include "smoothing/surface_watch.h"
#include "trace/trace_file.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

using Clock = std::chrono::steady_clock;

// Publishes what a run does, measuring a state for the view only when the view is ready for one and measuring
// has not taken more time than stepping. Records every step, and looks whether a breakpoint holds.
class RunReporter {
 public:
  RunReporter(const JobContext& context, const RunRequest& request, const SmoothingProblem& problem)
      : context_(context), request_(request), problem_(problem), recording_(*request.recording) {}

  bool operator()(unsigned iteration, const StepRecord& record, std::span<const Vec3> positions) {
    recording_.add(record, positions);
    Workbench& bench = context_.bench();
    bench.went_on(recording_);
    if (bench.steps().fits(bytes_of(record)))
      bench.steps().add(recording_.number(), recording_.size(), std::make_shared<StepRecord>(record));
    iteration_ = request_.start->iteration + iteration;
    const TraceQuality& quality = recording_.trace().iterations.back().quality;
    found_.rows.push_back({iteration_, record.after.energy, quality.min_angle_deg, quality.max_angle_deg,
                           record.largest_move, request_.series});
    found_.steps.push_back(summary_of(record, iteration_, positions.size()));
    context_.progress(request_.kind == PartKind::polish ? "Polishing" : "Smoothing",
                      static_cast<double>(iteration) / request_.iterations);
    const bool broken = look_at_breakpoints(record, positions, false);
    const auto since = Clock::now() - published_;
    if (context_.view_is_waiting() && since > measuring_ && since > std::chrono::milliseconds(15))
      publish(positions);
    return !broken && !context_.cancelled();
  }

  // The last state, unless it is out already.
  void finish(std::span<const Vec3> positions) {
    const auto last = context_.bench().steps().find(recording_.number(), recording_.size());
    if (broken_by_.empty() && last && recording_.size() > 0) look_at_breakpoints(*last, positions, true);
    if (!found_.rows.empty() || !found_.hits.empty()) publish(positions);
  }

  [[nodiscard]] const std::string& broken_by() const { return broken_by_; }

 private:
  bool look_at_breakpoints(const StepRecord& record, std::span<const Vec3> positions, bool stop) {
    const Trace& trace = recording_.trace();
    for (const Breakpoint& point : request_.breakpoints) {
      if (!point.enabled || !point.predicate) continue;
      Moment now{.iteration = iteration_,
                 .numbers = trace.iterations.back(),
                 .record = record,
                 .positions = positions,
                 .triangles = trace.triangles,
                 .inverted_at_start = trace.quality.inverted,
                 .stop = stop};
      if (!point.predicate->holds(now)) continue;
      if (stop) {  // only what the end itself makes true
        now.stop = false;
        if (point.predicate->holds(now)) continue;
      }
      found_.hits.push_back({request_.branch, iteration_, point.text, point.action});
      if (point.action == BreakAction::stop && broken_by_.empty()) broken_by_ = point.text;
    }
    return !broken_by_.empty();
  }

  void publish(std::span<const Vec3> positions) {
    const auto begin = Clock::now();
    auto state = std::make_shared<MeshState>();
    state->iteration = iteration_;
    state->geometry = measure_geometry(*request_.document, {positions.begin(), positions.end()});
    state->energy = measure_energy(problem_, request_.settings, positions);
    Workbench& bench = context_.bench();
    bench.note_geometry(recording_.number(), recording_.size(), state->geometry);
    found_.state = std::move(state);
    found_.memory = {bench.steps().bytes(), bench.steps().count()};
    context_.publish(std::exchange(found_, {}));
    published_ = Clock::now();
    measuring_ = published_ - begin;
  }

  const JobContext& context_;
  const RunRequest& request_;
  const SmoothingProblem& problem_;
  Recording& recording_;
  Iterated found_;
  std::string broken_by_;
  unsigned iteration_ = 0;
  Clock::time_point published_ = Clock::now();
  Clock::duration measuring_{};
};

void run_and_report(const JobContext& context, const RunRequest& request) {
  context.progress("Preparing", -1);
  Workbench& bench = context.bench();
  bench.steps().set_budget(request.step_budget);
  if (!request.recording->has_begun()) {
    const TriangleMesh& mesh = request.document->mesh();
    BasePtr base;  // what a run began from that is left on its way
    if (!same_bits(request.start->positions(), mesh.positions))
      base = base_at(*request.document, request.left);
    base = bench.base_or_start(request.document, request.settings, base);
    request.recording->begin(about(*request.document, request.settings), mesh, request.start->positions(),
                             std::move(base));
  }
  const Workbench::ProblemPtr problem =
      bench.problem(request.document, request.settings, request.recording->base());
  Smoother& smoother = bench.smoother(request.document, request.settings, request.kind, *request.recording);
  if (context.cancelled()) {
    RunResult cancelled;
    cancelled.stopped = StopReason::cancelled;
    context.publish(RunEnded{cancelled, {}});
    return;
  }
  const auto start = request.recording->next_start(request.start->positions());
  std::vector<Vec3> positions(start.begin(), start.end());
  RunReporter reporter(context, request, *problem);
  const RunResult result =
      run(smoother, *problem, positions,
          {.iterations = request.iterations,
           .tolerance = request.kind == PartKind::polish ? kPolishTolerance : request.settings.tolerance},
          std::ref(reporter));
  const StopReason stopped = reporter.broken_by().empty() ? result.stopped : StopReason::breakpoint;
  request.recording->trace().stopped = name_of(stopped);
  request.recording->trace().stopped_because = to_string(stopped, reporter.broken_by());
  reporter.finish(positions);
  RunEnded ended{result, reporter.broken_by()};
  if (result.stopped == StopReason::fixed) {
    ended.held = StepSummary{.iteration = request.start->iteration,
                             .before = result.before,
                             .after = result.after,
                             .limits = count_limits(problem->fixed_limits),
                             .vertices = positions.size()};
  }
  context.publish(std::move(ended));
}

}  // namespace

namespace {

std::string will_be_turned(const UntangleResult& result) {
  const auto triangles = [](std::size_t n) {
    return std::to_string(n) + (n == 1 ? " triangle lies" : " triangles lie");
  };
  return triangles(result.before) + " upside down: a run turns " +
         (result.after == 0 ? "all of them" : "all but " + std::to_string(result.after)) + " first";
}

/// Measures a document that was made and shows it: Loaded. The workbench forgets the one before.
void publish_loaded(const JobContext& context, DocumentPtr document, SmoothingSettings settings) {
  settings.pinned.clear();  // they are those of another mesh
  const std::string name = document->path.filename().string();
  const std::string cancelled = document->path.string() + ": opening was cancelled";
  Loaded loaded;
  loaded.document = std::move(document);
  if (context.cancelled()) throw Error(cancelled);
  context.progress("Measuring " + name, -1);
  auto state = std::make_shared<MeshState>();
  state->geometry = measure_geometry(*loaded.document, loaded.document->mesh().positions);
  loaded.notes = loaded.document->file.messages;
  if (loaded.document->faces_inward)
    loaded.notes.emplace_back("the mesh faces inward: its triangles show their backs to the outside");
  if (context.cancelled()) throw Error(cancelled);
  context.bench().forget();
  // A mesh that cannot be smoothed can still be looked at.
  try {
    const UntangledStart& start = context.bench().start_of(loaded.document, settings).untangled;
    if (start.result.moved.empty())
      loaded.notes.insert(loaded.notes.end(), start.notes.begin(), start.notes.end());
    else
      loaded.turning = will_be_turned(start.result);
    const Workbench::ProblemPtr problem = context.bench().problem(loaded.document, settings);
    state->energy = measure_energy(*problem, settings, state->positions());
    loaded.notes.insert(loaded.notes.end(), problem->notes.begin(), problem->notes.end());
  } catch (const Error& error) {
    loaded.notes.emplace_back(error.what());
  }
  loaded.state = std::move(state);
  context.publish(std::move(loaded));
}

}  // namespace

Engine::Job sphere_job(const SphereStart& sphere, SmoothingSettings settings) {
  return [sphere, settings = std::move(settings)](const JobContext& context) {
    context.progress("Making a sphere", -1);
    publish_loaded(context, make_document(sphere), settings);
  };
}

Engine::Job load_job(std::filesystem::path path, SmoothingSettings settings) {
  return [path = std::move(path), settings = std::move(settings)](JobContext& context) {
    context.progress("Opening " + path.filename().string(), -1);
    if (is_trace(path)) return open_trace_job(path, {})(context);
    publish_loaded(context, read_document(path), settings);
  };
}

Engine::Job energy_job(DocumentPtr document, SmoothingSettings settings, MeshStatePtr original,
                       MeshStatePtr current, Place place) {
  return [document = std::move(document), settings = std::move(settings), original = std::move(original),
          current = std::move(current), place = std::move(place)](const JobContext& context) {
    context.progress("Measuring the energy", -1);
    const Workbench::ProblemPtr problem = context.bench().problem(document, settings);
    EnergyMeasured measured{document, original->geometry, current->geometry, nullptr,
                            nullptr,  problem->notes};
    measured.original = measure_energy(*problem, settings, original->positions());
    measured.current = original->geometry == current->geometry
                           ? measured.original
                           : energy_at(context.bench(), document, settings, place, current->positions());
    context.publish(std::move(measured));
  };
}

Engine::Job run_job(RunRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    try {
      run_and_report(context, request);
    } catch (const Error& error) {
      context.publish(RunFailed{error.what()});
    } catch (const std::bad_alloc&) {
      context.publish(RunFailed{"not enough memory to smooth this mesh"});
    }
  };
}

Engine::Job surface_job(DocumentPtr document, SmoothingSettings settings, MeshStatePtr state, Place place) {
  return [document = std::move(document), settings = std::move(settings), state = std::move(state),
          place = std::move(place)](const JobContext& context) {
    // Whoever goes through the timeline does not wait for it at each iteration.
    if (context.others_wait(std::chrono::milliseconds(50))) {
      context.publish(SurfaceGaveWay{});
      return;
    }
    context.progress("Measuring the distance from the original", -1);
    const TriangleMesh& mesh = document->mesh();
    const BasePtr base = context.bench().base_or_start(document, settings, base_at(*document, place));
    const std::vector<Vec3>& start = base ? *base : mesh.positions;
    const Workbench::ProblemPtr problem = context.bench().problem(document, settings, base);
    const double limit = kept_near(settings, start, *problem).deviation;
    const SurfaceWatch::Finding found =
        SurfaceWatch(limited_from(settings, mesh, start), start, *problem).look(state->positions(), limit);
    SurfaceMeasured measured{
        state->geometry,        found.deviation,         limit, is_over_limit(found.deviation.max, limit),
        found.turned_triangles, found.crossing_triangles};
    // Triangles upside down in a plane cover what the sound ones cover as well.
    if (base && !document->plane_normal)
      measured.deviation =
          measure_deviation(mesh.positions, state->positions(), mesh.triangles, document->topology);
    context.publish(std::move(measured));
  };
}

Engine::Job save_job(DocumentPtr document, MeshStatePtr state, std::filesystem::path path) {
  return [document = std::move(document), state = std::move(state),
          path = std::move(path)](const JobContext& context) {
    context.progress("Saving " + path.filename().string(), -1);
    TriangleMesh mesh = document->mesh();
    mesh.positions.assign(state->positions().begin(), state->positions().end());
    auto notes = write_mesh(path, mesh, write_like(document->file, path));
    context.publish(Saved{path, state, std::move(notes)});
  };
}

}  // namespace isorelax::model
