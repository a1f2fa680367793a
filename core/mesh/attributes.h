#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isorelax {

/// Names of the groups of elements, as MSH files have them: the first one that a user gave it, and the
/// geometric entity that it lies on.
inline constexpr const char* kPhysicalGroup = "gmsh:physical";
inline constexpr const char* kGeometricEntity = "gmsh:geometrical";

/// Scalar type an attribute had in its file, so that it is written back as it was. Integers of 64 bits are
/// known to VTK only.
enum class ScalarType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64,
  int64,
  uint64
};

/// Values attached to every vertex or every triangle: `width` numbers per element, element by element.
/// Names with a meaning across formats, at the widths given: "normal" (3), "color" (3 or 4; uint8 0..255 or
/// float 0..1), "texcoord" (2 or 3), "weight" (1, of an OBJ vertex), "color_index" (1, of an OFF face),
/// "stl_attribute" (1, uint16, of an STL facet), "gmsh:physical" and "gmsh:geometrical" (1, int32: the groups
/// and the entity of a MSH element). Any other name is a format's own (a PLY property, an array of VTK) and
/// is kept as it stands.
struct Attribute {
  std::string name;
  ScalarType type = ScalarType::float64;
  unsigned width = 1;
  std::vector<double> values;
};

/// Values attached to triangle corners through an index (OBJ's vt and vn): corner c of triangle t has
/// values[width * indices[3 t + c]], or none where the index is 0xffffffff.
struct CornerAttribute {
  std::string name;
  unsigned width = 2;
  std::vector<double> values;
  std::vector<std::uint32_t> indices;
};

/// Elements of lower dimension that stand beside the triangles, as the named borders of a MSH file do: points
/// (one corner) or lines (two). `values` have one row for each, under the names that the triangles' have.
struct LowerElements {
  unsigned corners = 1;
  std::vector<std::uint32_t> vertices;
  std::vector<Attribute> values;

  [[nodiscard]] std::size_t count() const { return vertices.size() / corners; }
};

/// A label per triangle from a small list: OBJ's g, o, usemtl and s. labels[face_label[t]]; 0xffffffff is
/// "none". The solids of an STL file are labels of the keyword "g".
struct FaceLabels {
  std::string keyword;
  std::vector<std::string> labels;
  std::vector<std::uint32_t> face_label;
};

/// What a file said about its mesh beyond positions and triangles. Kept through load, smoothing and save.
struct MeshAttributes {
  /// Type that positions had in their file: a format with types writes them so again, where that loses
  /// nothing.
  ScalarType position_type = ScalarType::float64;
  std::vector<Attribute> vertex;
  std::vector<Attribute> face;
  std::vector<CornerAttribute> corner;
  std::vector<FaceLabels> face_labels;
  LowerElements points{1, {}, {}};
  LowerElements lines{2, {}, {}};
  /// Text without the format's comment sign, in file order.
  std::vector<std::string> comments;
  /// Format's own header lines, first word first: OBJ "mtllib x.mtl", PLY "obj_info ...", STL "solid NAME".
  std::vector<std::string> header_lines;
};

}  // namespace isorelax
