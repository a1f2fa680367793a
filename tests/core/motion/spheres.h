#pragma once

#include "generate/generate.h"
#include "motion/moving_surface.h"

namespace isorelax {

/// The paper's sphere with fewer vertices: radius 0.15 about (0.5, 0.75, 0.5).
inline TriangleMesh paper_sphere(std::size_t vertices) {
  GenerateOptions options;
  options.vertices = vertices;
  TriangleMesh mesh = generate(ShapeKind::sphere, options);
  for (Vec3& x : mesh.positions) x = Vec3(0.5, 0.75, 0.5) + 0.15 * x;
  return mesh;
}

inline void advance_to(MovingSurface& surface, double end) {
  while (surface.state().time < end) surface.advance(end);
}

}  // namespace isorelax
