#include "cli/mesh_input.h"

#include "cli/console.h"

namespace isorelax::cli {

MeshFile read_input_file(Console& console, const std::string& path) {
  MeshFile file = read_mesh(path);
  const std::string prefix = path + ": ";
  for (const std::string& message : file.messages) console.message(prefix + message);
  return file;
}

TriangleMesh read_input(Console& console, const std::string& path) {
  return std::move(read_input_file(console, path).mesh);
}

}  // namespace isorelax::cli
