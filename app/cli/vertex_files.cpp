#include "cli/vertex_files.h"

#include <cmath>
#include <fstream>

#include "cli/console.h"
#include "io/text_in.h"
#include "mesh/error.h"
#include "smoothing/pins.h"

namespace isorelax::cli {
namespace {

constexpr std::string_view kBox = "box:";
constexpr std::string_view kSeparators = " \t\r,";

/// Calls word(text, row) for every word of a text file, comments left out.
template <typename Word>
void for_each_word(const std::string& path, const Word& word) {
  std::ifstream file(path);
  if (!file) throw InputError(path, "", "cannot be opened");
  std::string line;
  for (unsigned row = 1; std::getline(file, line); ++row) {
    line.resize(std::min(line.size(), line.find('#')));
    std::size_t at = 0;
    while ((at = line.find_first_not_of(kSeparators, at)) != std::string::npos) {
      const std::size_t end = std::min(line.size(), line.find_first_of(kSeparators, at));
      word(line.substr(at, end - at), row);
      at = end;
    }
  }
  if (file.bad()) throw InputError(path, "", "cannot be read");
}

std::string place_of(unsigned row) {
  return "line " + std::to_string(row);
}

std::vector<Index> read_pins(const std::string& path, std::size_t vertex_count) {
  std::vector<Index> pins;
  for_each_word(path, [&](const std::string& word, unsigned row) {
    Index id = 0;
    if (!read_number(word, id))
      throw InputError(path, place_of(row), "expected vertex numbers, found \"" + word + "\"");
    if (id >= vertex_count) {
      throw InputError(path, place_of(row),
                       "names vertex " + word + ", but the mesh has " + std::to_string(vertex_count) +
                           " (numbered from 0)");
    }
    pins.push_back(id);
  });
  return pins;
}

/// Three numbers with commas between.
std::optional<Vec3> parse_point(std::string_view text) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto value = parse_number(text.substr(0, comma));
    if (!value || std::isnan(*value)) return std::nullopt;
    point[axis] = *value;
    text.remove_prefix(std::min(text.size(), comma + 1));
  }
  return point;
}

Box parse_box(const std::string& pin) {
  const std::string_view text = std::string_view(pin).substr(kBox.size());
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    const auto a = parse_point(text.substr(0, colon));
    const auto b = parse_point(text.substr(colon + 1));
    if (a && b) return {a->cwiseMin(*b), a->cwiseMax(*b)};
  }
  throw UsageError("--pin " + pin + ": expected two corners, as in box:0,0,0:1,1,0.5");
}

constexpr std::string_view kVertices = "vertices:";

/// "vertices:12,40".
std::vector<Index> listed_vertices(const std::string& pin, std::size_t vertex_count) {
  std::vector<Index> listed;
  for (std::size_t at = kVertices.size(); at <= pin.size();) {
    const std::size_t comma = std::min(pin.find(',', at), pin.size());
    Index id = 0;
    if (!read_number(std::string_view(pin).substr(at, comma - at), id) || id >= vertex_count)
      throw UsageError("--pin " + pin + ": expected numbers below " + std::to_string(vertex_count) +
                       " with commas between, as in vertices:12,40");
    listed.push_back(id);
    at = comma + 1;
  }
  return listed;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  return read_number(text, value) ? std::optional(value) : std::nullopt;
}

std::vector<double> read_size_field(const std::string& path, std::size_t vertex_count) {
  std::vector<double> lengths;
  for_each_word(path, [&](const std::string& word, unsigned row) {
    const auto value = parse_number(word);
    if (!value || !(*value > 0) || !std::isfinite(*value))
      throw InputError(path, place_of(row), "expected a positive edge length, found \"" + word + "\"");
    if (lengths.size() == vertex_count) {
      throw InputError(path, place_of(row),
                       "holds more values than the mesh has vertices (" + std::to_string(vertex_count) + ")");
    }
    lengths.push_back(*value);
  });
  if (lengths.size() < vertex_count) {
    throw InputError(path, "",
                     "holds " + std::to_string(lengths.size()) + " values, but the mesh has " +
                         std::to_string(vertex_count) + " vertices");
  }
  return lengths;
}

std::vector<Index> parse_pins(Console& console, const std::vector<std::string>& pins,
                              const TriangleMesh& mesh, const ProblemOptions& options) {
  std::vector<Index> all;
  for (const std::string& pin : pins) {
    std::vector<Index> held;
    if (pin == "boundary") {
      held = boundary_vertices(Topology(mesh.triangles, mesh.vertex_count()));
    } else if (pin == "feature") {
      held = feature_vertices(mesh.positions, mesh.triangles, Topology(mesh.triangles, mesh.vertex_count()),
                              options.features, options.threads);
    } else if (pin.starts_with(kBox)) {
      held = vertices_in(parse_box(pin), mesh.positions);
    } else if (pin.starts_with(kVertices)) {
      held = listed_vertices(pin, mesh.vertex_count());
    } else {
      held = read_pins(pin, mesh.vertex_count());
    }
    console.message("--pin " + pin + " holds " + std::to_string(held.size()) +
                    (held.size() == 1 ? " vertex" : " vertices"));
    all.insert(all.end(), held.begin(), held.end());
  }
  return all;
}

}  // namespace isorelax::cli
