#include "cli/mesh_input.h"

#include "cli/console.h"
#include "io/mesh_file.h"

namespace isorelax::cli {

TriangleMesh read_input(Console& console, const std::string& path) {
  MeshFile file = read_mesh(path);
  for (const std::string& message : file.messages) console.message(path + ": " + message);
  return std::move(file.mesh);
}

}  // namespace isorelax::cli
