#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/mesh_input.h"
#include "cli/table.h"
#include "mesh/error.h"
#include "quality/distribution.h"
#include "quality/triangle_metrics.h"

namespace isorelax::cli {
namespace {

std::string percent_text(double share) {
  return number_text(100 * share) + " %";
}

std::string report_text(const QualityReport& report) {
  Table table;
  table.row("vertices", std::to_string(report.vertices));
  table.row("triangles", std::to_string(report.triangles));
  table.row("smallest angle", number_text(report.min_angle_deg) + " deg");
  table.row("largest angle", number_text(report.max_angle_deg) + " deg");
  table.row("mean of smallest angles", number_text(report.mean_min_angle_deg) + " deg");
  table.row("triangles below 20 deg", percent_text(report.below_20_deg));
  table.row("triangles below 30 deg", percent_text(report.below_30_deg));
  table.row("triangles above 120 deg", percent_text(report.above_120_deg));
  table.row("largest over smallest area", number_text(report.area_max_over_min));
  table.row("area deviation over mean", number_text(report.area_std_over_mean));
  table.row("mean shape (2 is best)", number_text(report.shape_mean));
  table.row("worst shape", number_text(report.shape_max));
  table.row("worst radius ratio (1 is best)", number_text(report.radius_ratio_min));
  table.row("worst scaled Jacobian (1 is best)", number_text(report.scaled_jacobian_min));
  table.row("worst aspect ratio (1 is best)", number_text(report.aspect_ratio_max));
  table.row("inverted triangles", std::to_string(report.inverted));
  table.row("degenerate triangles", std::to_string(report.degenerate));
  return table.text();
}

std::string worst_text(const TriangleMesh& mesh, const std::vector<Index>& worst) {
  std::string text = "\nworst triangles by smallest angle\n";
  for (const Index t : worst) {
    const auto [a, b, c] = mesh.triangles[t];
    const Vec3 middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
    const TriangleMetrics m = measure_triangle(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    text += "  triangle " + std::to_string(t) + "  vertices " + std::to_string(a) + " " + std::to_string(b) +
            " " + std::to_string(c) + "  angles " + number_text(m.min_angle_deg) + " to " +
            number_text(m.max_angle_deg) + " deg  at " + number_text(middle.x()) + " " +
            number_text(middle.y()) + " " + number_text(middle.z()) + "\n";
  }
  return text;
}

class QualityCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "quality"; }
  [[nodiscard]] std::string summary() const override { return "Measure the triangles of a mesh"; }
  [[nodiscard]] std::string notes() const override {
    return "With edges l0 l1 l2, area A, circumradius R and inradius r of a triangle (--json keys in "
           "brackets):\n"
           "  shape            (l0^2+l1^2+l2^2) / (2 sqrt(3) A), 2 when equilateral   [shape_mean, "
           "shape_max]\n"
           "  radius ratio     2 r / R, 1 when equilateral, 0 when flat               [radius_ratio_min]\n"
           "  scaled Jacobian  2/sqrt(3) times the sine of the smallest angle         [scaled_jacobian_min]\n"
           "  aspect ratio     l_max (l0+l1+l2) / (4 sqrt(3) A)                       [aspect_ratio_max]\n"
           "Shares (below_20_deg, below_30_deg by the smallest angle, above_120_deg by the largest) run from "
           "0\n"
           "to 1; area_std_over_mean is the population's standard deviation.\n"
           "  degenerate       A <= 1e-14 l_max^2. Without any area: angles 0 and 180, shape and aspect\n"
           "                   ratio infinite. JSON has no infinity: null stands for it.\n"
           "  inverted         in a plane: the signed area has the other sign than the whole mesh. "
           "Elsewhere:\n"
           "                   folded over, that is the surface turns by more than 150 degrees at two edges "
           "or\n"
           "                   more (at the only shared one, if it is one) and the normal opposes the mean\n"
           "                   normal of the triangles that touch it. Degenerate triangles are not "
           "counted.\n\n"
           "Example:\n  isorelax quality bunny.off --json --worst 5";
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "Mesh: OFF, OBJ, PLY or STL")->required();
    app.add_flag("--json", json_, "Print one JSON object");
    app.add_option("--worst", worst_,
                   "List the N triangles with the smallest angles (\"worst\" in the object)")
        ->check(whole_number(0))
        ->type_name("N");
  }
  int run(Console& console) override {
    const TriangleMesh mesh = read_input(console, file_);
    if (mesh.triangles.empty()) throw MeshError(file_ + ": has no triangles to measure");
    const QualityReport report = measure_quality(mesh);
    std::vector<Index> worst;
    if (worst_ > 0) {
      const auto angles = face_metric(FaceMetric::min_angle, mesh.positions, mesh.triangles);
      worst = worst_elements(angles, worst_, WorstEnd::smallest);
    }
    console.result(json_ ? json_text(object(mesh, report, worst))
                         : report_text(report) + (worst.empty() ? "" : worst_text(mesh, worst)));
    return kDone;
  }

 private:
  [[nodiscard]] Json object(const TriangleMesh& mesh, const QualityReport& report,
                            const std::vector<Index>& worst) const {
    Json object = to_json(report);
    if (worst_ > 0) {
      Json list = Json::array();
      for (const Index t : worst) list.push_back(triangle_to_json(mesh, t));
      object["worst"] = std::move(list);
    }
    return object;
  }

  std::string file_;
  bool json_ = false;
  std::size_t worst_ = 0;
};

}  // namespace

std::unique_ptr<Command> make_quality_command() {
  return std::make_unique<QualityCommand>();
}

}  // namespace isorelax::cli
