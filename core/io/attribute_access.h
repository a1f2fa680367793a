#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Whether `value`, stored as `type` and read back, is the same bit for bit (any NaN counts as any other).
[[nodiscard]] bool fits(double value, ScalarType type);

/// `wished` when it holds every value exactly, else float64.
[[nodiscard]] ScalarType fitting_type(const std::vector<double>& values, ScalarType wished);

/// The parts of MeshAttributes that a writer has put out; the rest is reported.
using WrittenParts = std::set<const void*>;

/// Finds an attribute by name and a width from `least` to `most`, and marks it as written; null when there is
/// none.
[[nodiscard]] const Attribute* take_attribute(const std::vector<Attribute>& attributes,
                                              const std::string& name, unsigned least, unsigned most,
                                              WrittenParts& written);

/// Same for vertices; where there is no such vertex attribute, a corner attribute whose corners agree at
/// every vertex serves.
[[nodiscard]] std::optional<Attribute> take_vertex_attribute(const TriangleMesh& mesh,
                                                             const std::string& name, unsigned least,
                                                             unsigned most, WrittenParts& written);

/// One line for each attribute, label, comment and header line that is not in `written`. Comments are
/// marked by the address of their vector, header lines one by one.
[[nodiscard]] std::vector<std::string> report_not_written(const MeshAttributes& attributes,
                                                          const WrittenParts& written, FileFormat format);

/// Colours in a form that text formats share: bytes when all are whole numbers 0 .. 255 of an integer type.
[[nodiscard]] bool is_byte_color(const Attribute& color);

}  // namespace isorelax
