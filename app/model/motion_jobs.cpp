#include "model/motion_jobs.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <utility>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "model/jobs.h"
#include "trace/position_delta.h"

namespace isorelax::model {
namespace {

using MotionClock = std::chrono::steady_clock;

ValueRange extremes_of_areas(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  double sum = 0;
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  for (const Triangle& t : triangles) {
    const double area = area_vector(x[t[0]], x[t[1]], x[t[2]]).norm();
    sum += area;
    low = std::min(low, area);
    high = std::max(high, area);
  }
  const double mean = sum / static_cast<double>(triangles.size());
  return mean > 0 && std::isfinite(mean) ? ValueRange{low / mean, high / mean} : ValueRange{1, 1};
}

void unite(ValueRange& range, const ValueRange& other) {
  range = {std::min(range.low, other.low), std::max(range.high, other.high)};
}

/// Takes a moving surface step by step, records every state, and publishes measured ones as the view asks.
class MotionReporter {
 public:
  MotionReporter(const JobContext& context, const MotionRequest& request, MotionRun& run)
      : context_(context),
        request_(request),
        run_(run),
        recording_(*request.recording),
        until_(run.setup().until) {}

  /// Measures the state in which the motion begins.
  void begin() { note(nullptr); }

  /// One step. Throws MotionError; nothing is noted then.
  void step() {
    const std::vector<Vec3> before = run_.surface().state().positions;
    run_.advance();
    const std::span<const Vec3> after = run_.surface().state().positions;
    StepRecord record;
    if (!request_.breakpoints.empty()) record = record_of_motion(before, after);
    for (std::size_t v = 0; v < after.size(); ++v) {
      const double move = (after[v] - before[v]).norm();
      record.largest_move = std::max(record.largest_move, move);
      record.moved += move > 0 ? 1 : 0;
    }
    ++steps_;
    note(&record);
    look_at_breakpoints(record);
    const double time = run_.surface().state().time;
    context_.progress("Moving: t = " + time_text(time) + " of " + time_text(until_), time / until_);
    const auto since = MotionClock::now() - published_;
    if (context_.view_is_waiting() && since > measuring_ && since > std::chrono::milliseconds(15)) publish();
  }

  /// What was not published yet.
  void finish() {
    if (!found_.moments.empty()) publish();
  }

  [[nodiscard]] unsigned steps() const { return steps_; }
  [[nodiscard]] const std::string& broken_by() const { return broken_by_; }

 private:
  [[nodiscard]] unsigned iteration() const {
    return request_.first + static_cast<unsigned>(run_.surface().state().step);
  }

  // A state with everything about it that every step is asked for; of the start there is no record.
  void note(StepRecord* record) {
    const std::span<const Vec3> x = run_.surface().state().positions;
    const std::span<const Triangle> triangles = run_.surface().triangles();
    found_.moments.push_back(run_.measure(MotionRun::Detail::plain));
    unite(found_.areas, extremes_of_areas(x, triangles));
    for (const Vec3& point : x) found_.box.extend(point);
    energy_ = nullptr;
    if (const auto& problem = recording_.motion->measured_by) {
      energy_ = measure_energy(*problem, request_.settings, x);
      unite(found_.energies, energy_->range);
    }
    const double energy = energy_ ? energy_->total : std::numeric_limits<double>::quiet_NaN();
    TraceQuality quality = recording_.trace().quality;
    if (record != nullptr) {
      record->before.energy = energy_before_;
      record->after.energy = energy;
      recording_.add(*record, x);
      quality = recording_.trace().iterations.back().quality;
      found_.steps.push_back(summary_of(*record, iteration(), x.size()));
    }
    found_.rows.push_back({iteration(), energy, quality.min_angle_deg, quality.max_angle_deg,
                           record != nullptr ? record->largest_move : 0, request_.series});
    energy_before_ = energy;
  }

  void look_at_breakpoints(const StepRecord& record) {
    const Trace& trace = recording_.trace();
    const Moment now{.iteration = iteration(),
                     .numbers = trace.iterations.back(),
                     .record = record,
                     .positions = run_.surface().state().positions,
                     .triangles = trace.triangles,
                     .inverted_at_start = trace.quality.inverted,
                     .stop = run_.done(),
                     .time = run_.surface().state().time};
    const Breakpoint* stops = note_hits(request_.breakpoints, now, request_.branch, found_.hits);
    if (stops != nullptr && broken_by_.empty()) broken_by_ = stops->text;
  }

  void publish() {
    const auto begin = MotionClock::now();
    const MovingState& at = run_.surface().state();
    auto state = std::make_shared<MeshState>();
    state->iteration = iteration();
    // The start is a state that is there already.
    state->geometry =
        at.step == 0 ? request_.start->geometry : measure_geometry(*request_.document, at.positions);
    state->energy = energy_;
    context_.bench().note_geometry(recording_.number(), static_cast<unsigned>(at.step), state->geometry);
    found_.state = std::move(state);
    context_.publish(std::exchange(found_, {}));
    published_ = MotionClock::now();
    measuring_ = published_ - begin;
  }

  const JobContext& context_;
  const MotionRequest& request_;
  MotionRun& run_;
  Recording& recording_;
  double until_;
  Moved found_;
  std::shared_ptr<const EnergyState> energy_;
  double energy_before_ = std::numeric_limits<double>::quiet_NaN();
  unsigned steps_ = 0;
  std::string broken_by_;
  MotionClock::time_point published_ = MotionClock::now();
  MotionClock::duration measuring_{};
};

Trace about_motion(const Document& document, const MotionChoices& motion) {
  Trace trace;
  trace.program = "isorelax " ISORELAX_VERSION;
  trace.input = document.path.string();
  trace.arguments = to_words(motion);
  return trace;
}

/// Triangles of a moving surface are measured against the motion's reference.
std::unique_ptr<const SmoothingProblem> measuring_problem(const MotionSetup& setup) {
  ProblemOptions options;
  options.weights = setup.options.weights;
  options.exponent = 1;
  options.reference = setup.options.reference;
  options.surface = SurfaceRule::tangent;  // nothing is moved with it
  options.threads = setup.options.threads;
  try {
    return std::make_unique<const SmoothingProblem>(
        make_problem(setup.start.positions, setup.start.triangles, options));
  } catch (const Error&) {  // it can still be moved
    return nullptr;
  }
}

std::shared_ptr<MotionTrack> make_track(const MotionRequest& request, std::vector<std::string>& notes) {
  TriangleMesh start;
  const auto positions = request.start->positions();
  start.positions.assign(positions.begin(), positions.end());
  start.triangles = request.document->mesh().triangles;
  auto track = std::make_shared<MotionTrack>();
  track->setup = set_up_motion(request.motion, std::move(start), notes);
  track->setup.sphere = request.sphere;
  track->measured_by = measuring_problem(track->setup);
  return track;
}

void move_and_report(const JobContext& context, const MotionRequest& request) {
  context.progress("Preparing the motion", -1);
  Recording& recording = *request.recording;
  const bool begins = !recording.has_begun();
  std::vector<std::string> notes;
  const auto track = begins ? make_track(request, notes) : recording.motion;
  MotionRun& run = context.bench().motion_run(track);
  if (begins) {
    recording.begin(about_motion(*request.document, request.motion), request.document->mesh(),
                    request.start->positions());
    recording.motion = track;
  }
  MotionReporter reporter(context, request, run);
  if (begins) reporter.begin();
  std::string failure;
  try {
    while (!run.done() && !context.cancelled() && reporter.broken_by().empty() &&
           (request.steps == 0 || reporter.steps() < request.steps))
      reporter.step();
  } catch (const Error& error) {
    failure = error.what();
  }
  track->tip = run.surface().state();
  reporter.finish();
  if (!failure.empty()) throw Error(failure);
  const bool wanted_more = !run.done() && (request.steps == 0 || reporter.steps() < request.steps);
  context.publish(MotionEnded{reporter.steps(), wanted_more, reporter.broken_by()});
}

MotionShare& share_of(MotionTrack& track) {
  if (!track.share) track.share.emplace(track.setup);
  return *track.share;
}

}  // namespace

StepRecord record_of_motion(std::span<const Vec3> before, std::span<const Vec3> after) {
  StepRecord record;
  record.gradient.assign(after.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  record.alpha.assign(after.size(), 1);
  record.limits.assign(after.size(), 0);
  for (std::size_t v = 0; v < after.size(); ++v) record.displacement.emplace_back(after[v] - before[v]);
  return record;
}

std::string time_text(double time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", time);
  return text.data();
}

Engine::Job motion_job(MotionRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    try {
      move_and_report(context, request);
    } catch (const Error& error) {
      context.publish(RunFailed{error.what()});
    } catch (const std::bad_alloc&) {
      context.publish(RunFailed{"not enough memory to move this mesh"});
    }
  };
}

Engine::Job motion_inspect_job(MotionInspectRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    Recording& recording = *request.recording;
    const std::vector<Vec3> now = recording.positions_at(request.step);
    const std::vector<Vec3> before = request.step > 0 ? recording.positions_at(request.step - 1) : now;
    MotionInspected inspected;
    inspected.number = request.number;
    if (request.vertex) {
      const Index v = *request.vertex;
      MovingVertex vertex{v, before[v], now[v], Vec3::Zero(), Vec3::Zero()};
      if (request.step > 0) vertex.by_motion = share_of(*recording.motion).of(before, now, request.place, v);
      vertex.by_redistribution = now[v] - before[v] - vertex.by_motion;
      inspected.vertex = vertex;
    }
    if (request.triangle && recording.motion->measured_by) {
      const Triangle& v = recording.trace().triangles[*request.triangle];
      const std::vector<Vec3>& start = recording.trace().positions;
      inspected.triangle = {compare_triangle(*recording.motion->measured_by, before, now, *request.triangle),
                            0.5 * area_vector(start[v[0]], start[v[1]], start[v[2]]).norm()};
    } else if (request.triangle) {
      inspected.unknown = "The mesh in which the motion begins has no reference to measure against.";
    }
    context.publish(std::move(inspected));
  };
}

Engine::Job motion_follow_job(MotionFollowRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    Recording& recording = *request.recording;
    MotionShare& share = share_of(*recording.motion);
    std::vector<Vec3> before = recording.positions_at(0);
    const Vec3 start = before[request.vertex];
    MovingPath path{request.number, request.branch, request.vertex, {0}, {0}, {0}};
    for (unsigned k = 1; k <= request.places.size(); ++k) {
      if (context.others_wait() || context.cancelled()) return;
      std::vector<Vec3> after = before;
      if (!apply_delta(recording.trace().iterations[k - 1].delta, after))
        throw Error("the recording is damaged");
      const Vec3 moved = share.of(before, after, request.places[k - 1], request.vertex);
      const Vec3 all = after[request.vertex] - before[request.vertex];
      path.by_motion.push_back(path.by_motion.back() + moved.norm());
      path.by_redistribution.push_back(path.by_redistribution.back() + (all - moved).norm());
      path.distance.push_back((after[request.vertex] - start).norm());
      before = std::move(after);
    }
    context.publish(std::move(path));
  };
}

Engine::Job motion_scan_job(MotionScanRequest request) {
  return [request = std::move(request)](const JobContext& context) {
    const Trace& trace = request.recording->trace();
    scan(context, request.range, [&](unsigned k, const ShowMoment& show) {
      const unsigned own = k - request.first;
      const std::vector<Vec3> after = request.recording->positions_at(own);
      const StepRecord record = record_of_motion(request.recording->positions_at(own - 1), after);
      show({.iteration = k,
            .numbers = trace.iterations[own - 1],
            .record = record,
            .positions = after,
            .triangles = trace.triangles,
            .inverted_at_start = trace.quality.inverted,
            .stop = request.range.stops_at(k),
            .time = request.times[own]});
    });
  };
}

}  // namespace isorelax::model
