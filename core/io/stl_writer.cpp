#include <algorithm>
#include <cmath>
#include <limits>

#include "io/attribute_access.h"
#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/stl_layout.h"
#include "io/text_out.h"
#include "io/vertex_merger.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// Unit normal of a triangle; zero for one without area. Scaled first, so that neither very small nor very
/// large triangles lose it.
Vec3 unit_normal(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vec3& a = mesh.positions[triangle[0]];
  const Vec3 u = mesh.positions[triangle[1]] - a;
  const Vec3 v = mesh.positions[triangle[2]] - a;
  const double size = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  const Vec3 normal = size > 0.0 && std::isfinite(size) ? Vec3((u / size).cross(v / size)) : Vec3::Zero();
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
}

const std::string* find_title(const MeshAttributes& attributes) {
  const auto found = std::find_if(attributes.header_lines.begin(), attributes.header_lines.end(),
                                  [](const std::string& line) { return line.starts_with("solid "); });
  return found == attributes.header_lines.end() ? nullptr : &*found;
}

std::string one_line_title(std::string_view title) {
  std::string text(title);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// What any STL file loses: which triangles share a vertex, and vertices without a triangle.
void report_vertices(const TriangleMesh& mesh, std::vector<std::string>& messages) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    used[triangle[0]] = used[triangle[1]] = used[triangle[2]] = true;
  }
  if (const auto isolated = std::count(used.begin(), used.end(), false); isolated > 0) {
    messages.push_back(counted(static_cast<std::size_t>(isolated), "vertex", "vertices") +
                       " in no triangle not written");
  }
  VertexMerger merger(mesh.positions.size());
  for (const Vec3& position : mesh.positions) {
    merger.add(position);
  }
  messages.push_back(
      "the " + counted(mesh.positions.size(), "shared vertex", "shared vertices") + " written as " +
      std::to_string(3 * mesh.triangles.size()) +
      " separate corners: STL does not hold which triangles share a vertex, nor the order of vertices");
  if (merger.size() < mesh.positions.size()) {
    messages.push_back(std::to_string(mesh.positions.size() - merger.size()) +
                       " vertices stand where another does: STL does not tell them apart");
  }
}

EncodedMesh encode_text(const TriangleMesh& mesh) {
  const MeshAttributes& attributes = mesh.attributes;
  WrittenParts written;
  EncodedMesh file;
  const std::string* title = find_title(attributes);
  std::string name;
  if (title != nullptr) {
    name = one_line_title(std::string_view(*title).substr(6));
    written.insert(title);
  }
  const auto groups = std::find_if(attributes.face_labels.begin(), attributes.face_labels.end(),
                                   [](const FaceLabels& labels) { return labels.keyword == "g"; });
  const FaceLabels* solids = groups == attributes.face_labels.end() ? nullptr : &*groups;
  written.insert(solids);
  const auto name_of = [&](std::size_t t) {
    const std::uint32_t label = solids == nullptr ? kNone : solids->face_label[t];
    return label == kNone ? name : one_line_title(solids->labels[label]);
  };
  std::string& out = file.bytes;
  std::string current;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t == 0 || (solids != nullptr && solids->face_label[t] != solids->face_label[t - 1])) {
      out += t == 0 ? "" : "endsolid " + current + "\n";
      current = name_of(t);
      out += "solid " + current + "\n";
    }
    out += "facet normal ";
    append_point(out, unit_normal(mesh, mesh.triangles[t]));
    out += "\n outer loop\n";
    for (const Index vertex : mesh.triangles[t]) {
      out += "  vertex ";
      append_point(out, mesh.positions[vertex]);
      out += '\n';
    }
    out += " endloop\nendfacet\n";
  }
  out += "endsolid " + current + "\n";
  report_vertices(mesh, file.messages);
  for (std::string& line : report_not_written(attributes, written, FileFormat::stl)) {
    file.messages.push_back(std::move(line));
  }
  return file;
}

/// The 80 bytes before the count. A title that is too long, or that begins with "solid" and would let readers
/// take the file for text, is left out and reported.
std::string binary_title(const MeshAttributes& attributes, WrittenParts& written) {
  std::string title;
  if (const std::string* line = find_title(attributes)) {
    title = one_line_title(std::string_view(*line).substr(6));
    if (title.size() <= kStlTitle && !title.starts_with("solid")) {
      written.insert(line);
    } else {
      title.clear();
    }
  }
  title.resize(kStlTitle, '\0');
  return title;
}

EncodedMesh encode_binary(const TriangleMesh& mesh) {
  const MeshAttributes& attributes = mesh.attributes;
  WrittenParts written;
  EncodedMesh file;
  std::string& out = file.bytes;
  out = binary_title(attributes, written);
  const Attribute* color = take_attribute(attributes.face, "stl_attribute", 1, 1, written);
  if (color != nullptr && fitting_type(color->values, ScalarType::uint16) != ScalarType::uint16) {
    written.erase(color);
    color = nullptr;
  }
  append_bytes(out, static_cast<std::uint32_t>(mesh.triangles.size()), std::endian::little);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = unit_normal(mesh, mesh.triangles[t]);
    for (unsigned k = 0; k < 3; ++k) {
      append_bytes(out, static_cast<float>(normal[k]), std::endian::little);
    }
    for (const Index vertex : mesh.triangles[t]) {
      for (unsigned k = 0; k < 3; ++k) {
        append_bytes(out, static_cast<float>(mesh.positions[vertex][k]), std::endian::little);
      }
    }
    append_bytes(out, static_cast<std::uint16_t>(color == nullptr ? 0.0 : color->values[t]),
                 std::endian::little);
  }
  const auto rounded = std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) {
    return !fits(p.x(), ScalarType::float32) || !fits(p.y(), ScalarType::float32) ||
           !fits(p.z(), ScalarType::float32);
  });
  if (rounded > 0) {
    file.messages.push_back(counted(static_cast<std::size_t>(rounded), "vertex", "vertices") +
                            " rounded to single precision: binary STL has no other");
  }
  report_vertices(mesh, file.messages);
  for (std::string& line : report_not_written(attributes, written, FileFormat::stl)) {
    file.messages.push_back(std::move(line));
  }
  return file;
}

}  // namespace

EncodedMesh encode_stl(const TriangleMesh& mesh, FileEncoding encoding) {
  if (encoding == FileEncoding::binary_big_endian) {
    throw UsageError("STL has no big-endian form");
  }
  if (encoding == FileEncoding::text) {
    return encode_text(mesh);
  }
  const bool too_large = std::any_of(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) {
    return p.cwiseAbs().maxCoeff() > static_cast<double>(std::numeric_limits<float>::max());
  });
  if (too_large) {
    throw MeshError(
        "a coordinate is too large for binary STL, which has single precision; text STL holds it");
  }
  return encode_binary(mesh);
}

}  // namespace isorelax
