#include <CLI/App.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/frames.h"
#include "cli/json.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/smooth_run.h"
#include "cli/table.h"
#include "cli/watch.h"
#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "mesh/normals.h"
#include "trace/recorder.h"
#include "trace/trace_file.h"

namespace isorelax::cli {
namespace {

/// `broken_by`: the predicate that ended the run, if one did.
Json outcome_to_json(const SmoothOutcome& outcome, const std::string& broken_by) {
  Json object;
  object["before"] = to_json(outcome.before);
  object["after"] = to_json(outcome.after);
  object["iterations"] = outcome.run.iterations;
  object["stopped"] = name_of(outcome.run.stopped);
  object["stopped_because"] = to_string(outcome.run.stopped, broken_by);
  object["attempts"] = outcome.attempts;
  object["seconds"] = outcome.seconds;
  object["exponent"] = outcome.exponent;
  object["energy_before"] = outcome.run.before.energy;
  const bool polished = outcome.polish && outcome.polish->iterations > 0;
  object["energy_after"] = (polished ? *outcome.polish : outcome.run).after.energy;
  object["deviation"] = {{"max", outcome.deviation.max},
                         {"rms", outcome.deviation.rms},
                         {"volume_change", outcome.deviation.volume_change},
                         {"normal_change_deg", outcome.deviation.normal_change_deg}};
  object["untangled"] = {{"inverted_before", outcome.untangled.before},
                         {"inverted_after", outcome.untangled.after},
                         {"moved_vertices", outcome.untangled.moved.size()}};
  object["gradient_ratio"] = outcome.run.gradient_ratio;
  object["relative_energy_change"] = outcome.run.energy_change;
  object["relative_move"] = outcome.run.relative_move;
  Json limited;
  for (std::size_t bit = 0; bit < kLimitBits; ++bit)
    limited[std::string(limit_name(limit_of_bit(bit)))] = outcome.limits[bit];
  object["limited_in_last_step"] = std::move(limited);
  object["turned_over"] = outcome.turned_over.size();
  if (outcome.polish) {
    object["polish"] = {{"iterations", outcome.polish->iterations},
                        {"energy_before", outcome.run.after.energy},
                        {"stopped", name_of(outcome.polish->stopped)},
                        {"stopped_because", to_string(outcome.polish->stopped, broken_by)},
                        {"seconds", outcome.polish->seconds}};
  }
  object["notes"] = outcome.notes;
  return object;
}

std::string summary(const SmoothOutcome& outcome) {
  const auto line = [](const char* label, double before, double after, const char* unit) {
    return std::string(label) + number_text(before) + " -> " + number_text(after) + unit;
  };
  std::string text =
      line("smallest angle ", outcome.before.min_angle_deg, outcome.after.min_angle_deg, " deg, ");
  text += line("largest ", outcome.before.max_angle_deg, outcome.after.max_angle_deg, " deg, ");
  text +=
      line("mean of smallest ", outcome.before.mean_min_angle_deg, outcome.after.mean_min_angle_deg, " deg");
  return text;
}

class SmoothCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "smooth"; }
  [[nodiscard]] std::string summary() const override {
    return "Move the vertices of a mesh so that its triangles get better";
  }
  [[nodiscard]] std::string notes() const override {
    return "Minimises the sum of E^p, E = (1 - mu) K + mu S, over the triangles: K = kappa + 1/kappa "
           "measures\n"
           "angles, S = sqrt(det) + 1/sqrt(det) areas, both against the reference triangle. Vertices move "
           "in\n"
           "the tangent plane only, along ridges, and not at all at corners. No triangle is turned over,\n"
           "none comes to cross another where none did, and the energy never rises. Nor does one get a\n"
           "worse angle than the worst of the input (angles up to 120 degrees where none is over 100), even\n"
           "where the energy would be less for it; the report counts that under fold. That limit is off\n"
           "where areas count more than angles (a mu above 0.5) and where the reference has angles of its\n"
           "own (--reference). What cannot be treated (non-manifold places, degenerate triangles) is pinned\n"
           "and named.\n"
           "\n"
           "A run stops after --iterations steps, or when the tangent gradient falls below T times its "
           "start, the\n"
           "largest move below T mean edges, or the relative decrease of the energy below T five times in a "
           "row; "
           "--tolerance 0\n"
           "does exactly --iterations steps. A --polish follows with steps of its own, for which angles "
           "count and\n"
           "the energy may rise.\n"
           "\n"
           "--method laplacian and angle-based are what others do, to compare with: no energy guides them, "
           "and "
           "they\n"
           "stop by --iterations or the largest move.\n"
           "\n"
           "Examples:\n"
           "  isorelax smooth part.off -o better.off --report report.json\n"
           "  isorelax smooth part.off -o better.off --frames run.png --every 2 --view iso\n"
           "  isorelax smooth plate.obj -o plate2.obj --mu 0.5 --boundary slide --iterations 500\n"
           "  isorelax smooth moved.ply -o moved.ply --reference initial.ply --pin held.txt\n"
           "  isorelax smooth square.off -o other.off --method angle-based --weighting plain --guard off";
  }
  void declare(CLI::App& app) override {
    app.add_option("IN", input_, "Mesh to smooth: " + format_names())->required();
    app.add_option("-o,--output", output_, "File to write: " + format_names() + " by its extension")
        ->required()
        ->type_name("OUT");
    run_.declare(app);
    app.add_option("--trace", trace_, "Record every iteration in this file, for isorelax trace")
        ->type_name("FILE");
    watch_.declare(app);
    frames_.declare(app);
    app.add_option("--report", report_, "Write a JSON report here")->type_name("FILE");
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    run_.check();
    watch_.check();
    std::error_code ignored;
    if (std::filesystem::is_directory(output_, ignored)) throw OutputError(output_, "is a folder");
    if (!format_of_extension(output_))
      throw UsageError(output_ + ": the extension names no format that is written: " + format_names());
    MeshFile file = read_input_file(console, input_);
    TriangleMesh& mesh = file.mesh;
    watch_.check(mesh);
    check_files();
    frames_.start(mesh.positions);
    const std::vector<Vec3> before = mesh.positions;
    const SmoothOutcome outcome = smooth(console, mesh);
    const std::size_t refreshed = refresh_normals(mesh, before);
    if (refreshed > 0)
      console.message(input_ + ": " + std::to_string(refreshed) + " stored normals were made to fit again");
    for (const std::string& note : outcome.notes) console.message(input_ + ": " + note);
    if (!report_.empty())
      write_file_atomically(report_, json_text(outcome_to_json(outcome, watch_.broken_by())));
    if (const auto fault = fault_of(outcome)) {
      console.error(output_ + " is not written: " + *fault);
      return kCheckFailed;
    }
    for (const std::string& message : write_mesh(output_, mesh, write_like(file, output_)))
      console.message(output_ + ": " + message);
    frames_.write(console, mesh, outcome.run.iterations + (outcome.polish ? outcome.polish->iterations : 0));
    console.message(cli::summary(outcome));
    console.message("distance from the input surface " + number_text(outcome.deviation.max) + " at most, " +
                    number_text(outcome.deviation.rms) + " RMS (of the bounding-box diagonal)" +
                    (outcome.deviation.has_volume
                         ? ", volume change " + number_text(100 * outcome.deviation.volume_change) + " %"
                         : ""));
    console.message("stopped after " + std::to_string(outcome.run.iterations) +
                    (outcome.run.iterations == 1 ? " iteration: " : " iterations: ") +
                    to_string(outcome.run.stopped, watch_.broken_by()));
    // That it ends by moving nothing is how it always does.
    if (outcome.polish)
      console.message("polished in " + std::to_string(outcome.polish->iterations) + " more" +
                      (outcome.polish->stopped == StopReason::movement
                           ? ""
                           : ": " + to_string(outcome.polish->stopped, watch_.broken_by())));
    return kDone;
  }

 private:
  /// Before the long work, not after it. The mesh may be written to where it came from.
  void check_files() const {
    check_outputs({{{"--output", output_}, {"--report", report_}, {"--trace", trace_}}}, run_.files());
    check_outputs({{{"--report", report_}, {"--trace", trace_}}}, {input_});
  }

  /// Why the result of an unguarded run may not be written; a guarded one has no fault.
  [[nodiscard]] std::optional<std::string> fault_of(const SmoothOutcome& outcome) const {
    if (outcome.ran_away) {
      return "without a guard vertex " + std::to_string(*outcome.ran_away) +
             " ran away, by more than a million diagonals of the mesh";
    }
    if (!outcome.turned_over.empty()) {
      return "without a guard " + std::to_string(outcome.turned_over.size()) +
             " triangles were turned over, the first " + std::to_string(outcome.turned_over.front());
    }
    if (run_.limit().max && is_over_limit(outcome.deviation.max, *run_.limit().max)) {
      return "without a guard the surface went " + number_text(outcome.deviation.max) +
             " from the input, farther than --max-deviation allows";
    }
    return std::nullopt;
  }

  /// Runs, recording and watching as asked.
  SmoothOutcome smooth(Console& console, TriangleMesh& mesh) {
    if (trace_.empty() && !watch_.wanted()) {
      if (!frames_.wanted()) return run_.smooth(console, input_, mesh);
      return run_.smooth(console, input_, mesh,
                         [&](unsigned iteration, const StepRecord&, std::span<const Vec3> positions) {
                           frames_.take(iteration, positions);
                           return true;
                         });
    }
    Trace about;
    about.program = "isorelax " ISORELAX_VERSION;
    about.input = input_;
    about.arguments = run_.words(mesh);
    about.resources = run_.resources();
    TraceRecorder recorder(std::move(about), mesh, run_.threads());
    SmoothOutcome outcome = run_.smooth(
        console, input_, mesh,
        [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> positions) {
          recorder.add(iteration, record, positions);
          frames_.take(iteration, positions);
          const bool goes_on = watch_.look(console, recorder.trace(), record, positions);
          if (!goes_on) recorder.trace().interrupted = true;
          return goes_on;
        },
        [&](const RunPart& part, std::span<const Vec3> positions) {
          if (part.begins_run() && !recorder.trace().iterations.empty()) watch_.begin_again(console);
          recorder.begin_part(part, positions);
        });
    watch_.finish(console, recorder.trace());
    const bool broken = !watch_.broken_by().empty();
    if (broken) (outcome.polish ? *outcome.polish : outcome.run).stopped = StopReason::breakpoint;
    if (!trace_.empty()) {
      const StopReason stopped = broken ? StopReason::breakpoint : outcome.run.stopped;
      recorder.trace().stopped = name_of(stopped);
      recorder.trace().stopped_because = to_string(stopped, watch_.broken_by());
      write_trace(trace_, recorder.trace());
    }
    return outcome;
  }

  std::string input_, output_, report_, trace_;
  SmoothRun run_;
  Watch watch_;
  Frames frames_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_smooth_command() {
  return std::make_unique<SmoothCommand>();
}

}  // namespace isorelax::cli
