#include <CLI/App.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/motion_options.h"
#include "cli/motion_pictures.h"
#include "cli/motion_series.h"
#include "cli/output_files.h"
#include "cli/table.h"
#include "io/atomic_file.h"
#include "io/mesh_file.h"

namespace isorelax::cli {
namespace {

/// Set by the first interrupt; the second one ends the program as ever.
std::atomic<bool> interrupted{false};

void note_interrupt(int) {
  interrupted.store(true);
  std::signal(SIGINT, SIG_DFL);
}

/// Notes interrupts as long as it lives.
class InterruptWatch {
 public:
  InterruptWatch() : previous_(std::signal(SIGINT, note_interrupt)) {}
  ~InterruptWatch() { std::signal(SIGINT, previous_); }
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  void (*previous_)(int);
};

constexpr const char* kAdvectNotes =
    "A mesh is carried by a motion; its connectivity never changes. DIR gets the start, every N-th state,\n"
    "an index for ParaView (states.ply.series; with --vtk also states.pvd) and log.json with one entry a "
    "step:\n"
    "angles, areas, volume, folded edges, and the error where it is known: of spheres the distance of\n"
    "vertices from the exact one after whole periods or at constant speed; in rigid and shear motion, that\n"
    "of vertices without redistribution from their exact places, of others from where the start's points\n"
    "nearest to them are taken. \"deviation\" is, of carrier moves, the distance between the mesh and the\n"
    "surface that the motion made of the start, at the vertices and the middles of edges; of tangent moves\n"
    "that of one step's moved vertices from the mesh before, which gathers. Lengths are those of the mesh.\n"
    "\n"
    "Fields:\n"
    "  paper[:T]        Eq. (10) of the paper; reverses at T/2 (default T 3)\n"
    "  enright[:T]      LeVeque's deformation, as Enright et al. use it\n"
    "  rigid:WX,WY,WZ[@CX,CY,CZ][+VX,VY,VZ]   turning and going on\n"
    "  shear:RATE       u = RATE y along x\n"
    "  normal:SPEED     along the normal, by face offsetting; a number or an expression\n"
    "  expr:U;V;W       three expressions in x, y, z, t (muParser)\n"
    "  file:FILE        VTK legacy text, STRUCTURED_POINTS with VECTORS\n"
    "\n"
    "Presets:\n"
    "  none       vertices go with the flow\n"
    "  paper      as the paper prints it: face offsetting, then a Jacobi step of Eq. (9) in tangent planes\n"
    "  accuracy   the carrier family, held to the finest parts of the shape\n"
    "  balanced   the carrier family, between shape and angles\n"
    "  angles     the carrier family, angles first: thin ends may be drawn in\n"
    "The carrier family advects the start mesh itself (the carrier), and every vertex holds a point on it: "
    "its\n"
    "position comes from cubic fits of the motion over the start surface. So whatever vertices do between "
    "steps,\n"
    "no geometric error accumulates. Creases, corners and borders keep their vertices. The volume is kept by "
    "moves\n"
    "along normals, in proportion to the height of the surface over the middles of the edges.\n"
    "\n"
    "Interrupted (Ctrl-C), a run writes its state, or nothing before it begins, and ends with status 1;\n"
    "--resume goes on from any written state with the result of a straight run, bit for bit. A field that\n"
    "fails or blows up ends the run with status 3; what was written stays.\n"
    "\n"
    "Examples:\n"
    "  isorelax advect -o band --pictures --figure figure3.png\n"
    "  isorelax advect ball.off -o turned --field rigid:0,0,6.28318 --until 1 --preset none\n"
    "  isorelax advect --sphere 2000:1:0,0,0 -o swirl --field 'expr:-y;x;0.2*sin(t)' --until 2 --exact\n"
    "  isorelax advect --resume band/state_000150.ply";

class AdvectCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "advect"; }
  [[nodiscard]] std::string summary() const override {
    return "Carry a surface by a motion while its vertices are redistributed";
  }
  [[nodiscard]] std::string notes() const override { return kAdvectNotes; }
  void declare(CLI::App& app) override {
    app.add_option("IN", input_, "Mesh to start from: " + format_names() + "; none: a sphere");
    app.add_option("-o,--output", output_, "Folder to write")->type_name("DIR");
    app.add_option("--resume", resume_,
                   "Go on from this state of an earlier run, in its folder, with its options; --threads may "
                   "differ")
        ->type_name("STATE");
    motion_.declare(app);
    app.add_option("--save-every", save_every_, "Write every N-th state (default: about 30 in all)")
        ->type_name("N")
        ->check(whole_number(1));
    app.add_flag("--vtk", vtk_, "Write states for VTK too, with an index states.pvd");
    app.add_flag("--exact", exact_,
                 "Advect a dense copy of the start as ground truth too; written states tell the distances");
    app.add_flag("--pictures", pictures_, "Draw every written state, on one camera and one range of areas");
    app.add_option("--figure", figure_, "PNG to write: six moments side by side, like the paper's Fig. 3")
        ->type_name("PNG");
    app.add_option("--camera", camera_, "Of pictures, see isorelax render (default fit)")->type_name("SPEC");
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    if (output_.empty() == resume_.empty())
      throw UsageError(output_.empty() ? "advect: give --output DIR or --resume STATE"
                                       : "advect: give either --output DIR or --resume STATE, not both: a "
                                         "state is gone on with in its own folder");
    if (!figure_.empty()) render::require_png_name(figure_);
    check_outputs({{{"--figure", figure_}}}, {input_, resume_});
    static_cast<void>(pictures());  // a mistake in the camera is told now, not after the run
    watch_.emplace();
    return resume_.empty() ? begin(console) : resume(console);
  }

 private:
  static constexpr unsigned kDenseTriangles = 200000;
  static constexpr double kStates = 30;

  /// Two cuts of every triangle into four, one where that would be too many.
  static unsigned dense_levels(const TriangleMesh& start) {
    return 16 * start.triangles.size() <= kDenseTriangles ? 2 : 1;
  }

  int begin(Console& console) {
    MotionSetup setup = motion_.set_up(console, input_);
    const auto start = setup.start;
    const unsigned levels = exact_ ? dense_levels(start) : 0;
    MotionRun run = make_run(std::move(setup), levels);
    if (interrupted.load()) {
      console.error("cancelled before anything was written");
      return kCheckFailed;
    }
    if (save_every_ == 0) choose_states(run.setup());
    MotionSeries series(output_);
    Json asked = {{"program", "isorelax " ISORELAX_VERSION},
                  {"input", input_},
                  {"options", motion_.words()},
                  {"vtk", vtk_},
                  {"exact", exact_}};
    if (save_every_ > 0)
      asked["save_every"] = save_every_;
    else
      asked["save_interval"] = save_interval_;
    series.begin(start, asked);
    record(series, run);
    series.write_state(run, vtk_);
    return go(console, series, run);
  }

  /// Steps of error control are as many as they come to: their states are chosen by time.
  void choose_states(const MotionSetup& setup) {
    if (setup.options.tolerance)
      save_interval_ = setup.until / kStates;
    else
      save_every_ =
          static_cast<unsigned>(std::max(1.0, std::round(setup.until / setup.options.step / kStates)));
  }

  /// What run.json says of the states that are written.
  void read_states_chosen(const Json& asked) {
    if (asked.contains("save_interval")) {
      save_interval_ = asked["save_interval"].get<double>();
      if (!(save_interval_ > 0)) throw UsageError("save_interval is no number over 0");
      return;
    }
    const Json& every = asked.at("save_every");
    constexpr unsigned kMost = std::numeric_limits<unsigned>::max();
    if (!every.is_number_unsigned() || every == 0U || every > kMost)
      throw UsageError("save_every is no whole number of 1 or more");
    save_every_ = every.get<unsigned>();
  }

  /// Options that were typed beside --resume: all but the number of threads are those of the run.
  [[nodiscard]] std::vector<std::string> words_beside_resume() const {
    if (!input_.empty()) throw UsageError("--resume and a mesh: the run starts from its own");
    std::vector<std::string> words = motion_.words();
    std::string other;
    for (std::size_t k = 0; k < words.size(); k += 2)
      if (words[k] != "--threads") other = words[k];
    if (save_every_ > 0) other = "--save-every";
    if (vtk_) other = "--vtk";
    if (exact_) other = "--exact";
    if (!other.empty())
      throw UsageError("--resume takes the options of run.json; " + other + " cannot be changed");
    return words;
  }

  int resume(Console& console) {
    const std::vector<std::string> typed = words_beside_resume();
    const std::filesystem::path state_path(resume_);
    const std::filesystem::path folder = state_path.parent_path().empty() ? "." : state_path.parent_path();
    const MovingState state = read_state(state_path);
    MotionSetup setup;
    try {
      const Json asked = Json::parse(read_bytes(folder / "run.json"));
      MotionSpec spec;
      spec.read(asked.at("options").get<std::vector<std::string>>());
      spec.read(typed);
      read_states_chosen(asked);
      vtk_ = asked.at("vtk").get<bool>();
      exact_ = asked.at("exact").get<bool>();
      const bool from_mesh = !asked.at("input").get<std::string>().empty();
      setup = spec.set_up(console, from_mesh ? (folder / "start.ply").string() : "");
    } catch (const nlohmann::json::exception& error) {
      throw InputError((folder / "run.json").string(), "", error.what());
    } catch (const UsageError& error) {
      throw InputError((folder / "run.json").string(), "", error.what());
    }
    const unsigned levels = exact_ ? dense_levels(setup.start) : 0;
    MotionRun run = make_run(std::move(setup), levels);
    try {
      run.restore(state);
    } catch (const MeshError& error) {
      throw MeshError(resume_ + ": " + error.what());
    }
    MotionSeries series(folder);
    series.resume_at(state.step);
    console.message("resumed at step " + std::to_string(state.step) + ", time " + number_text(state.time));
    return go(console, series, run);
  }

  MotionRun make_run(MotionSetup setup, unsigned levels) const {
    try {
      return {std::move(setup), levels};
    } catch (const MeshError& error) {
      throw MeshError((input_.empty() ? "the start" : input_) + ": " + error.what());
    }
  }

  [[nodiscard]] bool writes(const MotionRun& run) const {
    const MovingState& state = run.surface().state();
    if (run.done() || state.step == 0) return true;
    if (save_every_ > 0) return state.step % save_every_ == 0;
    const double before = state.time - run.surface().report().dt;
    return std::floor(state.time / save_interval_) > std::floor(before / save_interval_);
  }

  void record(MotionSeries& series, const MotionRun& run) const {
    series.add(run.measure(writes(run) ? MotionRun::Detail::exact : MotionRun::Detail::plain));
  }

  int go(Console& console, MotionSeries& series, MotionRun& run) {
    int status = kDone;
    try {
      Progress progress(console, "advecting");
      while (!run.done() && !interrupted.load()) {
        run.advance();
        record(series, run);
        if (writes(run)) series.write_state(run, vtk_);
        const double time = run.surface().state().time;
        progress.update(time / run.setup().until,
                        "time " + number_text(time) + ", min angle " +
                            number_text(series.log().back()["min_angle_deg"].get<double>()));
      }
      if (interrupted.load() && !run.done()) {
        if (!writes(run)) series.write_state(run, vtk_);
        console.error("cancelled at time " + number_text(run.surface().state().time) +
                      "; go on with --resume " + series.states().back().string());
        status = kCheckFailed;
      }
    } catch (...) {
      series.write_log();
      throw;
    }
    watch_.reset();
    if (status == kDone) tell(console, series);
    draw(console, series);
    return status;
  }

  void tell(Console& console, const MotionSeries& series) const {
    double volume = 0;
    double least = 180;
    for (const Json& entry : series.log()) {
      volume = std::max(volume, std::abs(entry["volume_change"].get<double>()));
      least = std::min(least, entry["min_angle_deg"].get<double>());
    }
    const Json& last = series.log().back();
    console.message("time " + number_text(last["time"].get<double>()) + " after " +
                    std::to_string(last["step"].get<std::size_t>()) + " steps: smallest angle " +
                    number_text(last["min_angle_deg"].get<double>()) + " deg (" + number_text(least) +
                    " on the way), mean of smallest " +
                    number_text(last["mean_min_angle_deg"].get<double>()) + " deg, largest volume change " +
                    number_text(100 * volume) + " %");
    if (last.contains("error")) {
      console.message("error against the exact motion " + number_text(last["error"]["max"].get<double>()) +
                      " at most, " + number_text(last["error"]["mean"].get<double>()) + " mean");
    }
    if (last.contains("exact")) {
      for (const auto& [key, text] : {std::pair("to_exact", "of the vertices from the dense copy"),
                                      std::pair("from_exact", "of the dense copy from the mesh")}) {
        console.message("distance " + std::string(text) + " " +
                        number_text(last["exact"][key]["max"].get<double>()) + " at most, " +
                        number_text(last["exact"][key]["rms"].get<double>()) + " RMS");
      }
    }
  }

  [[nodiscard]] MotionPictures pictures() const { return {camera_, 900, 760}; }

  void draw(Console& console, const MotionSeries& series) const {
    if (!pictures_ && figure_.empty()) return;
    const std::vector<std::filesystem::path> states = series.states();
    MotionPictures drawing = pictures();
    for (const std::filesystem::path& path : states) drawing.look_at(read_mesh(path).mesh);
    constexpr std::size_t kPanels = 6;
    std::vector<render::Image> panels;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < kPanels; ++i) {
      const std::size_t state = i * (states.size() - 1) / (kPanels - 1);
      if (chosen.empty() || chosen.back() != state) chosen.push_back(state);
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
      const bool panel = !figure_.empty() && std::ranges::find(chosen, i) != chosen.end();
      if (!pictures_ && !panel) continue;
      const MovingState state = read_state(states[i]);
      const render::Image image = drawing.draw(read_mesh(states[i]).mesh, "t = " + number_text(state.time));
      if (pictures_) render::write_png(std::filesystem::path(states[i]).replace_extension(".png"), image);
      if (panel) panels.push_back(image);
    }
    if (!figure_.empty()) {
      render::write_png(figure_, tile(panels, 3));
      console.message(figure_ + ": " + std::to_string(panels.size()) + " moments");
    }
  }

  std::string input_, output_, resume_, figure_, camera_ = "fit";
  MotionSpec motion_;
  std::optional<InterruptWatch> watch_;
  unsigned save_every_ = 0;   ///< 0: states are chosen by time
  double save_interval_ = 0;  ///< of time
  bool vtk_ = false, exact_ = false, pictures_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_advect_command() {
  return std::make_unique<AdvectCommand>();
}

}  // namespace isorelax::cli
