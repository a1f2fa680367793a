#pragma once

#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax::render {

/// The unit square in the xy plane, `cells` x `cells` quads cut along one diagonal, inner vertices moved by
/// up to `jitter` cells by a fixed rule.
TriangleMesh jittered_square(Index cells, double jitter);

/// A torus around the z axis, radii 1 and 0.4.
TriangleMesh torus(Index around, Index across);

/// The same with vertices crowded to one side and every other ring turned: triangles of many shapes.
TriangleMesh uneven_torus(Index around, Index across);

/// Degrees, one per triangle.
std::vector<double> min_angles(const TriangleMesh& mesh);
std::vector<double> max_angles(const TriangleMesh& mesh);
/// Areas over their mean.
std::vector<double> relative_areas(const TriangleMesh& mesh);
/// (|a|^2 + |b|^2 + |c|^2) / (sqrt(3) * 2 * area): 2 for equilateral triangles.
std::vector<double> shape_energies(const TriangleMesh& mesh);

}  // namespace isorelax::render
