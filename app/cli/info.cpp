#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/json.h"
#include "cli/mesh_input.h"
#include "cli/table.h"
#include "mesh/topology.h"
#include "mesh/validation.h"
#include "quality/inverted.h"
#include "surface/crossings.h"
#include "surface/deviation.h"

namespace isorelax::cli {
namespace {

constexpr std::size_t kListed = 10;

/// The first ids of a list, each by `text`, and how many more there are.
template <class Item>
std::string listed(const std::vector<Item>& items, const std::function<std::string(const Item&)>& text) {
  std::string line = std::to_string(items.size());
  for (std::size_t i = 0; i < std::min(items.size(), kListed); ++i)
    line += (i == 0 ? ": " : ", ") + text(items[i]);
  if (items.size() > kListed) line += " and " + std::to_string(items.size() - kListed) + " more";
  return line;
}

std::string edge_text(const EdgeFinding& edge) {
  std::string text = std::to_string(edge.a) + "-" + std::to_string(edge.b) + " (triangles";
  for (const Index t : edge.triangles) text += " " + std::to_string(t);
  return text + ")";
}

std::string id_text(const Index& id) {
  return std::to_string(id);
}

std::string loop_text(const BoundaryLoop& loop) {
  const std::size_t edges = loop.vertices.size() - (loop.closed ? 0 : 1);
  return std::to_string(edges) + (loop.closed ? " edges" : " edges (open)") + " from vertex " +
         std::to_string(loop.vertices.front());
}

std::string component_text(const ComponentFinding& component) {
  return std::to_string(component.triangles) + " triangles";
}

std::string degenerate_text(const DegenerateFinding& finding) {
  return std::to_string(finding.triangle) +
         (finding.reason == DegenerateReason::zero_area ? " (zero area)" : " (repeated vertex)");
}

std::string pair_text(const std::array<Index, 2>& pair) {
  return std::to_string(pair[0]) + "-" + std::to_string(pair[1]);
}

std::string duplicate_text(const DuplicateFinding& finding) {
  return std::to_string(finding.triangle) + " (same as " + std::to_string(finding.first) + ")";
}

std::string orientation_text(const ValidationReport& report) {
  if (report.oriented) return "consistent";
  return report.orientable ? "inconsistent, can be made consistent"
                           : "inconsistent, the surface has one side";
}

/// What is found beside the flaws of the connectivity.
struct Sides {
  bool inward = false;
  bool flat = false;  ///< in one plane: it has no outside
  std::vector<Index> inverted;
  std::vector<std::array<Index, 2>> crossing;
};

Sides sides_of(const TriangleMesh& mesh) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  return {faces_inward(mesh.positions, mesh.triangles),
          plane_normal(mesh.positions, mesh.triangles, topology).has_value(),
          inverted_triangles(mesh.positions, mesh.triangles, topology),
          crossing_pairs({mesh.positions, mesh.triangles}, mesh.positions, mesh.triangles)};
}

std::string facing_text(const ValidationReport& report, bool inward) {
  if (inward) return "inward: the triangles show their backs to the outside";
  return report.closed && report.oriented ? "outward" : "not inward";
}

std::string report_text(const ValidationReport& report, const Sides& sides) {
  Table table;
  table.row("vertices", std::to_string(report.vertices));
  table.row("triangles", std::to_string(report.triangles));
  table.row("edges", std::to_string(report.edges));
  table.row("components", listed<ComponentFinding>(report.components, component_text));
  table.row("boundary loops", listed<BoundaryLoop>(report.boundary, loop_text));
  table.row("Euler characteristic", std::to_string(report.euler_characteristic));
  table.row("genus", report.genus ? std::to_string(*report.genus) : "undefined");
  table.row("closed", report.closed ? "yes" : "no");
  table.row("manifold", report.manifold() ? "yes" : "no");
  table.row("orientation", orientation_text(report));
  if (!sides.flat) table.row("facing", facing_text(report, sides.inward));
  table.row("non-manifold edges", listed<EdgeFinding>(report.non_manifold_edges, edge_text));
  table.row("non-manifold vertices", listed<Index>(report.non_manifold_vertices, id_text));
  table.row("inconsistent edges", listed<EdgeFinding>(report.inconsistent_edges, edge_text));
  table.row("inverted triangles", listed<Index>(sides.inverted, id_text));
  table.row("crossing triangles", listed<std::array<Index, 2>>(sides.crossing, pair_text));
  table.row("degenerate triangles", listed<DegenerateFinding>(report.degenerate, degenerate_text));
  table.row("duplicate triangles", listed<DuplicateFinding>(report.duplicates, duplicate_text));
  table.row("isolated vertices", listed<Index>(report.isolated_vertices, id_text));
  return table.text();
}

class InfoCommand : public Command {
 public:
  [[nodiscard]] std::string name() const override { return "info"; }
  [[nodiscard]] std::string summary() const override {
    return "Tell what a mesh consists of and name every flaw in it";
  }
  [[nodiscard]] std::string notes() const override {
    return "Vertices and triangles are numbered from 0 in file order. The text lists the first ten of each\n"
           "kind of flaw, --json all of them.\n"
           "  components            triangles that hang together by edges\n"
           "  boundary loops        chains of edges with one triangle; open: cut off by a non-manifold edge\n"
           "  genus                 handles; undefined where a part is non-manifold or has one side\n"
           "  facing                outward or inward, by the sign of the enclosed volume; inward, too, "
           "where\n"
           "                        holes of less than a quarter of the area are all that opens the mesh;\n"
           "                        not of a mesh in one plane\n"
           "  non-manifold edges    three or more triangles meet\n"
           "  non-manifold vertices on such an edge, or several fans of triangles meet\n"
           "  inconsistent edges    their two triangles run along them in the same direction\n"
           "  inverted triangles    upside down in a plane, or folded over on their surroundings\n"
           "  crossing triangles    pairs: an edge of one passes through the inside of the other\n"
           "  degenerate triangles  a vertex twice, or area <= 1e-14 of the squared longest edge\n\n"
           "Example:\n  isorelax info bunny.off --json";
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "Mesh: " + format_names())->required();
    app.add_flag("--json", json_, "Print one JSON object");
  }
  int run(Console& console) override {
    const TriangleMesh mesh = read_input(console, file_);
    const ValidationReport report = validate(mesh);
    const Sides sides = sides_of(mesh);
    if (json_) {
      Json object = to_json(report);
      object["faces_inward"] = sides.inward;
      object["inverted_triangles"] = sides.inverted;
      object["crossing_triangles"] = sides.crossing;
      console.result(json_text(object));
    } else {
      console.result(report_text(report, sides));
    }
    return kDone;
  }

 private:
  std::string file_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_info_command() {
  return std::make_unique<InfoCommand>();
}

}  // namespace isorelax::cli
