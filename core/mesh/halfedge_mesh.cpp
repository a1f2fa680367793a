#include "mesh/halfedge_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <algorithm>

namespace isorelax {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  // Deleted elements are only marked: ids stay.
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
};

using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

OpenMesh::VertexHandle handle_of(Index vertex) {
  return OpenMesh::VertexHandle(static_cast<int>(vertex));
}

Index id_of(OpenMesh::VertexHandle handle) {
  return static_cast<Index>(handle.idx());
}

}  // namespace

struct HalfedgeMesh::Impl {
  Mesh mesh;
  std::vector<Index> rejected;
  /// By triangle id; invalid where rejected.
  std::vector<OpenMesh::FaceHandle> faces;
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
    impl_->faces.push_back(face);
  }
}

HalfedgeMesh::~HalfedgeMesh() = default;
HalfedgeMesh::HalfedgeMesh(HalfedgeMesh&& other) noexcept = default;
HalfedgeMesh& HalfedgeMesh::operator=(HalfedgeMesh&& other) noexcept = default;

std::span<const Index> HalfedgeMesh::rejected_triangles() const {
  return impl_->rejected;
}

std::size_t HalfedgeMesh::edge_count() const {
  const auto edges = impl_->mesh.edges();  // deleted ones are skipped
  return static_cast<std::size_t>(std::distance(edges.begin(), edges.end()));
}

std::vector<Index> HalfedgeMesh::one_ring(Index vertex) const {
  const Mesh& mesh = impl_->mesh;
  std::vector<Index> ring;
  for (const auto neighbour : mesh.vv_ccw_range(handle_of(vertex))) ring.push_back(id_of(neighbour));
  if (ring.empty() || !mesh.is_boundary(handle_of(vertex))) return ring;
  // OpenMesh starts with the half-edge that has no triangle: counter-clockwise that is the fan's end.
  const auto first = mesh.to_vertex_handle(mesh.halfedge_handle(handle_of(vertex)));
  const auto last = std::find(ring.begin(), ring.end(), id_of(first));
  std::rotate(ring.begin(), last + 1, ring.end());
  return ring;
}

std::vector<std::vector<Index>> HalfedgeMesh::boundary_loops() const {
  const Mesh& mesh = impl_->mesh;
  std::vector<std::vector<Index>> loops;
  std::vector<bool> visited(mesh.n_halfedges(), false);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || visited[static_cast<std::size_t>(start.idx())]) continue;
    std::vector<Index> loop;
    OpenMesh::HalfedgeHandle at = start;
    do {
      visited[static_cast<std::size_t>(at.idx())] = true;
      loop.push_back(id_of(mesh.to_vertex_handle(at)));
      at = mesh.next_halfedge_handle(at);
    } while (at != start);
    std::reverse(loop.begin(), loop.end());  // half-edges without a triangle have the surface to the right
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool HalfedgeMesh::flip_edge(Index a, Index b) {
  Mesh& mesh = impl_->mesh;
  const auto side = mesh.find_halfedge(handle_of(a), handle_of(b));
  if (!side.is_valid()) return false;
  const auto edge = mesh.edge_handle(side);
  if (!mesh.is_flip_ok(edge)) return false;
  mesh.flip(edge);
  return true;
}

bool HalfedgeMesh::remove_triangle(Index triangle) {
  const OpenMesh::FaceHandle face = impl_->faces[triangle];
  if (!face.is_valid() || impl_->mesh.status(face).deleted()) return false;
  impl_->mesh.delete_face(face, false);
  return true;
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

std::vector<Triangle> HalfedgeMesh::triangles() const {
  std::vector<Triangle> triangles;
  for (const OpenMesh::FaceHandle face : impl_->faces) {
    if (!face.is_valid() || impl_->mesh.status(face).deleted()) continue;
    Triangle t{};
    std::size_t k = 0;
    for (const auto vertex : impl_->mesh.fv_ccw_range(face)) t[k++] = id_of(vertex);
    triangles.push_back(t);
  }
  return triangles;
}

}  // namespace isorelax
