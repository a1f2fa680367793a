#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isorelax {

/// Scalar type an attribute had in its file, so that it is written back as it was.
enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Values attached to every vertex or every triangle: `width` numbers per element, element by element.
/// Names with a meaning across formats: "normal" (3), "color" (3 or 4; uint8 0..255 or float 0..1),
/// "texcoord" (2 or 3). Any other name is a format's own (a PLY property) and is kept as it stands.
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

/// A label per triangle from a small list: OBJ's g, o, usemtl and s. labels[face_label[t]]; 0xffffffff is
/// "none".
struct FaceLabels {
  std::string keyword;
  std::vector<std::string> labels;
  std::vector<std::uint32_t> face_label;
};

/// What a file said about its mesh beyond positions and triangles. Kept through load, smoothing and save.
struct MeshAttributes {
  std::vector<Attribute> vertex;
  std::vector<Attribute> face;
  std::vector<CornerAttribute> corner;
  std::vector<FaceLabels> face_labels;
  /// Text without the format's comment sign, in file order.
  std::vector<std::string> comments;
  /// Format's own header lines worth keeping: OBJ "mtllib x.mtl", the name of an STL solid.
  std::vector<std::string> header_lines;
};

}  // namespace isorelax
