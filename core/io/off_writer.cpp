#include "io/attribute_access.h"
#include "io/mesh_file.h"
#include "io/text_out.h"

namespace isorelax {
namespace {

void append_row(std::string& out, const Attribute& attribute, std::size_t element) {
  for (unsigned k = 0; k < attribute.width; ++k) {
    out += ' ';
    append_number(out, attribute.values[element * attribute.width + k]);
  }
}

/// Bytes as whole numbers, anything else with a decimal point: a reader tells them apart by it.
void append_color(std::string& out, const Attribute& color, bool bytes, std::size_t element) {
  for (unsigned k = 0; k < color.width; ++k) {
    const double value = color.values[element * color.width + k];
    out += ' ';
    if (bytes) {
      append_number(out, value);
    } else {
      append_fraction(out, value);
    }
  }
}

}  // namespace

EncodedMesh encode_off(const TriangleMesh& mesh) {
  const MeshAttributes& attributes = mesh.attributes;
  WrittenParts written{&attributes.comments};
  const auto normal = take_vertex_attribute(mesh, "normal", 3, 3, written);
  const auto color = take_vertex_attribute(mesh, "color", 3, 4, written);
  const auto texture = take_vertex_attribute(mesh, "texcoord", 2, 2, written);
  const Attribute* face_color = take_attribute(attributes.face, "color", 3, 4, written);
  const Attribute* color_index =
      face_color != nullptr ? nullptr : take_attribute(attributes.face, "color_index", 1, 1, written);
  const bool bytes = color && is_byte_color(*color);
  const bool face_bytes = face_color != nullptr && is_byte_color(*face_color);

  EncodedMesh file;
  std::string& out = file.bytes;
  out += std::string(texture ? "ST" : "") + (color ? "C" : "") + (normal ? "N" : "") + "OFF\n";
  append_lines(out, "# ", attributes.comments);
  append_integer(out, mesh.positions.size());
  out += ' ';
  append_integer(out, mesh.triangles.size());
  out += " 0\n";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    append_point(out, mesh.positions[v]);
    if (normal) {
      append_row(out, *normal, v);
    }
    if (color) {
      append_color(out, *color, bytes, v);
    }
    if (texture) {
      append_row(out, *texture, v);
    }
    out += '\n';
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out += '3';
    for (const Index vertex : mesh.triangles[t]) {
      out += ' ';
      append_integer(out, vertex);
    }
    if (face_color != nullptr) {
      append_color(out, *face_color, face_bytes, t);
    }
    if (color_index != nullptr) {
      append_row(out, *color_index, t);
    }
    out += '\n';
  }
  file.messages = report_not_written(attributes, written, FileFormat::off);
  return file;
}

}  // namespace isorelax
