#include "io/vtk_out.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "io/cells.h"
#include "io/text_scanner.h"
#include "io/vtk_names.h"
#include "io/vtk_numbers.h"

namespace isorelax {
namespace {

bool fits_everywhere(const std::vector<Vec3>& positions, ScalarType type) {
  return std::all_of(positions.begin(), positions.end(), [&](const Vec3& p) {
    return fits(p.x(), type) && fits(p.y(), type) && fits(p.z(), type);
  });
}

void widen(Attribute& array, const char* element, std::vector<std::string>& messages) {
  const ScalarType type = fitting_type(array.values, array.type);
  if (type != array.type) {
    messages.push_back(std::string(element) + " array " + in_quotes(array.name) +
                       " written as double: " + legacy_vtk_name(array.type) + " does not hold its values");
  }
  array.type = type;
}

}  // namespace

VtkArraysOut vtk_arrays_out(const TriangleMesh& mesh, bool (*holds)(std::string_view name),
                            WrittenParts& written, std::vector<std::string>& messages) {
  const MeshAttributes& attributes = mesh.attributes;
  VtkArraysOut out;
  if (attributes.position_type == ScalarType::float32) {
    if (fits_everywhere(mesh.positions, ScalarType::float32)) {
      out.position_type = ScalarType::float32;
    } else {
      messages.emplace_back("positions written as double: float does not hold them");
    }
  }
  std::set<std::string> names;
  const auto add_point_array = [&](Attribute array) {
    array.name = point_array_name(array.name, array.width);
    widen(array, "point", messages);
    out.point.push_back(std::move(array));
  };
  for (const Attribute& attribute : attributes.vertex) {
    if (holds(attribute.name) && names.insert(point_array_name(attribute.name, attribute.width)).second) {
      add_point_array(attribute);
      written.insert(&attribute);
    }
  }
  for (const auto& [name, least, most] : {std::tuple{"normal", 3U, 3U}, {"texcoord", 2U, 3U}}) {
    if (!names.contains(point_array_name(name, most))) {
      if (auto from_corners = take_vertex_attribute(mesh, name, least, most, written)) {
        add_point_array(std::move(*from_corners));
      }
    }
  }
  names.clear();
  for (Attribute& array : cell_values(mesh, messages)) {
    if (!holds(array.name) || !names.insert(array.name).second) {
      messages.push_back("cell array " + in_quotes(array.name) +
                         " not written: its name is not possible here, or stands twice");
      continue;
    }
    widen(array, "cell", messages);
    out.cell.push_back(std::move(array));
  }
  written.insert({&attributes.points, &attributes.lines});
  for (const auto* values : {&attributes.face, &attributes.points.values, &attributes.lines.values}) {
    // A second array of the same name and width was passed over, and is reported.
    std::set<std::pair<std::string_view, unsigned>> merged;
    for (const Attribute& attribute : *values) {
      if (merged.emplace(attribute.name, attribute.width).second) {
        written.insert(&attribute);
      }
    }
  }
  return out;
}

}  // namespace isorelax
