#include "model/jobs.h"

#include <chrono>
#include <utility>

#include "mesh/error.h"

namespace isorelax::model {
namespace {

using Clock = std::chrono::steady_clock;

// Publishes what a run does, measuring a state for the view only when the view is ready for one and measuring
// has not taken more time than stepping.
class RunReporter {
 public:
  RunReporter(const JobContext& context, const RunRequest& request, const SmoothingProblem& problem)
      : context_(context), request_(request), problem_(problem) {}

  bool operator()(unsigned iteration, const StepRecord& record, std::span<const Vec3> positions) {
    const WorstAngles angles = worst_angles(positions, problem_.triangles);
    iteration_ = request_.start->iteration + iteration;
    rows_.push_back({iteration_, record.after.energy, angles.min_deg, angles.max_deg, record.largest_move,
                     request_.series});
    step_ = {iteration_,          record.before,    record.after,        count_limits(record.limits),
             record.moved,        positions.size(), record.largest_move, record.fold_passes,
             record.energy_passes};
    context_.progress("Smoothing", static_cast<double>(iteration) / request_.iterations);
    const auto since = Clock::now() - published_;
    if (context_.view_is_waiting() && since > measuring_ && since > std::chrono::milliseconds(15))
      publish(positions);
    return !context_.cancelled();
  }

  // The last state, unless it is out already.
  void finish(std::span<const Vec3> positions) {
    if (!rows_.empty()) publish(positions);
  }

 private:
  void publish(std::span<const Vec3> positions) {
    const auto begin = Clock::now();
    auto state = std::make_shared<MeshState>();
    state->iteration = iteration_;
    state->geometry = measure_geometry(*request_.document, {positions.begin(), positions.end()});
    state->energy = measure_energy(problem_, request_.settings, positions);
    context_.publish(Iterated{std::exchange(rows_, {}), std::move(state), step_});
    published_ = Clock::now();
    measuring_ = published_ - begin;
  }

  const JobContext& context_;
  const RunRequest& request_;
  const SmoothingProblem& problem_;
  std::vector<IterationRow> rows_;
  StepSummary step_;
  unsigned iteration_ = 0;
  Clock::time_point published_ = Clock::now();
  Clock::duration measuring_{};
};

void run_and_report(const JobContext& context, const RunRequest& request) {
  context.progress("Preparing", -1);
  const SmoothingProblem& problem = context.bench().problem(request.document, request.settings);
  if (context.cancelled()) {
    RunResult result;
    result.stopped = StopReason::cancelled;
    context.publish(RunEnded{result});
    return;
  }
  const auto start = request.start->positions();
  std::vector<Vec3> positions(start.begin(), start.end());
  RunReporter reporter(context, request, problem);
  const RunResult result =
      run(context.bench().smoother(), problem, positions,
          {.iterations = request.iterations, .tolerance = request.settings.tolerance}, std::ref(reporter));
  reporter.finish(positions);
  context.publish(RunEnded{result});
}

}  // namespace

Engine::Job load_job(std::filesystem::path path, SmoothingSettings settings) {
  return [path = std::move(path), settings = std::move(settings)](const JobContext& context) {
    context.progress("Opening " + path.filename().string(), -1);
    Loaded loaded;
    loaded.document = read_document(path);
    if (context.cancelled()) throw Error(path.string() + ": opening was cancelled");
    context.progress("Measuring " + path.filename().string(), -1);
    auto state = std::make_shared<MeshState>();
    state->geometry = measure_geometry(*loaded.document, loaded.document->mesh().positions);
    loaded.notes = loaded.document->file.messages;
    if (context.cancelled()) throw Error(path.string() + ": opening was cancelled");
    // A mesh that cannot be smoothed can still be looked at.
    try {
      const SmoothingProblem& problem = context.bench().problem(loaded.document, settings);
      state->energy = measure_energy(problem, settings, state->positions());
      loaded.notes.insert(loaded.notes.end(), problem.notes.begin(), problem.notes.end());
    } catch (const Error& error) {
      loaded.notes.emplace_back(error.what());
    }
    loaded.state = std::move(state);
    context.publish(std::move(loaded));
  };
}

Engine::Job energy_job(DocumentPtr document, SmoothingSettings settings, MeshStatePtr original,
                       MeshStatePtr current) {
  return [document = std::move(document), settings = std::move(settings), original = std::move(original),
          current = std::move(current)](const JobContext& context) {
    context.progress("Measuring the energy", -1);
    const SmoothingProblem& problem = context.bench().problem(document, settings);
    EnergyMeasured measured{document, original->geometry, current->geometry, nullptr, nullptr, problem.notes};
    measured.original = measure_energy(problem, settings, original->positions());
    measured.current = original->geometry == current->geometry
                           ? measured.original
                           : measure_energy(problem, settings, current->positions());
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

Engine::Job save_job(DocumentPtr document, MeshStatePtr state, std::filesystem::path path) {
  return [document = std::move(document), state = std::move(state),
          path = std::move(path)](const JobContext& context) {
    context.progress("Saving " + path.filename().string(), -1);
    TriangleMesh mesh = document->mesh();
    mesh.positions.assign(state->positions().begin(), state->positions().end());
    auto notes = write_mesh(path, mesh);
    context.publish(Saved{path, state, std::move(notes)});
  };
}

}  // namespace isorelax::model
