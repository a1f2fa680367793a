#include <array>
#include <cstdint>
#include <span>

#include "io/attribute_access.h"
#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/scalar_bytes.h"
#include "io/text_out.h"
#include "io/vtk_names.h"
#include "io/vtk_numbers.h"
#include "io/vtk_out.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// Cells of one number of corners, which follow each other in the mesh.
struct CellGroup {
  const char* element;
  unsigned type;
  unsigned corners;
  std::span<const Index> vertices;

  [[nodiscard]] std::size_t count() const { return vertices.size() / corners; }
};

/// Writes arrays as text in their elements, or all of them one after another into AppendedData, each behind
/// its size in bytes.
class VtkXmlWriter {
 public:
  VtkXmlWriter(const TriangleMesh& mesh, FileFormat format, bool text)
      : mesh_(mesh),
        format_(format),
        text_(text),
        groups_{{{"Verts", 1, 1, mesh.attributes.points.vertices},
                 {"Lines", 3, 2, mesh.attributes.lines.vertices},
                 {"Polys", 5, 3, {mesh.triangles.data()->data(), 3 * mesh.triangles.size()}}}} {}

  EncodedMesh write();

 private:
  void put_comments();
  void put_data(const char* element, const std::vector<Attribute>& arrays);
  void put_points();
  void put_cells(std::span<const CellGroup> groups, bool with_types);
  void begin_array(const char* type, const std::string& name, std::size_t width, std::uint64_t bytes);
  void put(double value, ScalarType type, bool ends_row);
  void put_index(std::uint64_t value, bool ends_row);
  void end_array();

  const TriangleMesh& mesh_;
  FileFormat format_;
  bool text_;
  std::array<CellGroup, 3> groups_;
  VtkArraysOut arrays_;
  WrittenParts written_;
  std::string out_;
  std::string appended_;
  std::vector<std::string> messages_;
};

/// Comments of XML hold no two hyphens in a row, nor one at the end.
void VtkXmlWriter::put_comments() {
  std::size_t left_out = 0;
  for (const std::string& comment : mesh_.attributes.comments) {
    if (comment.find("--") != std::string::npos || !is_xml_text(comment)) {
      ++left_out;
    } else {
      out_ += "<!-- " + comment + " -->\n";
    }
  }
  written_.insert(&mesh_.attributes.comments);
  if (left_out > 0) {
    messages_.push_back(counted(left_out, "comment", "comments") +
                        " not written: XML has no comment with -- or control bytes in it");
  }
}

void VtkXmlWriter::begin_array(const char* type, const std::string& name, std::size_t width,
                               std::uint64_t bytes) {
  out_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + escape_xml(name) +
          "\" NumberOfComponents=\"" + std::to_string(width);
  if (text_) {
    out_ += "\" format=\"ascii\">\n";
    return;
  }
  out_ += "\" format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
  append_bytes(appended_, bytes, std::endian::little);
}

void VtkXmlWriter::put(double value, ScalarType type, bool ends_row) {
  if (!text_) {
    return append_scalar(appended_, value, type, std::endian::little);
  }
  append_scalar_text(out_, value, type);
  out_ += ends_row ? '\n' : ' ';
}

void VtkXmlWriter::put_index(std::uint64_t value, bool ends_row) {
  if (!text_) {
    return append_bytes(appended_, value, std::endian::little);
  }
  append_integer(out_, value);
  out_ += ends_row ? '\n' : ' ';
}

void VtkXmlWriter::end_array() {
  out_ += text_ ? "</DataArray>\n" : "";
}

void VtkXmlWriter::put_data(const char* element, const std::vector<Attribute>& arrays) {
  out_ += std::string("<") + element;
  for (const Attribute& array : arrays) {
    if (&arrays == &arrays_.point && name_of_point_array(array.name, array.width) == "normal") {
      out_ += " Normals=\"Normals\"";
    } else if (&arrays == &arrays_.point && name_of_point_array(array.name, array.width) == "texcoord") {
      out_ += " TCoords=\"TCoords\"";
    }
  }
  out_ += ">\n";
  for (const Attribute& array : arrays) {
    begin_array(xml_vtk_name(array.type), array.name, array.width, array.values.size() * size_of(array.type));
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      put(array.values[i], array.type, i % array.width + 1 == array.width);
    }
    end_array();
  }
  out_ += std::string("</") + element + ">\n";
}

void VtkXmlWriter::put_points() {
  const ScalarType type = arrays_.position_type;
  out_ += "<Points>\n";
  begin_array(xml_vtk_name(type), "Points", 3, 3 * mesh_.positions.size() * size_of(type));
  for (const Vec3& position : mesh_.positions) {
    for (unsigned k = 0; k < 3; ++k) {
      put(position[k], type, k == 2);
    }
  }
  end_array();
  out_ += "</Points>\n";
}

/// The vertices of all cells, where each cell ends, and in an unstructured grid the type of each.
void VtkXmlWriter::put_cells(std::span<const CellGroup> groups, bool with_types) {
  std::size_t vertices = 0;
  std::size_t cells = 0;
  for (const CellGroup& group : groups) {
    vertices += group.vertices.size();
    cells += group.count();
  }
  begin_array("Int64", "connectivity", 1, vertices * sizeof(std::uint64_t));
  for (const CellGroup& group : groups) {
    for (std::size_t i = 0; i < group.vertices.size(); ++i) {
      put_index(group.vertices[i], i % group.corners + 1 == group.corners);
    }
  }
  end_array();
  begin_array("Int64", "offsets", 1, cells * sizeof(std::uint64_t));
  std::uint64_t end = 0;
  for (const CellGroup& group : groups) {
    for (std::size_t i = 0; i < group.count(); ++i) {
      end += group.corners;
      put_index(end, true);
    }
  }
  end_array();
  if (!with_types) {
    return;
  }
  begin_array("UInt8", "types", 1, cells);
  for (const CellGroup& group : groups) {
    for (std::size_t i = 0; i < group.count(); ++i) {
      put(group.type, ScalarType::uint8, true);
    }
  }
  end_array();
}

EncodedMesh VtkXmlWriter::write() {
  const bool polygonal = format_ == FileFormat::vtp;
  const std::string type = polygonal ? "PolyData" : "UnstructuredGrid";
  arrays_ = vtk_arrays_out(
      mesh_, [](std::string_view name) { return !name.empty() && is_xml_text(name); }, written_, messages_);
  out_ = "<?xml version=\"1.0\"?>\n";
  put_comments();
  out_ += "<VTKFile type=\"" + type +
          "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + type +
          ">\n<Piece NumberOfPoints=\"" + std::to_string(mesh_.positions.size());
  if (polygonal) {
    for (const CellGroup& group : groups_) {
      out_ += std::string("\" NumberOf") + group.element + "=\"" + std::to_string(group.count());
    }
    out_ += "\" NumberOfStrips=\"0";
  } else {
    out_ +=
        "\" NumberOfCells=\"" + std::to_string(groups_[0].count() + groups_[1].count() + groups_[2].count());
  }
  out_ += "\">\n";
  put_data("PointData", arrays_.point);
  put_data("CellData", arrays_.cell);
  put_points();
  for (const CellGroup& group : groups_) {
    if (polygonal) {
      out_ += std::string("<") + group.element + ">\n";
      put_cells({&group, 1}, false);
      out_ += std::string("</") + group.element + ">\n";
    }
  }
  if (!polygonal) {
    out_ += "<Cells>\n";
    put_cells(groups_, true);
    out_ += "</Cells>\n";
  }
  out_ += "</Piece>\n</" + type + ">\n";
  if (!text_) {
    out_ += "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n";
  }
  out_ += "</VTKFile>\n";
  for (std::string& line : report_not_written(mesh_.attributes, written_, format_)) {
    messages_.push_back(std::move(line));
  }
  return {std::move(out_), std::move(messages_)};
}

EncodedMesh encode_vtk_xml(const TriangleMesh& mesh, FileFormat format, FileEncoding encoding) {
  if (encoding == FileEncoding::binary_big_endian) {
    throw UsageError(std::string(format_name(format)) + " is not written big endian");
  }
  return VtkXmlWriter(mesh, format, encoding == FileEncoding::text).write();
}

}  // namespace

EncodedMesh encode_vtp(const TriangleMesh& mesh, FileEncoding encoding) {
  return encode_vtk_xml(mesh, FileFormat::vtp, encoding);
}

EncodedMesh encode_vtu(const TriangleMesh& mesh, FileEncoding encoding) {
  return encode_vtk_xml(mesh, FileFormat::vtu, encoding);
}

}  // namespace isorelax
