#include "trace/trace_export.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>

#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "io/text_out.h"
#include "mesh/error.h"
#include "quality/triangle_metrics.h"
#include "trace/trace_file.h"

namespace isorelax {
namespace {

using Json = nlohmann::ordered_json;

void append(std::string& text, double value) {
  append_number(text, value);
}
void append(std::string& text, StepKind kind) {
  text += step_kind_name(kind);
}
void append(std::string& text, std::size_t value) {
  append_integer(text, value);
}

std::string numbered(std::size_t iteration, const std::string& extension) {
  return "iteration_" + zero_padded(iteration, 5) + extension;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string(), "cannot be made: " + error.message());
}

class VtkPolyData {
 public:
  explicit VtkPolyData(const Trace& trace) : trace_(trace) {}

  std::string text(std::span<const Vec3> positions) {
    text_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "<PolyData><Piece NumberOfPoints=\"" +
        std::to_string(positions.size()) +
        "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"" +
        std::to_string(trace_.triangles.size()) + "\">\n<Points>\n";
    array("Float64", "Points", 3);
    for (const Vec3& p : positions) vector(p);
    close();
    text_ += "</Points>\n<Polys>\n";
    array("Int64", "connectivity", 1);
    for (const Triangle& t : trace_.triangles)
      for (const Index v : t) item(std::size_t{v});
    close();
    array("Int64", "offsets", 1);
    for (std::size_t t = 1; t <= trace_.triangles.size(); ++t) item(3 * t);
    close();
    text_ += "</Polys>\n<PointData Vectors=\"displacement\">\n";
    array("Float64", "displacement", 3);
    for (std::size_t v = 0; v < positions.size(); ++v) vector(positions[v] - trace_.positions[v]);
    close();
    text_ += "</PointData>\n<CellData Scalars=\"min_angle_deg\">\n";
    add_metric(positions, "min_angle_deg", &TriangleMetrics::min_angle_deg);
    add_metric(positions, "max_angle_deg", &TriangleMetrics::max_angle_deg);
    add_metric(positions, "area", &TriangleMetrics::area);
    text_ += "</CellData>\n</Piece></PolyData>\n</VTKFile>\n";
    return std::move(text_);
  }

 private:
  void array(const char* type, const char* name, int components) {
    text_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
             std::to_string(components) + "\" format=\"ascii\">\n";
  }
  void close() { text_ += "</DataArray>\n"; }
  template <typename Number>
  void item(Number value) {
    append(text_, value);
    text_ += '\n';
  }
  void vector(const Vec3& p) {
    append_point(text_, p);
    text_ += '\n';
  }
  void add_metric(std::span<const Vec3> x, const char* name, double TriangleMetrics::*member) {
    array("Float64", name, 1);
    for (const Triangle& t : trace_.triangles) item(measure_triangle(x, t).*member);
    close();
  }

  const Trace& trace_;
  std::string text_;
};

/// Whether the start has a number of this name: no step led to it.
bool is_of_a_mesh(std::string_view name, const Trace& trace) {
  constexpr std::array<std::string_view, 4> kQuality{"min_angle_deg", "max_angle_deg", "mean_min_angle_deg",
                                                     "inverted"};
  constexpr std::array<std::string_view, 4> kEnergy{"energy", "shape", "area", "worst_energy"};
  return std::ranges::find(kQuality, name) != kQuality.end() ||
         (!trace.iterations.empty() && std::ranges::find(kEnergy, name) != kEnergy.end());
}

}  // namespace

std::string trace_csv(const Trace& trace) {
  std::string text = "iteration";
  const TraceIteration none;
  visit_numbers(none, [&](std::string_view name, const auto&) { text.append(",").append(name); });
  text += '\n';
  TraceIteration start;
  start.quality = trace.quality;
  if (!trace.iterations.empty()) start.after = trace.iterations.front().before;
  for (std::size_t k = 0; k <= trace.iterations.size(); ++k) {
    text += std::to_string(k);
    visit_numbers(k == 0 ? start : trace.iterations[k - 1], [&](std::string_view name, const auto& value) {
      text += ',';
      if (k > 0 || is_of_a_mesh(name, trace)) append(text, value);
    });
    text += '\n';
  }
  return text;
}

namespace {

Json part_json(const TracePart& part) {
  Json json;
  json["first_iteration"] = part.done + 1;
  json["kind"] = part.kind == PartKind::polish ? "polish" : "solver";
  json["exponent"] = part.exponent;
  json["untangled_first"] = part.from_base;
  json["held"] = part.holds.still;
  json["kept_within"] = part.holds.distance;
  json["on_fits"] = part.holds.on_fits;
  json["apart"] = part.holds.apart;
  if (part.words) json["arguments"] = part.words->arguments;
  return json;
}

}  // namespace

std::string trace_json(const Trace& trace) {
  Json json;
  json["program"] = trace.program;
  json["input"] = trace.input;
  json["arguments"] = trace.arguments;
  json["vertices"] = trace.positions.size();
  json["triangles"] = trace.triangles.size();
  json["stopped"] = trace.stopped;
  json["stopped_because"] = trace.stopped_because;
  json["parts"] = Json::array();
  for (const TracePart& part : trace.parts) json["parts"].push_back(part_json(part));
  Json iterations = Json::array();
  for (std::size_t k = 1; k <= trace.iterations.size(); ++k) {
    Json one{{"iteration", k}};
    visit_numbers(trace.iterations[k - 1], [&](std::string_view name, const auto& value) {
      if constexpr (std::is_same_v<decltype(value), const StepKind&>)
        one[std::string(name)] = step_kind_name(value);
      else
        one[std::string(name)] = value;
    });
    iterations.push_back(std::move(one));
  }
  json["iterations"] = std::move(iterations);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::filesystem::path> export_meshes(const Trace& trace,
                                                 const std::vector<std::size_t>& iterations,
                                                 const std::filesystem::path& folder,
                                                 const std::string& extension) {
  make_folder(folder);
  TraceCursor cursor(trace);
  std::vector<std::filesystem::path> files;
  for (const std::size_t k : iterations) {
    files.push_back(folder / numbered(k, extension));
    (void)write_mesh(files.back(), TriangleMesh{cursor.go_to(k), trace.triangles, {}});
  }
  return files;
}

std::vector<std::filesystem::path> export_vtk_series(const Trace& trace,
                                                     const std::vector<std::size_t>& iterations,
                                                     const std::filesystem::path& folder) {
  make_folder(folder);
  TraceCursor cursor(trace);
  std::vector<std::filesystem::path> files;
  std::string index =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const std::size_t k : iterations) {
    const std::string name = numbered(k, ".vtp");
    files.push_back(folder / name);
    write_file_atomically(files.back(), VtkPolyData(trace).text(cursor.go_to(k)));
    index += "<DataSet timestep=\"" + std::to_string(k) + "\" file=\"" + name + "\"/>\n";
  }
  files.push_back(folder / "trace.pvd");
  write_file_atomically(files.back(), index + "</Collection>\n</VTKFile>\n");
  return files;
}

}  // namespace isorelax
