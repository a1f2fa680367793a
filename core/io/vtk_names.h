#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace isorelax {

[[nodiscard]] std::string vtk_lower_case(std::string_view word);

/// Whether the title of a legacy file is one that a program puts there by itself: "vtk output", "vtk file",
/// "written by ...", or nothing. It says nothing about the mesh.
[[nodiscard]] bool is_default_vtk_title(std::string_view title);

/// Names in legacy files: bytes that would end a word there stand as %XX.
[[nodiscard]] std::string decode_vtk_name(std::string_view word);
[[nodiscard]] std::string encode_vtk_name(std::string_view name);

/// The name of an attribute of the vertices for an array of the points, and back: VTK's usual "Normals" and
/// "TCoords" have a meaning across formats.
[[nodiscard]] std::string name_of_point_array(const std::string& name, std::uint64_t width);
[[nodiscard]] std::string point_array_name(const std::string& name, unsigned width);

/// Whether XML can hold the text: UTF-8 without control bytes.
[[nodiscard]] bool is_xml_text(std::string_view text);
/// The text between quotes of an XML attribute. Precondition: is_xml_text.
[[nodiscard]] std::string escape_xml(std::string_view text);

}  // namespace isorelax
