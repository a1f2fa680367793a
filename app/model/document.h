#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "mesh/topology.h"
#include "mesh/triangle_mesh.h"
#include "motion/motion_choices.h"

namespace isorelax::model {

/// A mesh file as it was opened. Never changes; positions that a run moved stand in a MeshState.
struct Document {
  std::filesystem::path path;
  MeshFile file;
  Topology topology;
  /// See isorelax::plane_normal; none for a mesh in space.
  std::optional<Vec3> plane_normal;
  /// Per triangle: bit k is set where the edge opposite corner k has no other triangle.
  std::vector<std::uint8_t> boundary_marks;
  /// See isorelax::faces_inward.
  bool faces_inward = false;
  /// Of a sphere that was made here and is in no file.
  std::optional<SphereStart> sphere;

  [[nodiscard]] const TriangleMesh& mesh() const { return file.mesh; }
};
using DocumentPtr = std::shared_ptr<const Document>;

/// The document of a mesh that is there already.
[[nodiscard]] DocumentPtr make_document(std::filesystem::path path, MeshFile file);

/// A sphere.
[[nodiscard]] DocumentPtr make_document(const SphereStart& sphere);

/// Reads a mesh file. Throws InputError.
[[nodiscard]] DocumentPtr read_document(const std::filesystem::path& path);

/// The name of a file that is the same wherever it is named from.
[[nodiscard]] std::filesystem::path whole_name(const std::filesystem::path& path);

/// Whether the name of a file is that of a mesh.
[[nodiscard]] bool has_mesh_extension(const std::filesystem::path& path);
/// "OFF, OBJ, ... or VTU": what is read and written.
[[nodiscard]] std::string mesh_formats();

}  // namespace isorelax::model
