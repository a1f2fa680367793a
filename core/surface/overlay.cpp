#include "surface/overlay.h"

namespace isorelax {
namespace {

constexpr unsigned kMostCorners = 16;
constexpr unsigned kMostPieces = 64;

/// A convex polygon.
struct Piece {
  std::array<Vec3, kMostCorners> points;
  unsigned count = 0;
  Index over = kNone;      ///< triangle of the surface
  Corner entered = kNone;  ///< the corner of it opposite to the edge that was crossed

  void add(const Vec3& point) { points[count++] = point; }
};

/// Splits a piece by the plane of the points with across . (point - origin) = slack. What is left of it lies
/// on this side, `beyond` on the other. False where there is no room for the corners.
bool split(Piece& piece, const Vec3& origin, const Vec3& across, double slack, Piece& beyond) {
  std::array<double, kMostCorners> height;
  bool any = false;
  for (unsigned k = 0; k < piece.count; ++k) {
    height[k] = across.dot(piece.points[k] - origin) - slack;
    any = any || height[k] > 0;
  }
  beyond.count = 0;
  if (!any) return true;
  if (piece.count + 2 > kMostCorners) return false;
  const Piece all = piece;
  piece.count = 0;
  for (unsigned k = 0; k < all.count; ++k) {
    const unsigned l = k + 1 == all.count ? 0 : k + 1;
    (height[k] > 0 ? beyond : piece).add(all.points[k]);
    if ((height[k] > 0) == (height[l] > 0)) continue;
    const Vec3 between =
        all.points[k] + height[k] / (height[k] - height[l]) * (all.points[l] - all.points[k]);
    piece.add(between);
    beyond.add(between);
  }
  return true;
}

}  // namespace

std::optional<Vec3> point_beyond(double enough, const std::array<Vec3, 3>& corners,
                                 const IndexedSurface& surface, Index near) {
  const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3;
  /// The first corner that is far from the triangle that the piece is over; its count where none is.
  const auto far_corner = [&](const Piece& piece) {
    unsigned k = 0;
    while (k < piece.count && surface.index.closest_of(piece.over, piece.points[k]).distance <= enough) ++k;
    return k;
  };
  std::array<Piece, kMostPieces> waiting;
  unsigned count = 1, pieces = 1;
  waiting[0] = {{corners[0], corners[1], corners[2]}, 3, near, kNone};
  while (count > 0) {
    Piece piece = waiting[--count];
    if (far_corner(piece) == piece.count) continue;
    for (unsigned k = 0; k < 3 && piece.count > 0; ++k) {
      const Corner corner = 3 * piece.over + k;
      const Corner opposite = surface.topology.opposite(corner);
      if (corner == piece.entered || opposite == kNone) continue;
      const Triangle& t = surface.triangles[piece.over];
      const Vec3& first = surface.positions[t[next(k)]];
      const Vec3 edge = surface.positions[t[previous(k)]] - first;
      const Vec3 across = edge.cross(surface.normals[piece.over] + surface.normals[opposite / 3]);
      Piece& beyond = waiting[count];
      if (!split(piece, first, across, surface.rounding * edge.norm(), beyond)) return centre;
      if (beyond.count == 0) continue;
      if (++pieces == kMostPieces) return centre;
      beyond.over = opposite / 3;
      beyond.entered = opposite;
      ++count;
    }
    if (const unsigned far = far_corner(piece); far < piece.count) return piece.points[far];
  }
  return {};
}

}  // namespace isorelax
