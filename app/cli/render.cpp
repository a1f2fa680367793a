#include <CLI/App.hpp>
#include <filesystem>
#include <optional>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/view_options.h"
#include "io/atomic_file.h"
#include "mesh/error.h"
#include "view/picture.h"

namespace isorelax::cli {
namespace {

/// A file that a view names, from here or from the folder of the view's own file.
std::string find_file(const std::string& name, const std::string& view_file) {
  std::error_code ignored;
  const std::filesystem::path beside = std::filesystem::path(view_file).parent_path() / name;
  const bool here = std::filesystem::exists(name, ignored);
  return !here && std::filesystem::exists(beside, ignored) ? beside.string() : name;
}

/// The names of given files, in the view's own words where they are the same files: the same view stays the
/// same text.
std::vector<std::string> named_like(const std::vector<std::string>& given,
                                    const std::vector<std::string>& known) {
  std::vector<std::string> names = given;
  std::error_code ignored;
  for (std::size_t i = 0; i < names.size() && i < known.size(); ++i)
    if (std::filesystem::equivalent(names[i], known[i], ignored)) names[i] = known[i];
  return names;
}

class RenderCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "render"; }
  [[nodiscard]] std::string summary() const override { return "Draw a picture of meshes, without a display"; }
  [[nodiscard]] std::string notes() const override {
    return "Several meshes stand side by side, with one camera and one range of colours.\n"
           "\n"
           "Camera: fit, front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION[,ZOOM] in degrees, "
           "then\n"
           "options behind colons: perspective, orthographic, y-up, z-up, zoom=FACTOR. Planar meshes are "
           "seen from\n"
           "above, others from the front right. --color area is relative to the mean area, --color energy is "
           "K + S\n"
           "against equilateral triangles of the mean area; values outside the range are grey.\n"
           "\n"
           "The same options give the same picture, byte for byte, and every picture carries the view that "
           "made it:\n"
           "--like PICTURE.png draws it again, of the same mesh or of another. --save-view writes that view "
           "as JSON\n"
           "for --camera; what stands beside either option changes the view. Where no mesh is given, the "
           "view's own\n"
           "are drawn.\n"
           "\n"
           "Examples:\n"
           "  isorelax render part.off -o part.png --wire\n"
           "  isorelax render before.off after.off -o both.png --size 1920x1080 --camera iso --numbers\n"
           "  isorelax render after.off -o change.png --against before.off --difference --arrows\n"
           "  isorelax render other.off -o other.png --like part.png --color area --range 0.5:2";
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "Meshes: " + format_names());
    app.add_option("-o,--output", output_, "PNG to write")->required()->type_name("PNG");
    options_.declare(app);
    app.add_option("--save-view", view_file_, "Write the view here, to be read by --camera")
        ->type_name("FILE.json");
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    view::View view = options_.read();
    render::require_png_name(output_);
    if (!files_.empty()) view.meshes = named_like(files_, view.meshes);
    if (view.meshes.empty()) throw UsageError("there is no mesh to draw: give its file");
    const std::vector<std::string> files = mesh_files(view);
    std::vector<std::string> read = files;
    if (!view.against.empty()) read.push_back(find_file(view.against, options_.source()));
    check_outputs({{{"--output", output_}, {"--save-view", view_file_}}}, read);
    std::vector<TriangleMesh> meshes;
    meshes.reserve(files.size());
    for (const std::string& file : files) meshes.push_back(read_input(console, file));
    std::optional<TriangleMesh> against;
    if (!view.against.empty()) against = read_input(console, find_file(view.against, options_.source()));
    view::Exhibits exhibits;
    for (const TriangleMesh& mesh : meshes) exhibits.meshes.push_back(&mesh);
    if (against) exhibits.against = &*against;
    view::Studio studio(options_.context());
    const view::Picture picture = studio.draw(view, exhibits);
    view::write_picture(output_, picture);
    if (!view_file_.empty()) write_file_atomically(view_file_, view::to_json(picture.view));
    console.message(output_ + ": " + std::to_string(picture.image.width) + "x" +
                    std::to_string(picture.image.height) + " pixels");
    return kDone;
  }

 private:
  [[nodiscard]] std::vector<std::string> mesh_files(const view::View& view) const {
    if (!files_.empty()) return files_;
    std::vector<std::string> files;
    for (const std::string& name : view.meshes) files.push_back(find_file(name, options_.source()));
    return files;
  }

  std::vector<std::string> files_;
  std::string output_, view_file_;
  ViewOptions options_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_render_command() {
  return std::make_unique<RenderCommand>();
}

}  // namespace isorelax::cli
