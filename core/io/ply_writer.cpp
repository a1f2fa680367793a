#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "io/attribute_access.h"
#include "io/mesh_file.h"
#include "io/ply_columns.h"
#include "io/scalar_bytes.h"
#include "io/text_out.h"
#include "io/text_scanner.h"

namespace isorelax {
namespace {

/// An attribute on its way out: where its values are and the type that holds them.
struct Column {
  const std::vector<double>* values;
  unsigned width;
  ScalarType type;
};

/// PLY has no integers of 64 bits: those that a mesh holds are doubles as well.
ScalarType kept_in_ply(ScalarType type) {
  const bool is_wide = type == ScalarType::int64 || type == ScalarType::uint64;
  return is_wide ? ScalarType::float64 : type;
}

class PlyWriter {
 public:
  PlyWriter(const TriangleMesh& mesh, FileEncoding encoding)
      : mesh_(mesh),
        text_(encoding == FileEncoding::text),
        order_(encoding == FileEncoding::binary_big_endian ? std::endian::big : std::endian::little),
        written_{&mesh.attributes.comments} {
    out_ = std::string("ply\nformat ") +
           (text_                        ? "ascii"
            : order_ == std::endian::big ? "binary_big_endian"
                                         : "binary_little_endian") +
           " 1.0\n";
  }

  EncodedMesh write() {
    describe_file();
    describe_vertices();
    describe_faces();
    out_ += "end_header\n";
    write_vertices();
    write_faces();
    for (std::string& line : report_not_written(mesh_.attributes, written_, FileFormat::ply)) {
      messages_.push_back(std::move(line));
    }
    return {std::move(out_), std::move(messages_)};
  }

 private:
  void describe_file();
  void describe_vertices();
  void describe_faces();
  void describe_attribute(const Attribute& attribute, const std::string& element,
                          std::set<std::string>& names, std::vector<Column>& columns);
  void describe_texture();
  void write_vertices();
  void write_faces();
  void write_texture(std::size_t triangle);
  void put(double value, ScalarType type);
  void put_row(const Column& column, std::size_t row);
  void end_row();

  const TriangleMesh& mesh_;
  bool text_;
  std::endian order_;
  WrittenParts written_;
  std::string out_;
  std::vector<std::string> messages_;
  ScalarType position_type_ = ScalarType::float64;
  std::vector<Attribute> from_corners_;
  std::vector<Column> vertex_columns_;
  std::vector<Column> face_columns_;
  ScalarType index_type_ = ScalarType::int32;
  const CornerAttribute* texture_ = nullptr;
  ScalarType texture_type_ = ScalarType::float32;
};

void PlyWriter::describe_file() {
  append_lines(out_, "comment ", mesh_.attributes.comments);
  for (const std::string& line : mesh_.attributes.header_lines) {
    if (line.starts_with("obj_info ")) {
      append_lines(out_, "obj_info ", {line.substr(9)});
      written_.insert(&line);
    }
  }
}

void PlyWriter::describe_attribute(const Attribute& attribute, const std::string& element,
                                   std::set<std::string>& names, std::vector<Column>& columns) {
  const std::vector<std::string> own = ply_names(attribute);
  const bool free = std::none_of(own.begin(), own.end(), [&](const std::string& name) {
    return names.contains(name) || name.empty() || name.find_first_of(" \t\v\f\r\n") != std::string::npos;
  });
  if (!free) {
    return;
  }
  const ScalarType wished = kept_in_ply(attribute.type);
  const ScalarType type = fitting_type(attribute.values, wished);
  if (type != wished) {
    messages_.push_back(element + " attribute " + in_quotes(attribute.name) +
                        " written as double: " + ply_type_name(wished) + " does not hold its values");
  }
  for (const std::string& name : own) {
    out_ += std::string("property ") + ply_type_name(type) + " " + name + "\n";
    names.insert(name);
  }
  columns.push_back({&attribute.values, attribute.width, type});
  written_.insert(&attribute);
}

void PlyWriter::describe_vertices() {
  const ScalarType wished = kept_in_ply(mesh_.attributes.position_type);
  const bool fits_all = std::all_of(mesh_.positions.begin(), mesh_.positions.end(), [&](const Vec3& p) {
    return fits(p.x(), wished) && fits(p.y(), wished) && fits(p.z(), wished);
  });
  position_type_ = fits_all ? wished : ScalarType::float64;
  if (!fits_all) {
    messages_.push_back(std::string("positions written as double: the ") + ply_type_name(wished) +
                        " of their file does not hold them");
  }
  out_ += "element vertex " + std::to_string(mesh_.positions.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    out_ += std::string("property ") + ply_type_name(position_type_) + " " + axis + "\n";
  }
  std::set<std::string> names{"x", "y", "z"};
  for (const Attribute& attribute : mesh_.attributes.vertex) {
    describe_attribute(attribute, "vertex", names, vertex_columns_);
  }
  // Normals of corners have no place of their own; where all corners of a vertex agree they are its normal.
  if (!names.contains("nx")) {
    if (const auto normal = take_vertex_attribute(mesh_, "normal", 3, 3, written_)) {
      from_corners_.push_back(*normal);
      describe_attribute(from_corners_.back(), "vertex", names, vertex_columns_);
    }
  }
}

void PlyWriter::describe_faces() {
  const bool needs_unsigned = mesh_.positions.size() > std::numeric_limits<std::int32_t>::max();
  index_type_ = needs_unsigned ? ScalarType::uint32 : ScalarType::int32;
  out_ += "element face " + std::to_string(mesh_.triangles.size()) + "\nproperty list uchar " +
          ply_type_name(index_type_) + " vertex_indices\n";
  std::set<std::string> names{"vertex_indices", "vertex_index", "texcoord"};
  describe_texture();
  for (const Attribute& attribute : mesh_.attributes.face) {
    describe_attribute(attribute, "face", names, face_columns_);
  }
}

void PlyWriter::describe_texture() {
  for (const CornerAttribute& corner : mesh_.attributes.corner) {
    if (corner.name == "texcoord" && corner.width == 2 && texture_ == nullptr) {
      texture_ = &corner;
      texture_type_ = fitting_type(corner.values, ScalarType::float32);
      out_ += std::string("property list uchar ") + ply_type_name(texture_type_) + " texcoord\n";
      written_.insert(&corner);
    }
  }
}

void PlyWriter::put(double value, ScalarType type) {
  if (!text_) {
    return append_scalar(out_, value, type, order_);
  }
  append_scalar_text(out_, value, type);
  out_ += ' ';
}

void PlyWriter::put_row(const Column& column, std::size_t row) {
  for (unsigned k = 0; k < column.width; ++k) {
    put((*column.values)[row * column.width + k], column.type);
  }
}

void PlyWriter::end_row() {
  if (text_) {
    out_.back() = '\n';
  }
}

void PlyWriter::write_vertices() {
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    for (unsigned k = 0; k < 3; ++k) {
      put(mesh_.positions[v][k], position_type_);
    }
    for (const Column& column : vertex_columns_) {
      put_row(column, v);
    }
    end_row();
  }
}

void PlyWriter::write_texture(std::size_t triangle) {
  const std::uint32_t* index = &texture_->indices[3 * triangle];
  if (index[0] == kNone || index[1] == kNone || index[2] == kNone) {
    put(0.0, ScalarType::uint8);
    return;
  }
  put(6.0, ScalarType::uint8);
  for (unsigned k = 0; k < 6; ++k) {
    put(texture_->values[2 * std::size_t{index[k / 2]} + k % 2], texture_type_);
  }
}

void PlyWriter::write_faces() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    put(3.0, ScalarType::uint8);
    for (const Index vertex : mesh_.triangles[t]) {
      put(vertex, index_type_);
    }
    if (texture_ != nullptr) {
      write_texture(t);
    }
    for (const Column& column : face_columns_) {
      put_row(column, t);
    }
    end_row();
  }
}

}  // namespace

EncodedMesh encode_ply(const TriangleMesh& mesh, FileEncoding encoding) {
  return PlyWriter(mesh, encoding).write();
}

}  // namespace isorelax
