#include <algorithm>
#include <cmath>
#include <span>

#include "io/attribute_access.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/scalar_bytes.h"
#include "io/text_scanner.h"
#include "io/vtk_names.h"
#include "io/vtk_numbers.h"
#include "io/vtk_out.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// Writes the layout of version 3.0, which all programs read.
class VtkWriter {
 public:
  VtkWriter(const TriangleMesh& mesh, bool text) : mesh_(mesh), text_(text) {}

  EncodedMesh write();

 private:
  std::string title();
  void put(double value, ScalarType type);
  void end_row();
  void put_cells(const char* keyword, std::span<const Index> vertices, std::size_t corners);
  void put_values(const Attribute& array);
  static std::string keyword_line(const Attribute& array, bool of_points);
  void put_data(const char* keyword, std::size_t rows, const std::vector<Attribute>& arrays);

  const TriangleMesh& mesh_;
  bool text_;
  VtkArraysOut arrays_;
  WrittenParts written_;
  std::string out_;
  std::vector<std::string> messages_;
};

/// The one line that a file has for a comment: the first one, where it is read back as it is.
std::string VtkWriter::title() {
  static constexpr std::size_t kLongest = 255;
  static constexpr std::string_view kBlanks = " \t\v\f";
  const std::vector<std::string>& comments = mesh_.attributes.comments;
  if (comments.empty() || comments[0].size() > kLongest || is_default_vtk_title(comments[0]) ||
      comments[0].find_first_of("\r\n") != std::string::npos ||
      kBlanks.find(comments[0].front()) != std::string_view::npos ||
      kBlanks.find(comments[0].back()) != std::string_view::npos) {
    return "vtk output";
  }
  written_.insert(&comments);
  if (comments.size() > 1) {
    messages_.push_back(counted(comments.size() - 1, "comment", "comments") +
                        " not written: VTK has one line for a title");
  }
  return comments[0];
}

void VtkWriter::put(double value, ScalarType type) {
  if (!text_) {
    return append_scalar(out_, value, type, std::endian::big);
  }
  append_scalar_text(out_, value, type);
  out_ += ' ';
}

void VtkWriter::end_row() {
  if (text_) {
    out_.back() = '\n';
  }
}

void VtkWriter::put_cells(const char* keyword, std::span<const Index> vertices, std::size_t corners) {
  const std::size_t count = vertices.size() / corners;
  if (count == 0) {
    return;
  }
  out_ += std::string(keyword) + " " + std::to_string(count) + " " + std::to_string(vertices.size() + count) +
          "\n";
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i % corners == 0) {
      put(static_cast<double>(corners), ScalarType::int32);
    }
    put(vertices[i], ScalarType::int32);
    if (i % corners + 1 == corners) {
      end_row();
    }
  }
  out_ += text_ ? "" : "\n";
}

void VtkWriter::put_values(const Attribute& array) {
  std::size_t not_finite = 0;
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    const bool possible = !text_ || std::isfinite(array.values[i]);
    not_finite += possible ? 0 : 1;
    put(possible ? array.values[i] : 0.0, array.type);
    if (i % array.width + 1 == array.width) {
      end_row();
    }
  }
  out_ += text_ ? "" : "\n";
  if (not_finite > 0) {
    messages_.push_back(counted(not_finite, "value", "values") + " of the array " + in_quotes(array.name) +
                        " not finite, written as 0: VTK reads no other numbers from text, but from binary");
  }
}

/// What stands before the numbers of an array that the format has a keyword of its own for; empty for others.
std::string VtkWriter::keyword_line(const Attribute& array, bool of_points) {
  const std::string meaning = of_points ? name_of_point_array(array.name, array.width) : "";
  const std::string type = std::string(" ") + legacy_vtk_name(array.type) + "\n";
  if (meaning == "normal") {
    return "NORMALS Normals" + type;
  }
  return meaning == "texcoord" ? "TEXTURE_COORDINATES TCoords " + std::to_string(array.width) + type : "";
}

void VtkWriter::put_data(const char* keyword, std::size_t rows, const std::vector<Attribute>& arrays) {
  if (arrays.empty()) {
    return;
  }
  out_ += std::string(keyword) + " " + std::to_string(rows) + "\n";
  const bool of_points = &arrays == &arrays_.point;
  const auto has_keyword = [&](const Attribute& array) { return !keyword_line(array, of_points).empty(); };
  for (auto array = arrays.begin(); array != arrays.end();) {
    if (has_keyword(*array)) {
      out_ += keyword_line(*array, of_points);
      put_values(*array);
      ++array;
      continue;
    }
    // All others up to the next with a keyword stand in one FIELD.
    const auto end = std::find_if(array, arrays.end(), has_keyword);
    out_ += "FIELD FieldData " + std::to_string(end - array) + "\n";
    for (; array != end; ++array) {
      out_ += encode_vtk_name(array->name) + " " + std::to_string(array->width) + " " + std::to_string(rows) +
              " " + legacy_vtk_name(array->type) + "\n";
      put_values(*array);
    }
  }
}

EncodedMesh VtkWriter::write() {
  out_ = "# vtk DataFile Version 3.0\n" + title() + (text_ ? "\nASCII" : "\nBINARY") + "\nDATASET POLYDATA\n";
  arrays_ = vtk_arrays_out(
      mesh_, [](std::string_view name) { return !name.empty(); }, written_, messages_);
  out_ += "POINTS " + std::to_string(mesh_.positions.size()) + " " + legacy_vtk_name(arrays_.position_type) +
          "\n";
  for (const Vec3& position : mesh_.positions) {
    for (unsigned k = 0; k < 3; ++k) {
      put(position[k], arrays_.position_type);
    }
    end_row();
  }
  out_ += text_ ? "" : "\n";
  const MeshAttributes& attributes = mesh_.attributes;
  put_cells("VERTICES", attributes.points.vertices, 1);
  put_cells("LINES", attributes.lines.vertices, 2);
  put_cells("POLYGONS", {mesh_.triangles.data()->data(), 3 * mesh_.triangles.size()}, 3);
  put_data("POINT_DATA", mesh_.positions.size(), arrays_.point);
  put_data("CELL_DATA", attributes.points.count() + attributes.lines.count() + mesh_.triangles.size(),
           arrays_.cell);
  for (std::string& line : report_not_written(attributes, written_, FileFormat::vtk)) {
    messages_.push_back(std::move(line));
  }
  return {std::move(out_), std::move(messages_)};
}

}  // namespace

EncodedMesh encode_vtk(const TriangleMesh& mesh, FileEncoding encoding) {
  if (encoding == FileEncoding::binary_little_endian) {
    throw UsageError("legacy VTK has no little-endian form");
  }
  return VtkWriter(mesh, encoding == FileEncoding::text).write();
}

}  // namespace isorelax
