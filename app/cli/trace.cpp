#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/output_files.h"
#include "cli/smooth_run.h"
#include "cli/table.h"
#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "io/text_in.h"
#include "mesh/error.h"
#include "trace/predicate.h"
#include "trace/recorder.h"
#include "trace/trace_diff.h"
#include "trace/trace_export.h"
#include "trace/trace_file.h"
#include "trace/trace_parts.h"

namespace isorelax::cli {
namespace {

/// A right-aligned table of the iterations, one line each.
std::string iteration_table(const Trace& trace) {
  std::string text =
      "  iter        energy  smallest   largest      mean   moved  largest move  passes  step          "
      "limited\n";
  const auto line = [&](std::size_t k, double energy, const TraceQuality& quality, const std::string& rest) {
    std::array<char, 128> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%6zu  %12.6g  %7.3f°  %7.3f°  %7.3f°", k, energy,
                  quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg);
    text += buffer.data() + rest + "\n";
  };
  const double start = trace.iterations.empty() ? 0 : trace.iterations.front().before.energy;
  line(0, start, trace.quality, "");
  for (std::size_t k = 1; k <= trace.iterations.size(); ++k) {
    const TraceIteration& one = trace.iterations[k - 1];
    std::array<char, 96> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "  %6zu  %12.4g  %3zu+%-2zu  %-12s ", one.moved,
                  one.largest_move, one.fold_passes, one.energy_passes,
                  std::string(step_kind_name(one.kind)).c_str());
    std::string limits;
    for (std::size_t bit = 0; bit < one.limits.size(); ++bit) {
      if (one.limits[bit] == 0) continue;
      limits += (limits.empty() ? " " : ", ") + std::to_string(one.limits[bit]) + " " +
                std::string(limit_name(limit_of_bit(bit)));
    }
    line(k, one.after.energy, one.quality, buffer.data() + limits);
  }
  return text;
}

/// "0,5,last" or "every:10" or "all" as iterations of a trace.
std::vector<std::size_t> parse_iterations(const std::string& text, std::size_t last) {
  std::vector<std::size_t> chosen;
  const auto number = [&](std::string_view word) {
    std::size_t value = 0;
    if (!read_number(word, value))
      throw UsageError("--iterations " + text +
                       ": expected all, every:K, or numbers and last between commas");
    return value;
  };
  if (text == "all" || text.rfind("every:", 0) == 0) {
    const std::size_t step = text == "all" ? 1 : number(std::string_view(text).substr(6));
    if (step == 0) throw UsageError("--iterations every:0: every how many?");
    for (std::size_t k = 0; k < last; k += step) chosen.push_back(k);
    chosen.push_back(last);
    return chosen;
  }
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string_view word = std::string_view(text).substr(at, comma - at);
    const std::size_t k = word == "last" ? last : number(word);
    if (k > last)
      throw UsageError("--iterations: " + std::to_string(k) + " is not in the trace, whose last is " +
                       std::to_string(last));
    chosen.push_back(k);
    at = comma + 1;
  }
  return chosen;
}

class TraceCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "trace"; }
  [[nodiscard]] std::string summary() const override {
    return "Look at recorded runs: show, export, diff, replay";
  }
  [[nodiscard]] std::string notes() const override {
    return "smooth --trace FILE records a run: its mesh, its arguments, and every iteration to the bit.\n\n"
           "Examples:\n"
           "  isorelax trace show run.trace\n"
           "  isorelax trace export run.trace --csv run.csv --vtk series --iterations every:10\n"
           "  isorelax trace diff first.trace second.trace\n"
           "  isorelax trace replay run.trace\n"
           "  isorelax smooth in.off -o out.off --log 'min_angle < 5' --break 'vertex(812).alpha < 0.1'\n\n"
           "Predicates of smooth --break and --log: numbers, the names below, + - * / < <= > >= == != ! && "
           "|| "
           "and\nparentheses:\n" +
           Predicate::reference();
  }

  void declare(CLI::App& app) override {
    app.require_subcommand(1);
    show_ = app.add_subcommand("show", "A table of the iterations");
    show_->footer("Example:\n  isorelax trace show run.trace");
    show_->add_option("TRACE", file_, "Recorded run")->required();
    show_->add_flag("--json", json_, "The same as JSON");
    declare_export(app);
    diff_ = app.add_subcommand("diff", "Where two runs part; exit status 1 when they do");
    diff_->footer("Example:\n  isorelax trace diff first.trace second.trace");
    diff_->add_option("A", file_, "Recorded run")->required();
    diff_->add_option("B", other_, "Recorded run")->required();
    diff_->add_flag("--json", json_, "As JSON");
    replay_ = app.add_subcommand(
        "replay",
        "Do the run again and compare every position to the bit; exit status 1 where one differs. What was "
        "broken off or forked in the editor is done again part by part");
    replay_->footer("Example:\n  isorelax trace replay run.trace");
    replay_->add_option("TRACE", file_, "Recorded run")->required();
    replay_->add_option("--threads", threads_, "Threads (default: all; results do not depend on it)")
        ->type_name("N");
  }

  int run(Console& console) override {
    const Trace trace = read_trace(file_);
    if (show_->parsed()) return show(console, trace);
    if (export_->parsed()) return write_exports(console, trace);
    if (diff_->parsed()) return diff(console, trace);
    return replay(console, trace);
  }

 private:
  void declare_export(CLI::App& app) {
    export_ = app.add_subcommand("export", "Numbers and meshes for other programs");
    export_->footer(
        "Example:\n  isorelax trace export run.trace --csv run.csv --vtk series --iterations every:10");
    export_->add_option("TRACE", file_, "Recorded run")->required();
    export_->add_option("--csv", csv_, "Numbers of every iteration, a line each")->type_name("FILE");
    export_->add_option("--json", json_file_, "The same with the run's arguments")->type_name("FILE");
    export_->add_option("--meshes", meshes_, "Folder for the meshes of the chosen iterations")
        ->type_name("FOLDER");
    export_->add_option("--format", format_, "Their format: " + format_names() + " (default OFF)")
        ->check(mesh_format())
        ->type_name("F");
    export_->add_option("--vtk", vtk_, "Folder for a series that ParaView opens (trace.pvd)")
        ->type_name("FOLDER");
    export_
        ->add_option("--iterations", iterations_,
                     "Which: all, every:K, or numbers and last between commas (default 0,last)")
        ->type_name("LIST");
  }

  int show(Console& console, const Trace& trace) const {
    if (json_) {
      console.result(trace_json(trace));
      return kDone;
    }
    Table table;
    table.row("program", trace.program);
    table.row("input", trace.input);
    table.row("mesh", std::to_string(trace.positions.size()) + " vertices, " +
                          std::to_string(trace.triangles.size()) + " triangles");
    table.row("arguments", trace.arguments.empty() ? "none" : trace.arguments_text());
    for (const TraceResource& file : trace.resources) table.row("read", file.path + " (" + file.hash + ")");
    for (const TracePart& part : trace.parts) {
      // One that is all that the arguments say has nothing to tell.
      if (trace.parts.size() > 1 || says_more_than_words(trace, part)) table.row("part", part_text(part));
    }
    table.row("stopped", trace.stopped_because);
    console.result(one_line_each(table.text()) + "\n" + iteration_table(trace));
    return kDone;
  }

  /// The table with control characters of foreign names made harmless.
  static std::string one_line_each(std::string text) {
    for (char& c : text) {
      if (c != '\n' && static_cast<unsigned char>(c) < 32) c = ' ';
    }
    return text;
  }

  int write_exports(Console& console, const Trace& trace) const {
    if (csv_.empty() && json_file_.empty() && meshes_.empty() && vtk_.empty())
      throw UsageError("nothing to export: give --csv, --json, --meshes or --vtk");
    const auto chosen = parse_iterations(iterations_, trace.iterations.size());
    check_outputs({{{"--csv", csv_}, {"--json", json_file_}}}, {file_});
    if (!csv_.empty()) write_file_atomically(csv_, trace_csv(trace));
    if (!json_file_.empty()) write_file_atomically(json_file_, trace_json(trace));
    std::size_t files = (csv_.empty() ? 0 : 1) + (json_file_.empty() ? 0 : 1);
    if (!meshes_.empty()) files += export_meshes(trace, chosen, meshes_, "." + format_).size();
    if (!vtk_.empty()) files += export_vtk_series(trace, chosen, vtk_).size();
    console.message("wrote " + std::to_string(files) + (files == 1 ? " file" : " files"));
    return kDone;
  }

  int diff(Console& console, const Trace& trace) const {
    const TraceDifference found = compare_traces(trace, read_trace(other_));
    if (json_) {
      console.result(json_text(to_json(found)));
      return found.none() ? kDone : kCheckFailed;
    }
    std::string text;
    for (const TraceSetting& setting : found.settings)
      text += one_line(setting.name + ": " + setting.first + " | " + setting.second) + "\n";
    if (!found.same_triangles) {
      text += "the meshes have different triangles: nothing more can be compared\n";
    } else if (found.parting) {
      text += "they part at " + parting_text(*found.parting) + "\n";
      text += "after iteration " + std::to_string(found.common_iterations) + " the farthest vertex is " +
              number_text(found.distance_at_end) + " apart\n";
    } else {
      text += "the same to the bit for " + std::to_string(found.common_iterations) + " iterations\n";
    }
    console.result(text);
    return found.none() ? kDone : kCheckFailed;
  }

  static Json to_json(const TraceDifference& found) {
    Json json;
    json["same"] = found.none();
    json["same_triangles"] = found.same_triangles;
    json["common_iterations"] = found.common_iterations;
    json["distance_at_end"] = found.distance_at_end;
    json["settings"] = Json::array();
    for (const TraceSetting& setting : found.settings)
      json["settings"].push_back(
          {{"name", setting.name}, {"first", setting.first}, {"second", setting.second}});
    json["parting"] = nullptr;
    if (found.parting) {
      const auto point = [](const Vec3& p) { return Json{p.x(), p.y(), p.z()}; };
      json["parting"] = {{"iteration", found.parting->iteration},  {"vertex", found.parting->vertex},
                         {"vertices", found.parting->vertices},    {"first", point(found.parting->first)},
                         {"second", point(found.parting->second)}, {"largest", found.parting->largest}};
    }
    return json;
  }

  int replay(Console& console, const Trace& trace) const {
    return is_whole_run(trace) ? replay_run(console, trace) : replay_by_parts(console, trace);
  }

  /// Whether the arguments alone say all that was done: not where it was broken off, nor for branches of the
  /// editor.
  static bool is_whole_run(const Trace& trace) {
    return trace.parts.empty() ||
           (!trace.interrupted &&
            std::ranges::none_of(trace.parts, [](const TracePart& p) { return p.words.has_value(); }));
  }

  int replay_by_parts(Console& console, const Trace& trace) const {
    const auto parting = replay_parts(trace, [&](const RunWords& words, const TriangleMesh& mesh) {
      check_resources(words);
      RunPlan plan = read_plan(words, mesh);
      if (threads_) plan.problem.threads = *threads_;
      return plan;
    });
    if (parting) {
      console.result("the replay parts at " + parting_text(*parting) + "\n");
      return kCheckFailed;
    }
    console.result("the same to the bit for " + std::to_string(trace.iterations.size()) +
                   " iterations, done again in " + std::to_string(trace.parts.size()) +
                   (trace.parts.size() == 1 ? " part\n" : " parts, each from where it began\n"));
    return kDone;
  }

  int replay_run(Console& console, const Trace& trace) const {
    check_resources(trace);
    CLI::App app;
    SmoothRun run;
    read_words(run, app, trace.arguments);
    if (threads_) run.set_threads(*threads_);
    TriangleMesh mesh{trace.positions, trace.triangles, {}};
    TraceRecorder recorder({}, mesh, run.threads());
    (void)run.smooth(
        console, trace.input, mesh,
        [&](unsigned k, const StepRecord& step, auto positions) {
          recorder.add(k, step, positions);
          return true;
        },
        [&](const RunPart& part, auto positions) { recorder.begin_part(part, positions); });
    const Trace& again = recorder.trace();
    const TraceDifference found = compare_traces(trace, again);
    if (found.none()) {
      console.result("the same to the bit for " + std::to_string(found.common_iterations) + " iterations\n");
      return kDone;
    }
    if (found.parting) {
      console.result("the replay parts at " + parting_text(*found.parting) + "\n");
    } else {
      console.result("the recorded run has " + std::to_string(trace.iterations.size()) +
                     " iterations, the replay " + std::to_string(again.iterations.size()) + "\n");
    }
    return kCheckFailed;
  }

  CLI::App *show_ = nullptr, *export_ = nullptr, *diff_ = nullptr, *replay_ = nullptr;
  std::string file_, other_, csv_, json_file_, meshes_, vtk_;
  std::string iterations_ = "0,last";
  std::string format_ = "off";
  std::optional<unsigned> threads_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_trace_command() {
  return std::make_unique<TraceCommand>();
}

}  // namespace isorelax::cli
