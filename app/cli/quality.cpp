#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/mesh_input.h"
#include "cli/problem_options.h"
#include "cli/table.h"
#include "mesh/error.h"
#include "quality/distribution.h"
#include "quality/triangle_metrics.h"

namespace isorelax::cli {
namespace {

std::string percent_text(double share) {
  return number_text(100 * share) + " %";
}

/// The two terms of the energy against reference triangles, over all triangles; infinite where one has no
/// area.
struct ReferenceReport {
  double shape_mean = 0;
  double shape_max = 0;
  double size_mean = 0;
  double size_max = 0;
};

ReferenceReport measure_against(const ReferenceMesh& reference, const TriangleMesh& mesh) {
  ReferenceReport report;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const std::array<Vec3, 3> x = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
    TriangleEnergy energy;
    energy.shape = energy.area = std::numeric_limits<double>::infinity();
    if (area_vector(x[0], x[1], x[2]).norm() > 0) energy = evaluate_energy(x, reference[t], {1, 1});
    report.shape_mean += energy.shape;
    report.shape_max = std::max(report.shape_max, energy.shape);
    report.size_mean += energy.area;
    report.size_max = std::max(report.size_max, energy.area);
  }
  report.shape_mean /= mesh.triangle_count();
  report.size_mean /= mesh.triangle_count();
  return report;
}

std::string report_text(const QualityReport& report, const std::optional<ReferenceReport>& against) {
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
  if (against) {
    table.row("mean size (2 is best)", number_text(against->size_mean));
    table.row("worst size", number_text(against->size_max));
  }
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
    const TriangleMetrics m = measure_triangle(mesh.positions, mesh.triangles[t]);
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
           "--reference R gives shape by the angles of other triangles (\"initial\" is the mesh itself) and "
           "adds\n"
           "  size             sqrt(A/B) + sqrt(B/A) with the reference's area B      [size_mean, size_max]\n"
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
           "                   normal of the triangles that touch it; or part of a patch, bounded by turns "
           "of\n"
           "                   more than 120 degrees, that is folded over as a whole. Degenerate triangles\n"
           "                   are not counted.\n\n"
           "Examples:\n  isorelax quality bunny.off --json --worst 5\n"
           "  isorelax quality smoothed.off --reference original.off";
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "Mesh: " + format_names())->required();
    app.add_flag("--json", json_, "Print one JSON object");
    app.add_option("--worst", worst_,
                   "List the N triangles with the smallest angles (\"worst\" in the object)")
        ->check(whole_number(0))
        ->type_name("N");
    app.add_option(
           "--reference", reference_,
           "Measure shape against, and size too: equilateral, equilateral:EDGE, initial, or a mesh FILE")
        ->type_name("R");
  }
  int run(Console& console) override {
    const TriangleMesh mesh = read_input(console, file_);
    if (mesh.triangles.empty()) throw MeshError(file_ + ": has no triangles to measure");
    QualityReport report = measure_quality(mesh);
    std::optional<ReferenceReport> against;
    if (!reference_.empty()) {
      const ReferenceChoice choice = parse_reference(console, reference_, mesh);
      try {
        against = measure_against(make_reference(choice, mesh.positions, mesh.triangles), mesh);
      } catch (const MeshError& error) {  // gets the name of its file
        throw MeshError(file_ + ": " + error.what());
      }
      report.shape_mean = against->shape_mean;
      report.shape_max = against->shape_max;
    }
    std::vector<Index> worst;
    if (worst_ > 0) {
      const auto angles = face_metric(FaceMetric::min_angle, mesh.positions, mesh.triangles);
      worst = worst_elements(angles, worst_, WorstEnd::smallest);
    }
    console.result(json_ ? json_text(object(mesh, report, worst, against))
                         : report_text(report, against) + (worst.empty() ? "" : worst_text(mesh, worst)));
    return kDone;
  }

 private:
  [[nodiscard]] Json object(const TriangleMesh& mesh, const QualityReport& report,
                            const std::vector<Index>& worst,
                            const std::optional<ReferenceReport>& against) const {
    Json object = to_json(report);
    if (against) {
      object["reference"] = reference_;
      object["size_mean"] = against->size_mean;
      object["size_max"] = against->size_max;
    }
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
  std::string reference_;
};

}  // namespace

std::unique_ptr<Command> make_quality_command() {
  return std::make_unique<QualityCommand>();
}

}  // namespace isorelax::cli
