#pragma once

#include <string>
#include <vector>

#include "io/attribute_access.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// What VTK's writers put out beside the geometry: arrays under the names they have in a file, each with a
/// type that holds all its values.
struct VtkArraysOut {
  ScalarType position_type = ScalarType::float64;
  std::vector<Attribute> point;
  /// One row for each point beside the triangles, each line, each triangle.
  std::vector<Attribute> cell;
};

/// Collects them, marks in `written` where they come from, and says in `messages` what had to change.
/// `holds`: whether the format can hold such a name.
[[nodiscard]] VtkArraysOut vtk_arrays_out(const TriangleMesh& mesh, bool (*holds)(std::string_view name),
                                          WrittenParts& written, std::vector<std::string>& messages);

}  // namespace isorelax
