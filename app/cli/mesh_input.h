#pragma once

#include <string>

#include "io/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace isorelax::cli {

class Console;

/// Reads a mesh and prints what its reader has to say, each message after the name of the file.
/// Throws InputError.
[[nodiscard]] TriangleMesh read_input(Console& console, const std::string& path);
/// The same with what is known of the file.
[[nodiscard]] MeshFile read_input_file(Console& console, const std::string& path);

}  // namespace isorelax::cli
