#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// What generate() hands to the construction of one kind. Sizes as in GenerateOptions.
struct ShapeSize {
  std::uint64_t seed = 1;
  std::size_t triangles = 2000;
  double jitter = 0;
};

/// `vertices` points of which `boundary` lie on the square's boundary, corners among them.
struct RandomSquareSize {
  std::uint64_t seed = 1;
  std::size_t vertices = 0;
  std::size_t boundary = 0;
};

[[nodiscard]] TriangleMesh make_random_square(const RandomSquareSize& size);
[[nodiscard]] TriangleMesh make_hexagonal_square(const ShapeSize& size);
/// (size.triangles + 4) / 2 vertices.
[[nodiscard]] TriangleMesh make_fibonacci_sphere(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_random_sphere(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_torus(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_cube(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_cylinder(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_cone(const ShapeSize& size);
[[nodiscard]] TriangleMesh make_part(const ShapeSize& size);

/// Edge length of equilateral triangles of which `triangles` cover `area`.
[[nodiscard]] double spacing_for(double area, std::size_t triangles);

}  // namespace isorelax
