#include <array>
#include <cmath>

#include "io/attribute_access.h"
#include "io/mesh_file.h"
#include "io/scalar_bytes.h"
#include "io/text_scanner.h"
#include "io/vtk_names.h"
#include "io/vtk_surface.h"
#include "io/vtk_xml_file.h"

namespace isorelax {
namespace {

/// The lists of a polygonal data set in the order in which its cell data goes through them.
struct VtkXmlList {
  const char* element;
  const char* count;
  VtkCellType type;
};
constexpr std::array<VtkXmlList, 4> kVtkXmlLists{{{"Verts", "NumberOfVerts", VtkCellType::poly_vertex},
                                                  {"Lines", "NumberOfLines", VtkCellType::poly_line},
                                                  {"Polys", "NumberOfPolys", VtkCellType::polygon},
                                                  {"Strips", "NumberOfStrips", VtkCellType::triangle_strip}}};

/// Reads PolyData and UnstructuredGrid: "VTK XML formats" of the VTK User's Guide.
class VtkXmlReader {
 public:
  VtkXmlReader(std::string_view bytes, const std::string& name) : file_(bytes, name) {}

  RawMesh read();
  [[nodiscard]] FileFormat format() const { return polygonal_ ? FileFormat::vtp : FileFormat::vtu; }
  /// Whatever order the bytes had, they are written little endian.
  [[nodiscard]] FileEncoding encoding() const {
    return file_.has_binary() ? FileEncoding::binary_little_endian : FileEncoding::text;
  }

 private:
  void read_piece(pugi::xml_node piece);
  void read_points(pugi::xml_node piece, std::uint64_t count);
  VtkArray cell_array(pugi::xml_node list, const char* name, std::uint64_t rows);
  VtkCells read_cells(pugi::xml_node piece, const char* element, std::uint64_t count);
  std::vector<std::uint8_t> read_types(pugi::xml_node piece, std::uint64_t count);
  void add_cells(pugi::xml_node piece, const VtkCells& cells, std::span<const std::uint8_t> types);
  void read_data(pugi::xml_node piece, VtkData& data, std::uint64_t rows);

  VtkXmlFile file_;
  VtkSurface surface_;
  bool polygonal_ = false;
  /// Points of the pieces before this one.
  std::size_t first_point_ = 0;
};

RawMesh VtkXmlReader::read() {
  const pugi::xml_node root = file_.root();
  const std::string_view type = root.attribute("type").value();
  polygonal_ = type == "PolyData";
  if (!polygonal_ && type != "UnstructuredGrid") {
    file_.fail(root, "the data set is a " + in_quotes(type) + "; PolyData and UnstructuredGrid are read");
  }
  const pugi::xml_node data_set = root.child(polygonal_ ? "PolyData" : "UnstructuredGrid");
  for (const pugi::xml_node array : data_set.child("FieldData").children()) {
    if (array.type() == pugi::node_element) {
      surface_.messages().push_back("array " + in_quotes(array.attribute("Name").value()) +
                                    " of the whole data set left out");
    }
  }
  for (const pugi::xml_node piece : data_set.children("Piece")) {
    read_piece(piece);
  }
  surface_.comments() = file_.comments();
  return surface_.finish();
}

void VtkXmlReader::read_piece(pugi::xml_node piece) {
  first_point_ = surface_.point_count();
  const std::size_t first_cell = surface_.cell_count();
  const std::uint64_t points = file_.count(piece, "NumberOfPoints");
  read_points(piece, points);
  if (polygonal_) {
    for (const VtkXmlList& list : kVtkXmlLists) {
      const VtkCells cells = read_cells(piece, list.element, file_.count(piece, list.count));
      add_cells(piece, cells, std::array{static_cast<std::uint8_t>(list.type)});
    }
  } else {
    const std::uint64_t count = file_.count(piece, "NumberOfCells");
    const VtkCells cells = read_cells(piece, "Cells", count);
    add_cells(piece, cells, read_types(piece, count));
  }
  read_data(piece, surface_.point_data(), points);
  read_data(piece, surface_.cell_data(), surface_.cell_count() - first_cell);
}

void VtkXmlReader::read_points(pugi::xml_node piece, std::uint64_t count) {
  if (count == 0) {
    return;
  }
  const pugi::xml_node node = piece.child("Points").child("DataArray");
  if (!node) {
    file_.fail(piece, "the piece has " + std::to_string(count) + " points, but no array of them");
  }
  if (count >= kNone - first_point_) {
    file_.fail(piece, std::to_string(first_point_ + count) + " points are more than can be held");
  }
  const VtkArray positions = file_.array(node, count);
  if (positions.width != 3) {
    file_.fail(node, "points have " + std::to_string(positions.width) + " coordinates; 3 are read");
  }
  for (std::size_t i = 0; i < positions.values.size(); ++i) {
    if (!std::isfinite(positions.values[i])) {
      file_.fail(node, "a coordinate of point " + std::to_string(i / 3) +
                           (std::isnan(positions.values[i]) ? " is not a number (NaN)"
                                                            : " is infinite or too large"));
    }
  }
  surface_.add_positions(positions);
}

/// Reads one of the arrays that cells are made of: whole numbers, one for each row.
VtkArray VtkXmlReader::cell_array(pugi::xml_node list, const char* name, std::uint64_t rows) {
  const pugi::xml_node node = list.find_child_by_attribute("DataArray", "Name", name);
  if (!node) {
    file_.fail(list, "has no array " + in_quotes(name));
  }
  VtkArray array = file_.array(node, rows);
  if (array.width != 1 || !is_whole(array.type)) {
    file_.fail(node, in_quotes(name) + " has to be one whole number for each");
  }
  for (const double value : array.values) {
    if (value != std::trunc(value)) {
      file_.fail(node, in_quotes(name) + " has to be whole numbers");
    }
  }
  return array;
}

VtkCells VtkXmlReader::read_cells(pugi::xml_node piece, const char* element, std::uint64_t count) {
  VtkCells cells;
  if (count == 0) {
    return cells;
  }
  const pugi::xml_node list = piece.child(element);
  if (!list) {
    file_.fail(piece, "the piece has no element " + in_quotes(element));
  }
  const VtkArray ends = cell_array(list, "offsets", count);
  cells.ends.reserve(ends.values.size());
  double least = 0.0;
  // Beyond 2^53 neighbours are the same double, but no file is so large.
  constexpr double kMost = 9007199254740992.0;
  for (const double end : ends.values) {
    if (!(end >= least && end < kMost)) {
      file_.fail(list, "'offsets' of cells have to go up from 0");
    }
    least = end;
    cells.ends.push_back(static_cast<std::size_t>(end));
  }
  const VtkArray vertices = cell_array(list, "connectivity", cells.ends.back());
  const std::size_t points = surface_.point_count() - first_point_;
  cells.vertices.reserve(vertices.values.size());
  for (const double vertex : vertices.values) {
    if (!(vertex >= 0.0 && vertex < static_cast<double>(points))) {
      std::string number;
      append_scalar_text(number, vertex, ScalarType::float64);
      file_.fail(list, "a cell names point " + number + ", but there are " + std::to_string(points) +
                           " (numbered from 0)");
    }
    cells.vertices.push_back(static_cast<Index>(first_point_) + static_cast<Index>(vertex));
  }
  return cells;
}

std::vector<std::uint8_t> VtkXmlReader::read_types(pugi::xml_node piece, std::uint64_t count) {
  std::vector<std::uint8_t> types;
  if (count == 0) {
    return types;
  }
  const pugi::xml_node list = piece.child("Cells");
  for (const double type : cell_array(list, "types", count).values) {
    if (!fits(type, ScalarType::uint8)) {
      file_.fail(list, "a cell is of an unknown type");
    }
    types.push_back(static_cast<std::uint8_t>(type));
  }
  return types;
}

void VtkXmlReader::add_cells(pugi::xml_node piece, const VtkCells& cells,
                             std::span<const std::uint8_t> types) {
  const std::string refusal = surface_.add_cells(cells, types);
  if (!refusal.empty()) {
    file_.fail(piece, refusal);
  }
}

void VtkXmlReader::read_data(pugi::xml_node piece, VtkData& data, std::uint64_t rows) {
  if (rows == 0) {
    return;
  }
  const bool of_points = &data == &surface_.point_data();
  const pugi::xml_node list = piece.child(of_points ? "PointData" : "CellData");
  // The list may name the array that serves as normals, or texture coordinates, whatever that is called.
  const std::string_view normals = list.attribute("Normals").value();
  const std::string_view texture = list.attribute("TCoords").value();
  for (const pugi::xml_node node : list.children()) {
    if (node.type() != pugi::node_element) {
      continue;
    }
    const std::string_view type = node.attribute("type").value();
    if (std::string_view(node.name()) != "DataArray" || type == "String") {
      surface_.messages().push_back("array " + in_quotes(node.attribute("Name").value()) + " of type " +
                                    in_quotes(type) + " left out");
      continue;
    }
    VtkArray array = file_.array(node, rows);
    if (of_points && !array.name.empty()) {
      array.name = name_of_point_array(array.name == normals   ? "Normals"
                                       : array.name == texture ? "TCoords"
                                                               : array.name,
                                       array.width);
    }
    data.add(std::move(array));
  }
  data.end_piece();
}

}  // namespace

MeshFile read_vtk_xml(std::string_view bytes, const std::string& name) {
  VtkXmlReader reader(bytes, name);
  RawMesh raw = reader.read();
  return finish_mesh(std::move(raw), reader.format(), reader.encoding(), name);
}

}  // namespace isorelax
