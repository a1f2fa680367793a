#include "cgal_peers.h"

#include <CGAL/Polygon_mesh_processing/angle_and_area_smoothing.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "mesh/error.h"

namespace isorelax::bench {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

struct CgalMesh::Impl {
  Mesh mesh;
  Mesh::Property_map<Mesh::Vertex_index, bool> held;

  void smooth(unsigned iterations, bool areas) {
    pmp::angle_and_area_smoothing(mesh.faces(), mesh,
                                  CGAL::parameters::number_of_iterations(iterations)
                                      .use_angle_smoothing(true)
                                      .use_area_smoothing(areas)
                                      .use_Delaunay_flips(false)
                                      .use_safety_constraints(true)
                                      .do_project(true)
                                      .vertex_is_constrained_map(held));
  }
};

CgalMesh::CgalMesh(const TriangleMesh& mesh, std::span<const std::uint8_t> held)
    : impl_(std::make_unique<Impl>()) {
  Mesh& m = impl_->mesh;
  impl_->held = m.add_property_map<Mesh::Vertex_index, bool>("v:held", false).first;
  std::vector<Mesh::Vertex_index> vertices;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    vertices.push_back(m.add_vertex({p.x(), p.y(), p.z()}));
    impl_->held[vertices.back()] = held[v] != 0;
  }
  for (const Triangle& t : mesh.triangles) {
    if (m.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == Mesh::null_face())
      throw Error("CGAL does not take a triangle of this mesh");
  }
}

CgalMesh::~CgalMesh() = default;

void CgalMesh::smooth_angles(unsigned iterations) {
  impl_->smooth(iterations, false);
}

void CgalMesh::smooth_angles_and_areas(unsigned iterations) {
  impl_->smooth(iterations, true);
}

void CgalMesh::relax_tangentially(unsigned iterations) {
  pmp::tangential_relaxation(
      impl_->mesh.vertices(), impl_->mesh,
      CGAL::parameters::number_of_iterations(iterations).vertex_is_constrained_map(impl_->held));
}

std::vector<Vec3> CgalMesh::positions() const {
  std::vector<Vec3> positions;
  for (const Mesh::Vertex_index v : impl_->mesh.vertices()) {
    const auto& p = impl_->mesh.point(v);
    positions.emplace_back(p.x(), p.y(), p.z());
  }
  return positions;
}

}  // namespace isorelax::bench
