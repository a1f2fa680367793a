#include "generate/generate.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax::cli {
namespace {

std::string kinds_text() {
  std::string text = "Kinds:\n";
  for (const ShapeInfo& info : shape_kinds()) {
    text += "  " + std::string(info.name) + std::string(15 - info.name.size(), ' ') +
            std::string(info.description) + "\n";
  }
  return text;
}

ShapeKind kind_by_name(const std::string& name) {
  std::string known;
  for (const ShapeInfo& info : shape_kinds()) {
    if (info.name == name) return info.kind;
    known += (known.empty() ? "" : ", ") + std::string(info.name);
  }
  throw UsageError(name + ": no such kind of mesh; there are " + known);
}

class GenerateCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "generate"; }
  [[nodiscard]] std::string summary() const override { return "Make a test mesh from a seed"; }
  [[nodiscard]] std::string notes() const override {
    return kinds_text() +
           "\nThe same options make the same mesh everywhere. Random squares and spheres have exactly the "
           "size\n"
           "asked for, the other kinds come close, but a torus and a cylinder have at least 24 triangles, a\n"
           "cube and a cone 12, a part 188. Closed kinds are watertight and face outward.\n"
           "--jitter moves vertices at random along their surface, by up to that share of an edge; what "
           "would\n"
           "squeeze a triangle under 8 degrees is cut back. The default is 0.45 for hexagonal and part, else "
           "0.\n\n"
           "Examples:\n"
           "  isorelax generate random --triangles 2126 --seed 7 -o square.off\n"
           "  isorelax generate random --triangles 2000 --tangle 0.2 -o tangled.off\n"
           "  isorelax generate hexagonal --triangles 11704 -o hexagons.off\n"
           "  isorelax generate sphere --vertices 5832 -o sphere.ply\n"
           "  isorelax generate random-sphere --vertices 5832 -o sphere.obj\n"
           "  isorelax generate torus --triangles 4000 --jitter 0.4 -o torus.off\n"
           "  isorelax generate cube --triangles 1200 --jitter 0.3 -o cube.stl\n"
           "  isorelax generate cylinder -o cylinder.off\n"
           "  isorelax generate cone -o cone.off\n"
           "  isorelax generate part --triangles 10000 --seed 3 -o part.off";
  }
  void declare(CLI::App& app) override {
    app.add_option("KIND", kind_, "What to make, see below")->required();
    app.add_option("-o,--output", output_, "File to write: " + format_names() + " by its extension")
        ->required()
        ->type_name("FILE");
    app.add_option("--seed", options_.seed, "Number that all randomness follows from (default 1)")
        ->check(whole_number(0))
        ->type_name("S");
    auto* vertices =
        app.add_option("--vertices", vertices_, "Number of vertices")->check(whole_number(1))->type_name("N");
    auto* triangles = app.add_option("--triangles", triangles_, "Number of triangles (default 2000)")
                          ->check(whole_number(1))
                          ->type_name("N");
    vertices->excludes(triangles);
    app.add_option("--jitter", jitter_, "Largest random move, in edge lengths, 0 to 1")->type_name("J");
    app.add_option("--tangle", options_.tangle,
                   "Share of a square's inner vertices that are thrown anywhere inside, 0 to 1 (default 0)")
        ->type_name("SHARE");
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
    app_ = &app;
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    if (app_->count("--vertices") > 0) options_.vertices = vertices_;
    if (app_->count("--triangles") > 0) options_.triangles = triangles_;
    if (app_->count("--jitter") > 0) options_.jitter = jitter_;
    const TriangleMesh mesh = generate(kind_by_name(kind_), options_);
    for (const std::string& message : write_mesh(output_, mesh)) console.message(output_ + ": " + message);
    console.message(output_ + ": " + std::to_string(mesh.vertex_count()) + " vertices, " +
                    std::to_string(mesh.triangle_count()) + " triangles");
    return kDone;
  }

 private:
  CLI::App* app_ = nullptr;
  std::string kind_;
  std::string output_;
  GenerateOptions options_;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
  double jitter_ = 0;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_generate_command() {
  return std::make_unique<GenerateCommand>();
}

}  // namespace isorelax::cli
