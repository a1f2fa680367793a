#pragma once

#include "compare/case.h"
#include "mesh/triangle_mesh.h"
#include "render/offscreen.h"
#include "view/view.h"

namespace isorelax::compare {

/// What two meshes may differ by, over the bounding-box diagonal of the first. Rounding passes, a move does
/// not.
struct MeshLimits {
  double displacement = 1e-9;  ///< of a vertex; only where both have the same triangles
  double deviation = 1e-9;     ///< between the surfaces, both ways
};

/// A mesh and the file it came from.
struct NamedMesh {
  std::string file;
  const TriangleMesh* mesh = nullptr;
};

/// How the pictures of a page are made.
struct MeshPictures {
  view::View view;
  render::ContextKind context = render::ContextKind::osmesa;
};

/// Compares two meshes. The same triangles: how far vertices moved, how many and which farthest, quality
/// metric by metric, distance between the surfaces both ways. Others: Hausdorff distance both ways, and
/// quality. Throws MeshError (no triangles), UsageError (the view).
[[nodiscard]] Case compare_meshes(const NamedMesh& a, const NamedMesh& b, const MeshLimits& limits);

/// Adds pictures of both meshes under one camera and one range, and of what lies between them.
void add_pictures(const NamedMesh& a, const NamedMesh& b, const MeshPictures& how, Case& result);

}  // namespace isorelax::compare
