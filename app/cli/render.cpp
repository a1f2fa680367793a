#include "render/picture.h"

#include <CLI/App.hpp>
#include <filesystem>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/problem_options.h"
#include "mesh/error.h"
#include "quality/triangle_metrics.h"
#include "render/image.h"
#include "smoothing/run.h"

namespace isorelax::cli {
namespace {

/// E of every triangle against equilateral references of mean area, weights (1, 1): what `--color energy`
/// shows.
std::vector<double> face_energies(const TriangleMesh& mesh) {
  const ReferenceMesh reference = ReferenceMesh::equilateral_mean_area(mesh.positions, mesh.triangles);
  std::vector<double> energies;
  energies.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[t];
    energies.push_back(evaluate_energy({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]},
                                       reference[t], {1, 1})
                           .energy);
  }
  return energies;
}

struct Coloured {
  render::Quantity quantity;
  std::vector<double> values;
};

std::optional<Coloured> colour_faces(const std::string& color, const TriangleMesh& mesh) {
  using render::Quantity;
  const auto metric = [&](FaceMetric m) { return face_metric(m, mesh.positions, mesh.triangles); };
  if (color == "angle") return Coloured{Quantity::min_angle, metric(FaceMetric::min_angle)};
  if (color == "max-angle") return Coloured{Quantity::max_angle, metric(FaceMetric::max_angle)};
  if (color == "area") return Coloured{Quantity::area, metric(FaceMetric::relative_area)};
  if (color == "energy") return Coloured{Quantity::energy, face_energies(mesh)};
  if (color == "none") return std::nullopt;
  throw UsageError("--color " + color + ": expected angle, max-angle, area, energy or none");
}

class RenderCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "render"; }
  [[nodiscard]] std::string summary() const override { return "Draw a picture of a mesh, without a display"; }
  [[nodiscard]] std::string notes() const override {
    return "Camera: fit, front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION[,ZOOM] in degrees. "
           "Planar\n"
           "meshes are seen from above, others from the front right. The same options give the same picture, "
           "byte\n"
           "for byte. --color area is relative to the mean area, --color energy is K + S against "
           "equilateral\n"
           "triangles of the mean area.\n"
           "\n"
           "Examples:\n"
           "  isorelax render part.off -o part.png --wire\n"
           "  isorelax render part.off -o area.png --color area --size 1920x1080 --camera top --range 0.5:2";
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "Mesh: OFF, OBJ, PLY or STL")->required();
    app.add_option("-o,--output", output_, "PNG to write")->required()->type_name("PNG");
    app.add_option("--size", size_, "Picture size in pixels (default 1280x720)")->type_name("WxH");
    app.add_option("--color", color_, "angle (smallest, default), max-angle, area, energy or none")
        ->type_name("C");
    app.add_option("--range", range_, "Values at the ends of the colour map")->type_name("LO:HI");
    app.add_option("--colormap", map_, "viridis, cividis, inferno, magma or blue-orange")->type_name("MAP");
    app.add_flag("--reverse", options_.reversed, "Turn the colour map round");
    app.add_option("--camera", options_.camera, "Where from (default fit)")->type_name("SPEC");
    app.add_option("--shading", shading_, "flat (default) or smooth")->type_name("S");
    app.add_flag("--wire", options_.wire, "Draw the edges");
    app.add_option("--legend", legend_, "on (default) or off")->type_name("on|off");
    app.add_option("--background", background_, "dark (default), light, white, black, #rrggbb or r,g,b")
        ->type_name("B");
    app.add_option("--context", context_, "osmesa (default) or egl")->type_name("C");
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    read_options();
    if (std::filesystem::path(output_).extension() != ".png")
      throw UsageError(output_ + ": pictures are PNG files, named .png");
    const TriangleMesh mesh = read_input(console, file_);
    const auto colours = colour_faces(color_, mesh);
    std::optional<render::FaceColors> faces;
    if (colours) faces = render::FaceColors{colours->quantity, colours->values};
    render::write_png(output_, render::render_picture(mesh, faces, options_));
    console.message(output_ + ": " + size_ + " pixels");
    return kDone;
  }

 private:
  void read_options() {
    options_.size = render::parse_size(size_);
    if (!range_.empty()) options_.range = render::parse_range(range_);
    if (!map_.empty()) options_.color_map = render::parse_color_map(map_);
    if (shading_ != "flat" && shading_ != "smooth")
      throw UsageError("--shading " + shading_ + ": expected flat or smooth");
    options_.shading = shading_ == "smooth" ? render::Shading::smooth : render::Shading::flat;
    if (legend_ != "on" && legend_ != "off") throw UsageError("--legend " + legend_ + ": expected on or off");
    options_.legend = legend_ == "on";
    options_.background = render::parse_background(background_);
    options_.context = render::parse_context_kind(context_);
  }

  std::string file_, output_;
  std::string size_ = "1280x720", color_ = "angle", range_, map_, shading_ = "flat", legend_ = "on";
  std::string background_ = "dark", context_ = "osmesa";
  render::PictureOptions options_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_render_command() {
  return std::make_unique<RenderCommand>();
}

}  // namespace isorelax::cli
