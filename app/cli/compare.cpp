#include <CLI/App.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/view_options.h"
#include "compare/mesh_case.h"
#include "compare/trace_case.h"
#include "io/atomic_file.h"
#include "mesh/error.h"
#include "trace/trace_file.h"

namespace isorelax::cli {
namespace {

using compare::Case;

Json number(double value) {
  if (!std::isfinite(value)) return {};
  const bool whole = value == std::floor(value) && std::abs(value) < 9e15;
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json case_to_json(const Case& one) {
  Json object;
  object["name"] = one.name;
  object["a"] = one.a;
  object["b"] = one.b;
  object["passes"] = one.passes();
  if (!one.failure.empty()) object["failure"] = one.failure;
  for (const compare::Figure& f : one.figures)
    object[f.key] = f.other ? Json{{"a", number(f.value)}, {"b", number(*f.other)}} : number(f.value);
  Json limits = Json::array();
  for (const compare::Verdict& v : one.verdicts)
    limits.push_back({{"name", v.name},
                      {"found", number(v.found)},
                      {v.at_least ? "at_least" : "at_most", number(v.limit)},
                      {"holds", v.holds}});
  object["limits"] = std::move(limits);
  object["notes"] = one.notes;
  return object;
}

std::string plain_text(const Case& one) {
  std::string text = one.name + ": " + (one.passes() ? "passes" : "fails") + "\n";
  if (!one.failure.empty()) text += "  " + one.failure + "\n";
  for (const compare::Verdict& v : one.verdicts)
    text += "  " + std::string(v.holds ? "holds   " : "BROKEN  ") + v.meaning + ": " +
            compare::number_text(v.found) + " (" + (v.at_least ? "at least " : "at most ") +
            compare::number_text(v.limit) + ", --" + v.name + ")\n";
  for (const compare::Figure& f : one.figures)
    text += "  " + f.label + ": " + compare::number_text(f.value) +
            (f.other ? " -> " + compare::number_text(*f.other) : "") + "\n";
  for (const std::string& note : one.notes) text += "  " + note + "\n";
  return text;
}

bool is_picture(const std::string& path) {
  return std::filesystem::path(path).extension() == ".png";
}

class CompareCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "compare"; }
  [[nodiscard]] std::string summary() const override {
    return "Tell whether two pictures, folders of pictures, meshes or recorded runs are the same";
  }
  [[nodiscard]] std::string notes() const override {
    return "Pictures (PNG) pass when every limit holds: a mean alone lets a missing label through, a "
           "largest\n"
           "difference alone fails on another computer's rounding. Pictures of different sizes are refused.\n"
           "  --tolerance      steps of 255 by which a channel may differ without being counted\n"
           "  --max-share      share of pixels with a channel beyond the tolerance: specks, moved lines\n"
           "  --max-difference largest difference of a channel; 255 allows any\n"
           "  --min-ssim       mean structural similarity (SSIM, 11 x 11 Gaussian windows): blur, noise\n"
           "  --min-tile-ssim  its mean in the worst tile of 16 x 16 pixels: something small that is "
           "missing\n"
           "  --max-flip       mean perceptual difference after FLIP, 0..1, for a screen of 67 pixels per "
           "degree:\n"
           "                   colours that are off all over\n"
           "  --max-flip-p99   its 99th percentile: what stands out\n"
           "Two folders: pictures are compared by name; one that only one folder has fails.\n"
           "\n"
           "Meshes with the same triangles: how far vertices moved (largest, RMS, which), how many moved, "
           "quality\n"
           "metric by metric, distance between the surfaces both ways. Other meshes: Hausdorff distance both "
           "ways.\n"
           "Lengths are relative to the first mesh's bounding-box diagonal. The drawing options are those of "
           "render\n"
           "and matter for the page only.\n"
           "\n"
           "Recorded runs (smooth --trace): what they were told differently, the first iteration and vertex "
           "at "
           "which they\n"
           "part, and how far apart they end, against --max-displacement. trace diff asks for the same "
           "bits.\n"
           "\n"
           "Exit status: 0 everything passes; 1 something does not; 2 it cannot be compared (other sizes); 3 "
           "a file\n"
           "cannot be read.\n"
           "\n"
           "Examples:\n"
           "  isorelax compare expected.png actual.png --report page.html\n"
           "  isorelax compare baselines/ pictures/ --junit results.xml --report page.html --min-tile-ssim "
           "0.9\n"
           "  isorelax compare before.off after.off --report page.html --color angle --json\n"
           "  isorelax compare scan.ply remeshed.off --max-deviation 0.001\n"
           "  isorelax compare first.trace second.trace --json";
  }
  void declare(CLI::App& app) override {
    app.add_option("A", a_, "Picture, folder, mesh or recorded run: what is expected")->required();
    app.add_option("B", b_, "Picture, folder, mesh or recorded run: what is there")->required();
    app.add_option("--report", page_, "Write one self-contained page with pictures and figures")
        ->type_name("FILE.html");
    app.add_flag("--json", json_, "Print the figures as JSON");
    app.add_option("--junit", junit_, "Write the results as JUnit XML")->type_name("FILE.xml");
    limit(app, "tolerance", image_tolerance_, "Uncounted difference of a channel, of 255 (default 6)");
    limit(app, "max-share", image_.share_beyond, "Share of pixels beyond the tolerance (default 0.0002)");
    limit(app, "max-difference", image_largest_, "Difference of a channel, of 255 (default 255)");
    limit(app, "min-ssim", image_.mean_ssim, "Least mean structural similarity (default 0.999)");
    limit(app, "min-tile-ssim", image_.worst_tile_ssim, "Least similarity of a tile (default 0.95)");
    limit(app, "max-flip", image_.flip_mean, "Mean perceptual difference (default 0.005)");
    limit(app, "max-flip-p99", image_.flip_p99,
          "99th percentile of the perceptual difference (default 0.05)");
    limit(app, "max-displacement", mesh_.displacement,
          "Meshes, runs: displacement of a vertex (default 1e-9)");
    limit(app, "max-deviation", mesh_.deviation, "Meshes: distance between the surfaces (default 1e-9)");
    app.add_option_function<std::vector<std::string>>(
           "--threshold",
           [this](const std::vector<std::string>& given) {
             for (const std::string& one : given) set_threshold(one);
           },
           "Any of these limits by its name")
        ->type_name("NAME=VALUE")
        ->expected(1)
        ->take_all();
    view_.declare(app);
    app.add_flag("--quiet", quiet_, "Print nothing but errors");
  }
  int run(Console& console) override {
    if (quiet_) console.set_verbosity(Verbosity::quiet);
    image_.tolerance = static_cast<int>(std::clamp(image_tolerance_, 0.0, 255.0));
    image_.largest = static_cast<int>(std::clamp(image_largest_, 0.0, 255.0));
    check_outputs({{{"--report", page_}, {"--junit", junit_}}}, {a_, b_});
    const std::vector<Case> cases = compare_files(console);
    if (!page_.empty()) write_file_atomically(page_, compare::html_page(a_ + " and " + b_, cases));
    if (!junit_.empty()) write_file_atomically(junit_, compare::junit_xml(cases));
    print(console, cases);
    return std::ranges::all_of(cases, &Case::passes) ? kDone : kCheckFailed;
  }

 private:
  void limit(CLI::App& app, const std::string& name, double& value, const std::string& help) {
    limits_.emplace_back(name, &value);
    app.add_option_function<double>(
           "--" + name, [this, name](double given) { set_limit(name, given); }, help)
        ->type_name("X");
  }

  void set_limit(const std::string& name, double value) {
    const bool least = name.starts_with("min-");
    if (std::isnan(value) || value < (least ? -1 : 0) || (least && value > 1))
      throw UsageError("--" + name + ": expected a number " + (least ? "from -1 to 1" : "of 0 or more"));
    for (const auto& [known, target] : limits_)
      if (known == name) {
        *target = value;
        return;
      }
    throw UsageError("--threshold " + name + ": is no limit; --help names them");
  }

  void set_threshold(const std::string& text) {
    const std::size_t equals = text.find('=');
    double value = 0;
    if (equals == std::string::npos || !CLI::detail::lexical_cast(text.substr(equals + 1), value))
      throw UsageError("--threshold " + text + ": expected NAME=VALUE, such as max-share=0.001");
    set_limit(text.substr(0, equals), value);
  }

  [[nodiscard]] std::vector<Case> compare_files(Console& console) const {
    const compare::Detail detail = page_.empty() ? compare::Detail::figures : compare::Detail::pictures;
    const bool folders[] = {std::filesystem::is_directory(a_), std::filesystem::is_directory(b_)};
    if (folders[0] != folders[1]) throw UsageError("a folder can only be compared with a folder");
    if (folders[0]) return compare::compare_folders(a_, b_, image_, detail);
    if (is_picture(a_) != is_picture(b_))
      throw UsageError((is_picture(a_) ? b_ : a_) +
                       ": is no PNG picture, named .png, and a picture can only be compared with one");
    if (is_picture(a_)) return {compare::compare_picture_files(a_, b_, image_, detail)};
    const bool runs[] = {is_trace(a_), is_trace(b_)};
    if (runs[0] != runs[1]) throw UsageError("a recorded run can only be compared with a recorded run");
    if (runs[0]) return {compare::compare_trace_files(a_, b_, mesh_.displacement)};
    const TriangleMesh mesh_a = read_input(console, a_);
    const TriangleMesh mesh_b = read_input(console, b_);
    const compare::NamedMesh a{a_, &mesh_a};
    const compare::NamedMesh b{b_, &mesh_b};
    Case result = compare::compare_meshes(a, b, mesh_);
    if (detail == compare::Detail::pictures)
      compare::add_pictures(a, b, {view_.read(), view_.context()}, result);
    return {std::move(result)};
  }

  void print(Console& console, const std::vector<Case>& cases) const {
    if (json_) {
      Json document = Json::array();
      for (const Case& one : cases) document.push_back(case_to_json(one));
      const bool folders = std::filesystem::is_directory(a_);
      console.result(json_text(folders ? Json{{"comparisons", std::move(document)}} : document[0]));
      return;
    }
    if (quiet_) return;
    for (const Case& one : cases) console.result(plain_text(one));
  }

  std::string a_, b_, page_, junit_;
  std::vector<std::pair<std::string, double*>> limits_;
  double image_tolerance_ = compare::ImageLimits().tolerance;
  double image_largest_ = compare::ImageLimits().largest;
  compare::ImageLimits image_;
  compare::MeshLimits mesh_;
  ViewOptions view_;
  bool json_ = false;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_compare_command() {
  return std::make_unique<CompareCommand>();
}

}  // namespace isorelax::cli
