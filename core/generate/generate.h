#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace isorelax {

enum class ShapeKind {
  random_square,
  hexagonal_square,
  sphere,
  random_sphere,
  torus,
  cube,
  cylinder,
  cone,
  part
};

struct ShapeInfo {
  ShapeKind kind;
  std::string_view name;         ///< on the command line
  std::string_view description;  ///< one line
};

/// Every kind of mesh that can be made.
[[nodiscard]] std::span<const ShapeInfo> shape_kinds();

struct GenerateOptions {
  std::uint64_t seed = 1;
  /// How large: the number of vertices or of triangles, at most one of them. Random squares and spheres hit
  /// it exactly, the other kinds come as near as their construction allows. Neither: about 2000 triangles.
  std::optional<std::size_t> vertices;
  std::optional<std::size_t> triangles;
  /// Largest random move of a vertex along its surface, in mean edge lengths; 0 for the regular mesh. A move
  /// that would squeeze a triangle under 8 degrees is halved until it does not. Vertices on sharp edges slide
  /// along them, corners and the boundary of a plane stay. No meaning for random_square and random_sphere.
  /// None: 0.45 for hexagonal_square and part, 0 for the others.
  std::optional<double> jitter;
  /// Share of the inner vertices, 0..1, that are thrown anywhere inside at last, which turns triangles upside
  /// down: something to untangle. Only for squares.
  double tangle = 0;
};

/// Makes a mesh, the same one for the same options everywhere. Triangles are counter-clockwise seen from
/// outside, or from above (+z) in the plane; closed kinds are watertight.
///
/// random_square     unit square, points at random inside and evenly on its boundary, Delaunay triangles
/// hexagonal_square  unit square of equilateral rows with shaken inner vertices
/// sphere            unit sphere, Fibonacci points and their hull; n vertices give 2 n - 4 triangles
/// random_sphere     unit sphere, independent uniform points and their hull
/// torus             radii 1 and 0.4 about the z axis
/// cube              side 1
/// cylinder, cone    radius 0.5, height 1, with flat ends
/// part              3 x 2 x 0.8 block with a round hole, a chamfer along the top and one rounded corner
///
/// Throws UsageError for a count that the kind cannot have (sphere: under 4 vertices), both counts at once,
/// a jitter or a tangle outside 0..1, or a tangle of another kind than a square.
[[nodiscard]] TriangleMesh generate(ShapeKind kind, const GenerateOptions& options);

}  // namespace isorelax
