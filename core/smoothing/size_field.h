#pragma once

#include <span>
#include <vector>

#include "mesh/topology.h"
#include "surface/vertex_class.h"

namespace isorelax {

struct CurvatureFieldOptions {
  FeatureOptions features;
  /// Largest edge length over the one at mean curvature, and the smallest's inverse.
  double range = 2;
  /// Largest change of the edge length over the distance.
  double gradation = 0.3;
  unsigned threads = 0;
};

/// Target edge lengths per vertex that follow the curvature: proportional to 1 / sqrt(k), as chords of one
/// height over the surface are, with k the larger principal curvature by its amount, fitted to how the vertex
/// normals turn within smooth faces (creases have no say). Within `range` of the mean, and nowhere changing
/// faster than `gradation`. A surface without curvature gets one length everywhere. In length units of the
/// mesh.
[[nodiscard]] std::vector<double> curvature_size_field(std::span<const Vec3> positions,
                                                       std::span<const Triangle> triangles,
                                                       const Topology& topology,
                                                       const CurvatureFieldOptions& options = {});

}  // namespace isorelax
