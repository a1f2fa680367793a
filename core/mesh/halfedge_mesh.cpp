#include "mesh/halfedge_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

namespace isorelax {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};

using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

OpenMesh::VertexHandle handle_of(Index vertex) {
  return OpenMesh::VertexHandle(static_cast<int>(vertex));
}

}  // namespace

struct HalfedgeMesh::Impl {
  Mesh mesh;
  std::vector<Index> rejected;
};

HalfedgeMesh::HalfedgeMesh(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>()) {
  ::omerr().disable();  // it reports each triangle it refuses; the core prints nothing
  impl_->mesh.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3& p : mesh.positions) impl_->mesh.add_vertex({p.x(), p.y(), p.z()});
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    OpenMesh::FaceHandle face;
    if (a != b && b != c && c != a) face = impl_->mesh.add_face(handle_of(a), handle_of(b), handle_of(c));
    if (!face.is_valid()) impl_->rejected.push_back(t);
  }
}

HalfedgeMesh::~HalfedgeMesh() = default;
HalfedgeMesh::HalfedgeMesh(HalfedgeMesh&& other) noexcept = default;
HalfedgeMesh& HalfedgeMesh::operator=(HalfedgeMesh&& other) noexcept = default;

std::span<const Index> HalfedgeMesh::rejected_triangles() const {
  return impl_->rejected;
}

void HalfedgeMesh::smooth_laplace(unsigned iterations) {
  using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh>;
  impl_->mesh.request_face_normals();
  impl_->mesh.request_vertex_normals();
  impl_->mesh.update_normals();
  Smoother smoother(impl_->mesh);
  smoother.initialize(Smoother::Tangential, Smoother::C0);
  smoother.smooth(iterations);
}

void HalfedgeMesh::hold(std::span<const std::uint8_t> held) {
  for (Index v = 0; v < held.size(); ++v) impl_->mesh.status(handle_of(v)).set_locked(held[v] != 0);
}

std::vector<Vec3> HalfedgeMesh::positions() const {
  std::vector<Vec3> positions;
  for (std::size_t v = 0; v < impl_->mesh.n_vertices(); ++v) {
    const auto& p = impl_->mesh.point(handle_of(static_cast<Index>(v)));
    positions.emplace_back(p[0], p[1], p[2]);
  }
  return positions;
}

}  // namespace isorelax
