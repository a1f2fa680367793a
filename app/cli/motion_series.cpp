#include "cli/motion_series.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/vertex_files.h"
#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "io/text_out.h"
#include "trace/trace.h"

namespace isorelax::cli {
namespace {

constexpr std::string_view kStateSign = "isorelax advect state:";

std::string state_name(std::size_t step) {
  return "state_" + zero_padded(step, 6);
}

/// Whole, and small enough for numbers to be told apart.
bool is_step_number(double number) {
  constexpr double kMost = 9007199254740992;
  return number >= 0 && number <= kMost && number == std::floor(number);
}

/// Of all that a run goes on from.
std::string checksum_of(const MovingState& state) {
  std::string bytes;
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint64_t>(state.step));
  add(state.time);
  add(state.next_step);
  for (const Vec3& x : state.positions)
    for (const double coordinate : x) add(coordinate);
  for (const MaterialPoint& point : state.points) {
    add(point.triangle);
    for (const double weight : point.weights) add(weight);
  }
  return hash_of(bytes);
}

TriangleMesh state_mesh(const MotionRun& run) {
  const MovingState& state = run.surface().state();
  TriangleMesh mesh = run.mesh();
  std::string comment(kStateSign);
  comment += " step " + std::to_string(state.step) + " time ";
  append_number(comment, state.time);
  comment += " next_step ";
  append_number(comment, state.next_step);
  comment += " checksum " + checksum_of(state);
  mesh.attributes.comments.push_back(comment);
  if (state.points.empty()) return mesh;
  Attribute triangle{"material_triangle", ScalarType::uint32, 1, {}};
  std::array<Attribute, 3> weights;
  for (std::size_t k = 0; k < 3; ++k)
    weights[k] = {"material_weight_" + std::to_string(k), ScalarType::float64, 1, {}};
  for (const MaterialPoint& point : state.points) {
    triangle.values.push_back(point.triangle);
    for (std::size_t k = 0; k < 3; ++k)
      weights[k].values.push_back(point.weights[static_cast<Eigen::Index>(k)]);
  }
  mesh.attributes.vertex.push_back(std::move(triangle));
  for (Attribute& weight : weights) mesh.attributes.vertex.push_back(std::move(weight));
  return mesh;
}

std::string vtp_text(const TriangleMesh& mesh) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n";
  out += "<Piece NumberOfPoints=\"" + std::to_string(mesh.positions.size()) + "\" NumberOfPolys=\"" +
         std::to_string(mesh.triangles.size()) + "\">\n<Points>\n";
  out += "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const Vec3& x : mesh.positions) {
    append_point(out, x);
    out += '\n';
  }
  out +=
      "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const Triangle& t : mesh.triangles)
    out += std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  out += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t t = 1; t <= mesh.triangles.size(); ++t) out += std::to_string(3 * t) + "\n";
  out += "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return out;
}

Json distances_json(const Distances& distances) {
  return {{"max", distances.max}, {"rms", distances.rms}, {"mean", distances.mean}};
}

/// Empty where a mesh has none.
std::vector<MaterialPoint> material_points(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const auto column = [&](const std::string& name) -> const std::vector<double>* {
    for (const Attribute& attribute : mesh.attributes.vertex)
      if (attribute.name == name && attribute.width == 1) return &attribute.values;
    return nullptr;
  };
  const std::vector<double>* triangles = column("material_triangle");
  if (triangles == nullptr) return {};
  std::vector<MaterialPoint> points(mesh.positions.size());
  for (const double number : *triangles)
    if (!(number >= 0 && number < kNone))
      throw InputError(path.string(), "", "its material points are not whole");
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>* weights = column("material_weight_" + std::to_string(k));
    if (weights == nullptr) throw InputError(path.string(), "", "its material points are not whole");
    for (std::size_t v = 0; v < points.size(); ++v) {
      points[v].triangle = static_cast<Index>((*triangles)[v]);
      points[v].weights[static_cast<Eigen::Index>(k)] = (*weights)[v];
    }
  }
  return points;
}

}  // namespace

Json entry_json(const MotionEntry& entry) {
  const MotionMeasure& m = entry.measure;
  Json object = {{"step", entry.step},
                 {"time", entry.time},
                 {"dt", entry.report.dt},
                 {"min_angle_deg", m.min_angle_deg},
                 {"mean_min_angle_deg", m.mean_angle_deg},
                 {"angle_p01_deg", m.angle_p01_deg},
                 {"angle_p05_deg", m.angle_p05_deg},
                 {"angle_p50_deg", m.angle_p50_deg},
                 {"below_15_deg", m.below_15_deg},
                 {"area_max_over_min", m.area_max_over_min},
                 {"area", m.area},
                 {"volume", m.volume},
                 {"volume_change", entry.volume_change},
                 {"deviation_max", entry.report.deviation.max},
                 {"deviation_rms", entry.report.deviation.rms},
                 {"folded_edges", m.folded_edges},
                 {"parts", entry.report.parts},
                 {"redistributed", entry.report.redistributed},
                 {"moves", entry.report.relaxation.steps}};
  if (entry.report.balance.volume_before != 0) {
    object["volume_before_balance"] = entry.report.balance.volume_before;
    object["largest_balance_move"] = entry.report.balance.largest;
  }
  if (entry.error) object["error"] = distances_json(*entry.error);
  if (entry.exact) {
    object["exact"] = {{"to_exact", distances_json(entry.exact->first)},
                       {"from_exact", distances_json(entry.exact->second)}};
  }
  return object;
}

void MotionSeries::begin(const TriangleMesh& start, const Json& run) {
  std::error_code error;
  if (std::filesystem::exists(folder_ / "run.json", error))
    throw UsageError(folder_.string() + ": holds a run already; go on with --resume, or name another folder");
  std::filesystem::create_directories(folder_, error);
  if (error) throw OutputError(folder_.string(), error.message());
  static_cast<void>(write_mesh(folder_ / "start.ply", start));
  write_file_atomically(folder_ / "run.json", json_text(run));
}

void MotionSeries::write_state(const MotionRun& run, bool vtk) {
  const MovingState& state = run.surface().state();
  const std::string name = state_name(state.step);
  const TriangleMesh mesh = state_mesh(run);
  static_cast<void>(write_mesh(folder_ / (name + ".ply"), mesh));
  if (vtk) write_file_atomically(folder_ / (name + ".vtp"), vtp_text(mesh));
  if (items_.empty() || items_.back().step != state.step) items_.push_back({name, state.step, state.time});
  write_indices(vtk);
  write_log();
}

void MotionSeries::write_indices(bool vtk) const {
  Json files = Json::array();
  std::string pvd = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const Item& item : items_) {
    files.push_back({{"name", item.name + ".ply"}, {"time", item.time}});
    pvd += "<DataSet timestep=\"";
    append_number(pvd, item.time);
    pvd += "\" file=\"" + item.name + ".vtp\"/>\n";
  }
  const Json series = {{"file-series-version", "1.0"}, {"files", std::move(files)}};
  write_file_atomically(folder_ / "states.ply.series", json_text(series));
  if (vtk) write_file_atomically(folder_ / "states.pvd", pvd + "</Collection>\n</VTKFile>\n");
}

void MotionSeries::add(const MotionEntry& entry) {
  log_.push_back(entry_json(entry));
}

void MotionSeries::write_log() const {
  write_file_atomically(folder_ / "log.json", json_text(Json{{"steps", log_}}));
}

std::vector<std::filesystem::path> MotionSeries::states() const {
  std::vector<std::filesystem::path> paths;
  for (const Item& item : items_) paths.push_back(folder_ / (item.name + ".ply"));
  return paths;
}

void MotionSeries::resume_at(std::size_t step) {
  items_.clear();
  log_ = Json::array();
  try {
    const Json log = Json::parse(read_bytes(folder_ / "log.json"));
    for (const Json& entry : log.at("steps")) {
      if (log_.size() > step) break;
      if (entry.at("step").get<std::size_t>() != log_.size()) break;
      for (const char* key : {"time", "min_angle_deg", "volume_change"})
        static_cast<void>(entry.at(key).get<double>());
      log_.push_back(entry);
    }
    if (log_.size() <= step)
      throw InputError((folder_ / "log.json").string(), "",
                       "step " + std::to_string(log_.size()) + " is missing");
    const Json index = Json::parse(read_bytes(folder_ / "states.ply.series"));
    for (const Json& file : index.at("files")) {
      const std::string name = file.at("name").get<std::string>();
      const std::string stem = name.substr(0, name.find('.'));
      const auto number =
          parse_number(std::string_view(stem).substr(std::min(stem.size(), stem.find('_') + 1)));
      if (!number || !is_step_number(*number))
        throw InputError((folder_ / "states.ply.series").string(), "", name + " names no step");
      if (*number > static_cast<double>(step)) break;
      items_.push_back({stem, static_cast<std::size_t>(*number), file.at("time").get<double>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(folder_.string(), "log.json and states.ply.series", error.what());
  }
}

MovingState read_state(const std::filesystem::path& path) {
  const MeshFile file = read_mesh(path);
  MovingState state;
  std::string checksum;
  for (const std::string& comment : file.mesh.attributes.comments) {
    if (!comment.starts_with(kStateSign)) continue;
    std::istringstream words(comment.substr(kStateSign.size()));
    std::array<std::string, 8> word;
    for (std::string& w : word) words >> w;
    const auto step = parse_number(word[1]);
    const auto time = parse_number(word[3]);
    const auto next = parse_number(word[5]);
    if (!step || !time || !next || !is_step_number(*step) || word[7].empty())
      throw InputError(path.string(), "", "its state comment is damaged");
    state.step = static_cast<std::size_t>(*step);
    state.time = *time;
    state.next_step = *next;
    checksum = word[7];
  }
  if (checksum.empty()) throw InputError(path.string(), "", "not a state of isorelax advect");
  state.positions = file.mesh.positions;
  state.points = material_points(path, file.mesh);
  if (checksum_of(state) != checksum)
    throw InputError(path.string(), "", "is damaged: it has not the checksum that was written into it");
  return state;
}

}  // namespace isorelax::cli
