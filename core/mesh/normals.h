#pragma once

#include <cstddef>
#include <span>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Makes stored normals fit again after vertices have moved: those of every vertex and triangle corner around
/// which something differs from `before` become the mean of the normals of the triangles that share them,
/// weighted with their angles there; others keep their bits. Corners that shared a normal at a vertex still
/// do, so creases stay sharp. Normals that pointed inward before still do. Returns how many were made anew; 0
/// where none are stored. Precondition: as many positions before as now.
std::size_t refresh_normals(TriangleMesh& mesh, std::span<const Vec3> before);

}  // namespace isorelax
