#pragma once

#include "generate/generate.h"

namespace isorelax {

inline TriangleMesh with_triangles(ShapeKind kind, std::size_t count,
                                   std::optional<double> jitter = std::nullopt) {
  GenerateOptions options;
  options.triangles = count;
  options.jitter = jitter;
  return generate(kind, options);
}

inline TriangleMesh with_vertices(ShapeKind kind, std::size_t count,
                                  std::optional<double> jitter = std::nullopt) {
  GenerateOptions options;
  options.vertices = count;
  options.jitter = jitter;
  return generate(kind, options);
}

/// A saddle, z = 0.02 (x^2 - y^2), of side x side squares, with its inner vertices shifted along it: edges
/// along x lie over it, those along y under it.
inline TriangleMesh saddle(Index side, double shift_x = 0, double shift_y = 0) {
  TriangleMesh mesh;
  for (Index j = 0; j <= side; ++j) {
    for (Index i = 0; i <= side; ++i) {
      const bool inside = i > 0 && j > 0 && i < side && j < side;
      const double x = i + (inside ? shift_x : 0) - 0.5 * side;
      const double y = j + (inside ? shift_y : 0) - 0.5 * side;
      mesh.positions.emplace_back(x, y, 0.02 * (x * x - y * y));
      if (i == side || j == side) continue;
      const Index v = j * (side + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + side + 2});
      mesh.triangles.push_back({v, v + side + 2, v + side + 1});
    }
  }
  return mesh;
}

}  // namespace isorelax
