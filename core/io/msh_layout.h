#pragma once

#include <cstdint>
#include <optional>

namespace isorelax {

/// What an element type of Gmsh is, by its number.
struct MshElementType {
  unsigned nodes = 0;
  unsigned dimension = 0;
  unsigned order = 1;
};

/// None for a number that Gmsh does not give to a type of a fixed number of nodes.
[[nodiscard]] std::optional<MshElementType> msh_element_type(std::int64_t number);

inline constexpr int kMshLine = 1;
inline constexpr int kMshTriangle = 2;
inline constexpr int kMshPoint = 15;

/// Name of a node's number, where nodes are not numbered 1, 2, 3, ...
inline constexpr const char* kMshNode = "gmsh:node";
/// The physical group and the geometric entity of an element where nothing is known.
inline constexpr double kMshNoGroup = 0;
inline constexpr double kMshOnlyEntity = 1;
/// How a name of a group stands among the header lines: behind this word, as in the file.
inline constexpr const char* kMshNames = "$PhysicalNames ";

}  // namespace isorelax
