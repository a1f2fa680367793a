#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace isorelax::cli {

class Console;

/// Reads a mesh and prints what its reader has to say, each message after the name of the file.
/// Throws InputError.
[[nodiscard]] TriangleMesh read_input(Console& console, const std::string& path);

}  // namespace isorelax::cli
