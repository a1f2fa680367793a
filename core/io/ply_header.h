#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_file.h"
#include "mesh/attributes.h"

namespace isorelax {

/// The name that PLY files use: "uchar", "int", "float", "double" ...
[[nodiscard]] const char* ply_type_name(ScalarType type);

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::float64;
  /// Type of the count that stands before a list; none for a single number.
  std::optional<ScalarType> list_count;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::size_t line = 0;
  std::vector<PlyProperty> properties;

  /// Position of a property in `properties`; none when there is none of that name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
  FileEncoding encoding = FileEncoding::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
  std::vector<std::string> object_information;
  /// Where the data begin.
  std::size_t size = 0;
  std::size_t lines = 0;
};

/// Reads the header of a PLY file. Throws InputError with the line: no end_header, an unknown format or type,
/// two properties of one name, a property before the first element, a count that is no whole number.
[[nodiscard]] PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace isorelax
