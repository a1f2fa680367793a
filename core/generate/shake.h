#pragma once

#include <functional>
#include <vector>

#include "generate/random.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Where vertex v lies when it is moved by (s, t) along its surface, in units of length; (0, 0) leaves it.
using PlaceVertex = std::function<Vec3(Index v, double s, double t)>;

/// Moves every vertex at random within a disc of radius `amount` on its surface. Moves that make a triangle's
/// smallest angle fall under 8 degrees (or under half of what it was), or turn its normal by more than 60
/// degrees, are halved until none does.
void shake(TriangleMesh& mesh, double amount, const PlaceVertex& place, Random& random);

/// How a vertex of a solid may move: along straight directions and by turning about the z axis.
struct Freedom {
  Vec3 first = Vec3::Zero();
  Vec3 second = Vec3::Zero();
  /// Angle per unit of the first parameter, about the axis through `centre` parallel to z.
  double turn = 0;
  Vec3 centre = Vec3::Zero();
};

/// Shakes a mesh whose vertices move as `freedoms` says, one per vertex.
void shake(TriangleMesh& mesh, double amount, const std::vector<Freedom>& freedoms, Random& random);

}  // namespace isorelax
