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

}  // namespace isorelax
