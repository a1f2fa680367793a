#include "model/document.h"

#include <utility>

#include "quality/inverted.h"
#include "surface/deviation.h"

namespace isorelax::model {
namespace {

std::vector<std::uint8_t> mark_boundary(const Topology& topology) {
  std::vector<std::uint8_t> marks(topology.triangle_count());
  for (Corner c = 0; c < 3 * topology.triangle_count(); ++c)
    if (topology.is_boundary_edge(c)) marks[c / 3] |= static_cast<std::uint8_t>(1U << c % 3);
  return marks;
}

}  // namespace

namespace {

std::shared_ptr<Document> complete(std::filesystem::path path, MeshFile file) {
  auto document = std::make_shared<Document>();
  document->path = std::move(path);
  document->file = std::move(file);
  document->topology = Topology(document->mesh().triangles, document->mesh().vertex_count());
  document->plane_normal =
      plane_normal(document->mesh().positions, document->mesh().triangles, document->topology);
  document->boundary_marks = mark_boundary(document->topology);
  document->faces_inward = faces_inward(document->mesh().positions, document->mesh().triangles);
  return document;
}

}  // namespace

DocumentPtr make_document(std::filesystem::path path, MeshFile file) {
  return complete(std::move(path), std::move(file));
}

DocumentPtr make_document(const SphereStart& sphere) {
  MeshFile file;
  file.mesh = make_sphere(sphere);
  auto document = complete("sphere-" + std::to_string(sphere.vertices) + ".ply", std::move(file));
  document->sphere = sphere;
  return document;
}

DocumentPtr read_document(const std::filesystem::path& path) {
  return make_document(path, read_mesh(path));
}

std::filesystem::path whole_name(const std::filesystem::path& path) {
  std::error_code error;
  const auto whole = std::filesystem::weakly_canonical(path, error);
  return error ? path : whole;
}

bool has_mesh_extension(const std::filesystem::path& path) {
  return format_of_extension(path).has_value();
}

std::string mesh_formats() {
  return format_names();
}

}  // namespace isorelax::model
