#include <algorithm>
#include <cmath>
#include <set>

#include "io/mesh_file.h"
#include "io/ply_columns.h"
#include "io/ply_source.h"
#include "io/polygon_soup.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

bool is_index_list(const PlyProperty& property) {
  return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Reads the elements vertex and face (or tristrips) and what hangs on them; other elements are passed over.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name)
      : name_(name), header_(read_ply_header(bytes, name)), source_(bytes, name, header_) {}

  [[nodiscard]] FileEncoding encoding() const { return header_.encoding; }

  RawMesh read() {
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const PlyElement& element) { return element.name == "vertex"; });
    if (vertex == header_.elements.end()) {
      throw InputError(one_line(name_), "line " + std::to_string(header_.lines), "has no element 'vertex'");
    }
    vertex_count_ = vertex->count;
    for (const PlyElement& element : header_.elements) {
      read_element(element);
    }
    finish();
    return std::move(raw_);
  }

 private:
  void check_count(const PlyElement& element) const;
  void read_element(const PlyElement& element);
  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element);
  void read_strips(const PlyElement& element);
  void pass_over(const PlyElement& element);
  void add_face_texture(std::size_t degree);
  void add_strip(const std::vector<double>& strip);
  Index vertex_index(double value) const;
  void read_list(const PlyProperty& list, std::vector<double>& values);
  void drop_list(const PlyElement& element, const PlyProperty& list);
  std::vector<PlyColumn> columns_of(const PlyElement& element) const;
  void finish();

  const std::string& name_;
  PlyHeader header_;
  PlySource source_;
  RawMesh raw_;
  std::uint64_t vertex_count_ = 0;
  std::vector<double> texture_row_;
  CornerAttribute texture_{"texcoord", 2, {}, {}};
  std::size_t faces_without_texture_ = 0;
  std::set<const PlyProperty*> dropped_lists_;
};

/// Refuses a count for which the rest of the file is too short, before memory is set aside for it.
void PlyReader::check_count(const PlyElement& element) const {
  std::size_t row = 0;
  for (const PlyProperty& property : element.properties) {
    row += source_.least_size(property.list_count.value_or(property.type));
  }
  const auto place = "line " + std::to_string(element.line);
  if (row > 0 && element.count > source_.bytes_left() / row + 1) {
    throw InputError(one_line(name_), place,
                     "the header promises " + std::to_string(element.count) + " of " +
                         in_quotes(element.name) + ", but only " + std::to_string(source_.bytes_left()) +
                         " bytes follow");
  }
  if (element.count >= kNone) {
    throw InputError(
        one_line(name_), place,
        std::to_string(element.count) + " of " + in_quotes(element.name) + " are more than can be held");
  }
}

void PlyReader::read_element(const PlyElement& element) {
  source_.at(element, 0);
  check_count(element);
  if (element.name == "vertex") {
    read_vertices(element);
  } else if (element.name == "face" && element.count > 0) {
    read_faces(element);
  } else if (element.name == "tristrips") {
    read_strips(element);
  } else {
    pass_over(element);
    if (element.count > 0) {
      raw_.messages.push_back(std::to_string(element.count) + " of the element " + in_quotes(element.name) +
                              " left out");
    }
  }
}

void PlyReader::pass_over(const PlyElement& element) {
  if (element.properties.empty()) {
    return;
  }
  for (std::size_t row = 0; row < element.count; ++row) {
    source_.at(element, row);
    for (const PlyProperty& property : element.properties) {
      source_.skip(property.type, property.list_count ? source_.list_size(property) : 1);
    }
    source_.end_row();
  }
}

std::vector<PlyColumn> PlyReader::columns_of(const PlyElement& element) const {
  std::vector<PlyColumn> columns;
  for (const PlyProperty& property : element.properties) {
    columns.push_back({property.name, property.type, {}});
    if (!property.list_count) {
      columns.back().values.reserve(element.count);
    }
  }
  return columns;
}

/// Keeps the columns of single numbers whose name `keep` accepts.
template <class Keep>
std::vector<PlyColumn> kept_columns(const PlyElement& element, std::vector<PlyColumn>&& columns, Keep keep) {
  std::vector<PlyColumn> kept;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!element.properties[k].list_count && keep(columns[k].name)) {
      kept.push_back(std::move(columns[k]));
    }
  }
  return kept;
}

void PlyReader::drop_list(const PlyElement& element, const PlyProperty& list) {
  source_.skip(list.type, source_.list_size(list));
  if (dropped_lists_.insert(&list).second) {
    raw_.messages.push_back("list " + in_quotes(list.name) + " of " + in_quotes(element.name) + " left out");
  }
}

void PlyReader::read_vertices(const PlyElement& element) {
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  // Which coordinate a property is; 3: none.
  std::vector<unsigned> axis_of(element.properties.size(), 3);
  ScalarType type = ScalarType::float64;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto place = element.find(kAxes[axis]);
    if (!place || element.properties[*place].list_count) {
      throw InputError(one_line(name_), "line " + std::to_string(element.line),
                       std::string("element 'vertex' has no number '") + kAxes[axis] + "'");
    }
    axis_of[*place] = axis;
    const ScalarType own = element.properties[*place].type;
    type = axis == 0 || own == type ? own : ScalarType::float64;
  }
  raw_.attributes.position_type = type;
  raw_.positions.reserve(element.count);
  std::vector<PlyColumn> columns = columns_of(element);
  for (std::size_t row = 0; row < element.count; ++row) {
    source_.at(element, row);
    Vec3 position;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.list_count) {
        drop_list(element, property);
        continue;
      }
      const double value = source_.number(property.type);
      if (axis_of[k] == 3) {
        columns[k].values.push_back(value);
        continue;
      }
      if (!std::isfinite(value)) {
        source_.fail("coordinate " + property.name +
                     (std::isnan(value) ? " is not a number (NaN)" : " is infinite or too large"));
      }
      position[axis_of[k]] = value;
    }
    source_.end_row();
    raw_.positions.push_back(position);
  }
  raw_.attributes.vertex = join_columns(kept_columns(
      element, std::move(columns), [](const std::string& n) { return n != "x" && n != "y" && n != "z"; }));
}

Index PlyReader::vertex_index(double value) const {
  if (!(value >= 0.0 && value < static_cast<double>(vertex_count_))) {
    std::string text = std::to_string(value);
    text.erase(std::min(text.find('.'), text.size()));
    source_.fail("names vertex " + text + ", but there are " + std::to_string(vertex_count_) +
                 " (numbered from 0)");
  }
  if (value != std::trunc(value)) {
    source_.fail("a vertex index is not a whole number");
  }
  return static_cast<Index>(value);
}

void PlyReader::read_list(const PlyProperty& list, std::vector<double>& values) {
  const std::size_t size = source_.list_size(list);
  for (std::size_t k = 0; k < size; ++k) {
    values.push_back(source_.number(list.type));
  }
}

/// Gives the corners of the face just read two numbers each out of `texture_row_`.
void PlyReader::add_face_texture(std::size_t degree) {
  const bool complete = texture_row_.size() == 2 * degree;
  faces_without_texture_ += complete ? 0 : 1;
  for (std::size_t k = 0; k < degree; ++k) {
    texture_.indices.push_back(complete ? static_cast<std::uint32_t>(texture_.values.size() / 2 + k) : kNone);
  }
  if (complete) {
    texture_.values.insert(texture_.values.end(), texture_row_.begin(), texture_row_.end());
  }
}

void PlyReader::read_faces(const PlyElement& element) {
  if (std::none_of(element.properties.begin(), element.properties.end(), is_index_list)) {
    throw InputError(one_line(name_), "line " + std::to_string(element.line),
                     "element 'face' has no list 'vertex_indices'");
  }
  const auto texture = element.find("texcoord");
  const bool has_texture = texture && element.properties[*texture].list_count;
  raw_.faces.first_corner.reserve(element.count + 1);
  std::vector<PlyColumn> columns = columns_of(element);
  for (std::size_t row = 0; row < element.count; ++row) {
    source_.at(element, row);
    texture_row_.clear();
    bool has_indices = false;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (is_index_list(property) && !has_indices) {
        has_indices = true;
        const std::size_t degree = source_.list_size(property);
        for (std::size_t c = 0; c < degree; ++c) {
          raw_.faces.vertices.push_back(vertex_index(source_.number(property.type)));
        }
      } else if (has_texture && k == *texture) {
        read_list(property, texture_row_);
      } else if (property.list_count) {
        drop_list(element, property);
      } else {
        columns[k].values.push_back(source_.number(property.type));
      }
    }
    source_.end_row();
    if (raw_.faces.vertices.size() >= kNone) {
      source_.fail("the faces have more corners than can be held");
    }
    if (has_texture) {
      add_face_texture(raw_.faces.vertices.size() - raw_.faces.first_corner.back());
    }
    raw_.faces.end_face();
  }
  raw_.attributes.face =
      join_columns(kept_columns(element, std::move(columns), [](const std::string&) { return true; }));
}

/// Adds the triangles of a strip, in which -1 begins a new one; every other triangle runs backwards.
void PlyReader::add_strip(const std::vector<double>& strip) {
  std::vector<Index> window;
  for (const double value : strip) {
    if (value == -1.0) {
      window.clear();
      continue;
    }
    window.push_back(vertex_index(value));
    const std::size_t n = window.size();
    if (n < 3 || window[n - 1] == window[n - 2] || window[n - 2] == window[n - 3] ||
        window[n - 1] == window[n - 3]) {
      continue;
    }
    const bool forward = n % 2 == 1;
    raw_.faces.vertices.insert(raw_.faces.vertices.end(),
                               {window[n - (forward ? 3 : 2)], window[n - (forward ? 2 : 3)], window[n - 1]});
    raw_.faces.end_face();
  }
}

void PlyReader::read_strips(const PlyElement& element) {
  if (std::none_of(element.properties.begin(), element.properties.end(), is_index_list) ||
      raw_.faces.face_count() > 0) {
    source_.fail("triangle strips need a list 'vertex_indices' and no faces beside them");
  }
  std::vector<double> strip;
  for (std::size_t row = 0; row < element.count; ++row) {
    source_.at(element, row);
    for (const PlyProperty& property : element.properties) {
      if (is_index_list(property)) {
        strip.clear();
        read_list(property, strip);
        add_strip(strip);
      } else if (property.list_count) {
        drop_list(element, property);
      } else {
        source_.skip(property.type, 1);
      }
    }
    source_.end_row();
  }
  raw_.messages.push_back(counted(raw_.faces.face_count(), "triangle", "triangles") +
                          " made of triangle strips");
}

void PlyReader::finish() {
  if (!texture_.indices.empty()) {
    if (faces_without_texture_ > 0) {
      raw_.messages.push_back(counted(faces_without_texture_, "face", "faces") +
                              " without two texture coordinates per corner");
    }
    raw_.attributes.corner.push_back(std::move(texture_));
  }
  if (const std::string rest = source_.describe_rest(); !rest.empty()) {
    raw_.messages.push_back(rest);
  }
  raw_.attributes.comments = std::move(header_.comments);
  for (const std::string& line : header_.object_information) {
    raw_.attributes.header_lines.push_back("obj_info " + line);
  }
}

}  // namespace

MeshFile read_ply(std::string_view bytes, const std::string& name) {
  PlyReader reader(bytes, name);
  RawMesh raw = reader.read();
  return finish_mesh(std::move(raw), FileFormat::ply, reader.encoding(), name);
}

}  // namespace isorelax
