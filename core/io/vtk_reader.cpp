#include <algorithm>
#include <array>
#include <cmath>

#include "io/mesh_file.h"
#include "io/text_scanner.h"
#include "io/vtk_names.h"
#include "io/vtk_scanner.h"
#include "io/vtk_surface.h"

namespace isorelax {
namespace {

/// The lists of a polygonal data set in the order in which its cell data goes through them.
struct VtkList {
  const char* keyword;
  VtkCellType type;
};
constexpr std::array<VtkList, 4> kVtkLists{{{"vertices", VtkCellType::poly_vertex},
                                            {"lines", VtkCellType::poly_line},
                                            {"polygons", VtkCellType::polygon},
                                            {"triangle_strips", VtkCellType::triangle_strip}}};

/// Attributes that are a name, a type and so many numbers for each element.
struct PlainVtkAttribute {
  const char* keyword;
  unsigned width;
};
constexpr std::array<PlainVtkAttribute, 7> kPlainAttributes{{{"vectors", 3},
                                                             {"normals", 3},
                                                             {"tensors", 9},
                                                             {"tensors6", 6},
                                                             {"global_ids", 1},
                                                             {"pedigree_ids", 1},
                                                             {"edge_flags", 1}}};

/// Reads a legacy file: "VTK File Formats" of the VTK User's Guide, and what VTK 9 writes since.
class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name) {}

  RawMesh read() {
    read_header();
    for (std::string_view word = words().word(); !word.empty(); word = words().word()) {
      read_section(word);
    }
    return finish();
  }
  [[nodiscard]] FileEncoding encoding() const {
    return scanner_.is_text() ? FileEncoding::text : FileEncoding::binary_big_endian;
  }

 private:
  MixedScanner& words() { return scanner_.words(); }
  void read_header();
  void read_section(std::string_view word);
  bool read_geometry(const std::string& keyword);
  void read_points();
  void read_list(const std::string& keyword, VtkCells& cells);
  void begin_data(VtkData& data, const char* elements, std::size_t count);
  bool read_attribute(const std::string& keyword);
  VtkArray named_array();
  void read_scalars();
  void read_color_scalars();
  void read_texture();
  void read_lookup_table();
  void read_field();
  void add(VtkArray&& array);
  [[nodiscard]] std::size_t cell_count() const;
  RawMesh finish();

  VtkScanner scanner_;
  VtkSurface surface_;
  bool since_version_5_ = false;
  bool polygonal_ = false;
  /// Those of kVtkLists, or of an unstructured grid the first alone.
  std::array<VtkCells, 4> lists_;
  std::vector<std::uint8_t> types_;
  std::vector<std::string> seen_;
  /// Where arrays go: none before the first POINT_DATA or CELL_DATA.
  VtkData* data_ = nullptr;
  std::size_t data_rows_ = 0;
};

void VtkReader::read_header() {
  static constexpr std::string_view kStart = "# vtk datafile version ";
  const std::string first = vtk_lower_case(words().line());
  if (!first.starts_with(kStart)) {
    words().fail("expected '# vtk DataFile Version', found " + in_quotes(first));
  }
  const std::string version = first.substr(kStart.size());
  const std::optional<double> number = parse_double(version);
  if (!number || !(*number >= 1.0 && *number < 6.0)) {
    words().fail("version " + in_quotes(version) + " is not read; 1.0 to 5.1 are");
  }
  since_version_5_ = *number >= 5.0;
  const std::string title(words().line());
  if (!is_default_vtk_title(title)) {
    surface_.comments().push_back(title);
  }
  const std::string_view encoding = words().word();
  if (const std::string lower = vtk_lower_case(encoding); lower != "ascii" && lower != "binary") {
    words().fail("expected ASCII or BINARY, found " + in_quotes(encoding));
  }
  scanner_.set_text(vtk_lower_case(encoding) == "ascii");
  if (const std::string_view word = words().word(); vtk_lower_case(word) != "dataset") {
    words().fail("expected DATASET, found " + in_quotes(word));
  }
  const std::string_view kind = words().word();
  polygonal_ = vtk_lower_case(kind) == "polydata";
  if (!polygonal_ && vtk_lower_case(kind) != "unstructured_grid") {
    words().fail("the data set is a " + in_quotes(kind) + "; POLYDATA and UNSTRUCTURED_GRID are read");
  }
}

void VtkReader::read_section(std::string_view word) {
  const std::string keyword = vtk_lower_case(word);
  if (keyword == "metadata") {
    scanner_.skip_metadata();
  } else if (keyword == "field") {
    read_field();
  } else if (keyword == "point_data") {
    begin_data(surface_.point_data(), "points", surface_.point_count());
  } else if (keyword == "cell_data") {
    begin_data(surface_.cell_data(), "cells", cell_count());
  } else if (!read_geometry(keyword) && !(data_ != nullptr && read_attribute(keyword))) {
    words().fail("unknown keyword " + in_quotes(word));
  }
}

bool VtkReader::read_geometry(const std::string& keyword) {
  const auto* const list = std::find_if(kVtkLists.begin(), kVtkLists.end(), [&](const VtkList& candidate) {
    return candidate.keyword == keyword;
  });
  const bool is_list = polygonal_ && list != kVtkLists.end();
  const bool is_cells = !polygonal_ && (keyword == "cells" || keyword == "cell_types");
  if (keyword != "points" && !is_list && !is_cells) {
    return false;
  }
  if (data_ != nullptr || std::find(seen_.begin(), seen_.end(), keyword) != seen_.end()) {
    words().fail(in_quotes(keyword) + (data_ != nullptr ? " stands after the data" : " stands twice"));
  }
  seen_.push_back(keyword);
  if (keyword == "points") {
    read_points();
  } else if (keyword == "cell_types") {
    types_ = scanner_.small_numbers(words().count("the number of types of cells"), "the type of a cell");
  } else {
    VtkCells& cells = is_list ? lists_[static_cast<std::size_t>(list - kVtkLists.begin())] : lists_[0];
    cells = scanner_.cells(surface_.point_count(), since_version_5_);
  }
  return true;
}

void VtkReader::read_points() {
  VtkArray positions;
  positions.rows = words().count("the number of points");
  positions.width = 3;
  if (positions.rows >= kNone) {
    words().fail(std::to_string(positions.rows) + " points are more than can be held");
  }
  positions.type = scanner_.type();
  scanner_.begin_numbers();
  scanner_.coordinates(positions);
  surface_.add_positions(positions);
}

std::size_t VtkReader::cell_count() const {
  std::size_t count = 0;
  for (const VtkCells& list : lists_) {
    count += list.ends.size();
  }
  return count;
}

void VtkReader::begin_data(VtkData& data, const char* elements, std::size_t count) {
  const std::uint64_t rows = words().count("the number of rows of the data");
  if (rows != count) {
    words().fail("data for " + std::to_string(rows) + " " + elements + ", but there are " +
                 std::to_string(count));
  }
  data_ = &data;
  data_rows_ = count;
}

/// An array of which the name and one row per element are known.
VtkArray VtkReader::named_array() {
  VtkArray array;
  array.name = decode_vtk_name(words().word());
  array.rows = data_rows_;
  return array;
}

bool VtkReader::read_attribute(const std::string& keyword) {
  const auto* const plain =
      std::find_if(kPlainAttributes.begin(), kPlainAttributes.end(),
                   [&](const PlainVtkAttribute& candidate) { return candidate.keyword == keyword; });
  if (plain != kPlainAttributes.end()) {
    VtkArray array = named_array();
    array.type = scanner_.type();
    array.width = plain->width;
    if (keyword == "normals" && data_ == &surface_.point_data()) {
      array.name = "Normals";
    }
    scanner_.begin_numbers();
    scanner_.numbers(array);
    add(std::move(array));
  } else if (keyword == "scalars") {
    read_scalars();
  } else if (keyword == "color_scalars") {
    read_color_scalars();
  } else if (keyword == "texture_coordinates") {
    read_texture();
  } else if (keyword == "lookup_table") {
    read_lookup_table();
  } else {
    return false;
  }
  return true;
}

void VtkReader::read_scalars() {
  VtkArray array = named_array();
  array.type = scanner_.type();
  const std::string_view rest = words().line();
  const std::optional<std::int64_t> width = rest.empty() ? 1 : parse_integer(rest);
  if (!width || *width < 0) {
    words().fail("the number of components of scalars is none: " + in_quotes(rest));
  }
  array.width = static_cast<std::uint64_t>(*width);
  if (const std::string_view word = words().word(); vtk_lower_case(word) != "lookup_table") {
    words().fail("expected LOOKUP_TABLE after SCALARS, found " + in_quotes(word));
  }
  static_cast<void>(words().word());
  scanner_.begin_numbers();
  scanner_.numbers(array);
  add(std::move(array));
}

/// Colours are bytes; a text has them as fractions of 255, rounded to some digits.
void VtkReader::read_color_scalars() {
  VtkArray array = named_array();
  array.width = words().count("the number of components of colours");
  array.type = scanner_.is_text() ? VtkType::float64 : VtkType::uint8;
  scanner_.begin_numbers();
  scanner_.numbers(array);
  const auto is_byte = [](double value) {
    return value >= 0.0 && value <= 1.0 && std::abs(255.0 * value - std::round(255.0 * value)) < 1e-2;
  };
  if (scanner_.is_text() && std::all_of(array.values.begin(), array.values.end(), is_byte)) {
    array.type = VtkType::uint8;
    for (double& value : array.values) {
      value = std::round(255.0 * value) + 0.0;
    }
  }
  add(std::move(array));
}

void VtkReader::read_texture() {
  VtkArray array = named_array();
  array.width = words().count("the number of components of texture coordinates");
  array.type = scanner_.type();
  if (data_ == &surface_.point_data()) {
    array.name = "TCoords";
  }
  scanner_.begin_numbers();
  scanner_.numbers(array);
  add(std::move(array));
}

void VtkReader::read_lookup_table() {
  VtkArray table;
  table.name = decode_vtk_name(words().word());
  table.rows = words().count("the number of colours");
  table.width = 4;
  table.type = scanner_.is_text() ? VtkType::float64 : VtkType::uint8;
  scanner_.begin_numbers();
  scanner_.numbers(table);
  surface_.messages().push_back("lookup table " + in_quotes(table.name) + " left out");
}

void VtkReader::read_field() {
  for (VtkArray& array : scanner_.field(surface_.messages())) {
    if (data_ == nullptr) {
      surface_.messages().push_back("array " + in_quotes(array.name) + " of the whole data set left out");
    } else if (array.rows != data_rows_) {
      surface_.messages().push_back("array " + in_quotes(array.name) + " left out: it has " +
                                    std::to_string(array.rows) + " rows for " + std::to_string(data_rows_) +
                                    (data_ == &surface_.point_data() ? " points" : " cells"));
    } else {
      add(std::move(array));
    }
  }
}

void VtkReader::add(VtkArray&& array) {
  if (data_ == &surface_.point_data()) {
    array.name = name_of_point_array(array.name, array.width);
  }
  data_->add(std::move(array));
}

RawMesh VtkReader::finish() {
  if (!polygonal_ && types_.size() != lists_[0].ends.size()) {
    words().fail(std::to_string(lists_[0].ends.size()) + " cells have " + std::to_string(types_.size()) +
                 " types");
  }
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    const std::array<std::uint8_t, 1> type{static_cast<std::uint8_t>(kVtkLists[i].type)};
    const std::string refusal = surface_.add_cells(
        lists_[i], polygonal_ ? std::span<const std::uint8_t>(type) : std::span<const std::uint8_t>(types_));
    if (!refusal.empty()) {
      words().fail(refusal);
    }
    lists_[i] = {};
  }
  surface_.point_data().end_piece();
  surface_.cell_data().end_piece();
  return surface_.finish();
}

}  // namespace

MeshFile read_vtk(std::string_view bytes, const std::string& name) {
  VtkReader reader(bytes, name);
  RawMesh raw = reader.read();
  return finish_mesh(std::move(raw), FileFormat::vtk, reader.encoding(), name);
}

}  // namespace isorelax
