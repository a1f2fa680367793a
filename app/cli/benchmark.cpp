#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/benchmark_motion.h"
#include "cli/benchmark_paper.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/table.h"
#include "generate/generate.h"
#include "io/atomic_file.h"
#include "mesh/error.h"
#include "mesh/halfedge_mesh.h"
#include "smoothing/run.h"

namespace isorelax::cli {
namespace {

/// Nanoseconds per triangle of one step, on one mesh.
struct SpeedRow {
  std::string mesh;
  std::size_t triangles = 0;
  double jacobi_one_thread = 0;
  double jacobi_all_threads = 0;
  double openmesh_laplace = 0;
};

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// The three opponents in turn, round by round, so that a change of the machine's speed meets them all. What
/// is compared is the median round.
SpeedRow measure_speed(const std::string& name, const TriangleMesh& mesh, unsigned rounds) {
  // Frozen once: only the steps are timed. The energy itself is what the paper's step minimises, and tangent
  // moves are what it and the Laplace smoother share.
  ProblemOptions options;
  options.exponent = 1;
  options.surface = SurfaceRule::tangent;
  options.threads = 1;
  const SmoothingProblem one = make_problem(mesh.positions, mesh.triangles, options);
  options.threads = 0;
  const SmoothingProblem all = make_problem(mesh.positions, mesh.triangles, options);
  const auto smoother_one = make_jacobi(one);
  const auto smoother_all = make_jacobi(all);
  HalfedgeMesh halfedges(mesh);
  std::vector<Vec3> x_one = mesh.positions;
  std::vector<Vec3> x_all = mesh.positions;
  StepRecord record;
  const auto step = [&](Smoother& smoother, std::vector<Vec3>& x) {
    smoother.step(x, record);
    apply_step(record, x);
  };
  std::vector<double> times_one, times_all, times_laplace;
  for (unsigned round = 0; round <= rounds; ++round) {
    const double t1 = seconds_of([&] { step(*smoother_one, x_one); });
    const double t2 = seconds_of([&] { step(*smoother_all, x_all); });
    const double t3 = seconds_of([&] { halfedges.smooth_laplace(1); });
    if (round == 0) continue;  // pages are touched for the first time
    times_one.push_back(t1);
    times_all.push_back(t2);
    times_laplace.push_back(t3);
  }
  const double scale = 1e9 / static_cast<double>(mesh.triangles.size());
  return {name, mesh.triangles.size(), scale * median(times_one), scale * median(times_all),
          scale * median(times_laplace)};
}

TriangleMesh shaken(ShapeKind kind, std::size_t triangles) {
  GenerateOptions options;
  options.triangles = triangles;
  options.jitter = 0.3;
  return generate(kind, options);
}

class BenchmarkCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "benchmark"; }
  [[nodiscard]] std::string summary() const override {
    return "Measure the smoother beside others in the same run";
  }
  [[nodiscard]] std::string notes() const override {
    return "speed   Nanoseconds per triangle of one Jacobi step (the paper's: exponent 1; direction, fold "
           "control\n"
           "        and energy guard included), on one thread and on all, beside one step of OpenMesh's "
           "Laplace\n"
           "        smoother (tangential, C0) on the same mesh: a plane with shaken vertices and a shaken "
           "torus,\n"
           "        in natural order. The three take turns; each figure is the median of --rounds steps.\n"
           "paper   Table 1 of the paper in kind: smallest and largest angle of three relatively uniform and "
           "three\n"
           "        random meshes, as made and after the methods that the paper compares, with the figures "
           "it "
           "prints\n"
           "        beside ours; below them what converged solvers reach. It lists what the paper leaves "
           "open "
           "and\n"
           "        what was chosen. --picture draws meshes before and after, like the paper's Fig. 2.\n"
           "motion  Eq. (10) of the paper on a sphere, out and back: pure advection, the paper's recipe as "
           "printed\n"
           "        and the presets of isorelax advect, at T 3 and 0.75, their convergence, and goals met or "
           "missed.\n"
           "        Takes a quarter of an hour on two cores; --vertices and --convergence 0 make it "
           "shorter.\n"
           "\n"
           "Examples:\n"
           "  isorelax benchmark speed --triangles 10000 100000 1000000\n"
           "  isorelax benchmark paper --picture figure2.png\n"
           "  isorelax benchmark motion --picture motion.png";
  }
  void declare(CLI::App& app) override {
    app.add_option("WHAT", what_, "speed, paper or motion")->required();
    app.add_option(
           "--triangles", sizes_,
           "Sizes of the meshes (speed: default 10000 100000 1000000; paper: three for each kind, default "
           "460 2394 11704 and 454 2126 10282)")
        ->type_name("N...")
        ->check(whole_number(1));
    app.add_option("--rounds", rounds_, "speed: steps that are timed (default 15)")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    app.add_option("--seed", paper_.seed, "paper: number that the meshes follow from (default 1)")
        ->type_name("S")
        ->check(whole_number(0));
    app.add_option("--iterations", paper_.iterations, "paper: steps of the published methods (default 50)")
        ->type_name("N")
        ->check(whole_number(1));
    app.add_option("--vertices", motion_.vertices, "motion: of the sphere (default 5832)")
        ->type_name("N")
        ->check(whole_number(4));
    app.add_option("--step", motion_.step, "motion: length of a time step (default 0.01)")
        ->type_name("DT")
        ->check(number_between(1e-5, 1));
    app.add_option("--convergence", convergence_,
                   "motion: sizes of the convergence study (default 1500 6000 24000); 0: none")
        ->type_name("N...")
        ->check(whole_number(0));
    app.add_option("--picture", picture_,
                   "paper: PNG to write, two meshes before and after; motion: every preset at T/4, T/2 and T")
        ->type_name("PNG");
    app.add_flag("--json", json_, "Print one JSON object");
    app.add_flag("--quiet", quiet_, "Print nothing but errors and results");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    if (what_ == "speed" && !picture_.empty())
      throw UsageError("benchmark speed: has no pictures, --picture is of paper and motion");
    if (what_ == "speed") return run_speed(console);
    if (what_ == "paper") return run_paper(console);
    if (what_ == "motion") return run_motion(console);
    throw UsageError("benchmark " + what_ + ": expected speed, paper or motion");
  }

 private:
  int run_speed(Console& console) const {
    const std::vector<std::size_t> sizes =
        sizes_.empty() ? std::vector<std::size_t>{10000, 100000, 1000000} : sizes_;
    std::vector<SpeedRow> rows;
    {
      Progress progress(console, "benchmark");
      double done = 0;
      for (const auto& [kind, name] :
           {std::pair{ShapeKind::hexagonal_square, "plane"}, std::pair{ShapeKind::torus, "torus"}}) {
        for (const std::size_t size : sizes) {
          progress.update(done++ / (2.0 * static_cast<double>(sizes.size())),
                          std::string(name) + " " + std::to_string(size));
          rows.push_back(measure_speed(name, shaken(kind, size), rounds_));
        }
      }
    }
    console.result(json_ ? json_text(object(rows)) : text(rows));
    return kDone;
  }

  void check_picture() const {
    if (picture_.empty()) return;
    render::require_png_name(picture_);
    check_writable(picture_);
  }

  int run_motion(Console& console) {
    check_picture();
    if (!convergence_.empty()) motion_.convergence = convergence_;
    std::erase(motion_.convergence, 0);
    MotionTable table;
    {
      Progress progress(console, "benchmark");
      table = compute_motion_table(
          motion_, [&](double share, std::string_view preset) { progress.update(share, preset); });
    }
    if (!picture_.empty()) render::write_png(picture_, motion_picture(table));
    console.result(json_ ? json_text(motion_json(table)) : motion_text(table));
    return kDone;
  }

  int run_paper(Console& console) {
    if (!sizes_.empty() && sizes_.size() != 3)
      throw UsageError("benchmark paper --triangles: expected three sizes");
    if (!sizes_.empty()) paper_.triangles = {sizes_[0], sizes_[1], sizes_[2]};
    check_picture();
    std::vector<PaperRow> rows;
    {
      Progress progress(console, "benchmark");
      rows = compute_paper_table(
          paper_, [&](double share, std::string_view method) { progress.update(share, method); });
    }
    if (!picture_.empty()) render::write_png(picture_, paper_picture(rows));
    console.result(json_ ? json_text(paper_json(rows, paper_)) : paper_text(rows, paper_));
    return kDone;
  }

  static Json object(const std::vector<SpeedRow>& rows) {
    Json list = Json::array();
    for (const SpeedRow& row : rows) {
      list.push_back({{"mesh", row.mesh},
                      {"triangles", row.triangles},
                      {"jacobi_one_thread_ns", row.jacobi_one_thread},
                      {"jacobi_all_threads_ns", row.jacobi_all_threads},
                      {"openmesh_laplace_ns", row.openmesh_laplace}});
    }
    return {{"unit", "nanoseconds per triangle and step"}, {"rows", std::move(list)}};
  }

  static std::string text(const std::vector<SpeedRow>& rows) {
    std::string text =
        "ns per triangle and step    Jacobi, 1 thread   Jacobi, all threads   OpenMesh Laplace\n";
    for (const SpeedRow& row : rows) {
      char line[120];
      std::snprintf(line, sizeof line, "%-6s %10zu triangles %16.1f %21.1f %18.1f\n", row.mesh.c_str(),
                    row.triangles, row.jacobi_one_thread, row.jacobi_all_threads, row.openmesh_laplace);
      text += line;
    }
    return text;
  }

  std::string what_;
  std::vector<std::size_t> sizes_;
  unsigned rounds_ = 15;
  PaperTableOptions paper_;
  MotionTableOptions motion_;
  std::vector<std::size_t> convergence_;
  std::string picture_;
  bool json_ = false;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_benchmark_command() {
  return std::make_unique<BenchmarkCommand>();
}

}  // namespace isorelax::cli
