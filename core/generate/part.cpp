#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/random.h"
#include "generate/shake.h"
#include "generate/shapes.h"
#include "generate/triangulation.h"

namespace isorelax {
namespace {

// The block stands on z = 0 over [0, 3] x [0, 2]; the corner at (3, 2) is rounded.
constexpr double kLength = 3;
constexpr double kWidth = 2;
constexpr double kHeight = 0.8;
constexpr double kRounding = 0.6;
constexpr double kChamfer = 0.2;
constexpr double kHoleX = 1.1;
constexpr double kHoleY = 0.9;
constexpr double kHoleRadius = 0.5;
/// Plane coordinates in units of 2^-27: three units of length fit the exact predicates.
constexpr double kGrid = 0x1p27;

/// A vertex of the outline seen from above, counter-clockwise.
struct OutlinePoint {
  Vec3 position;
  Vec3 inner;   ///< where the chamfer's upper rim has it
  Vec3 inward;  ///< unit normal of the wall, into the block; zero at a corner
  Freedom freedom;
};

/// A straight piece of the outline and of the chamfer's upper rim.
struct Side {
  Vec3 from, to;
  Vec3 inner_from, inner_to;
};

enum class Start { corner, smooth };

void add_side(std::vector<OutlinePoint>& outline, const Side& side, Start start, double spacing) {
  const Vec3 way = (side.to - side.from).normalized();
  const Vec3 inward(-way.y(), way.x(), 0);
  const long steps = std::max(2L, std::lround((side.to - side.from).norm() / spacing));
  for (long k = 0; k < steps; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(steps);
    OutlinePoint point{side.from + share * (side.to - side.from),
                       side.inner_from + share * (side.inner_to - side.inner_from), inward, Freedom{}};
    if (k > 0) point.freedom.first = way;
    if (k == 0 && start == Start::corner) point.inward = Vec3::Zero();
    outline.push_back(point);
  }
}

void add_arc(std::vector<OutlinePoint>& outline, const Vec3& centre, double spacing) {
  const long steps = std::max(3L, std::lround(kRounding * std::numbers::pi / 2 / spacing));
  for (long k = 0; k < steps; ++k) {
    const double angle = std::numbers::pi / 2 * static_cast<double>(k) / static_cast<double>(steps);
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    OutlinePoint point{centre + kRounding * out, centre + (kRounding - kChamfer) * out, -out, Freedom{}};
    if (k > 0) {
      point.freedom.turn = 1 / kRounding;
      point.freedom.centre = centre;
    }
    outline.push_back(point);
  }
}

std::vector<OutlinePoint> make_outline(double spacing) {
  constexpr double kInnerLength = kLength - kChamfer;
  constexpr double kInnerWidth = kWidth - kChamfer;
  constexpr double kArcX = kLength - kRounding;
  constexpr double kArcY = kWidth - kRounding;
  const Vec3 corners[3] = {{0, 0, 0}, {kLength, 0, 0}, {0, kWidth, 0}};
  const Vec3 inner[3] = {{kChamfer, kChamfer, 0}, {kInnerLength, kChamfer, 0}, {kChamfer, kInnerWidth, 0}};
  std::vector<OutlinePoint> outline;
  add_side(outline, {corners[0], corners[1], inner[0], inner[1]}, Start::corner, spacing);
  add_side(outline, {corners[1], {kLength, kArcY, 0}, inner[1], {kInnerLength, kArcY, 0}}, Start::corner,
           spacing);
  add_arc(outline, {kArcX, kArcY, 0}, spacing);
  add_side(outline, {{kArcX, kWidth, 0}, corners[2], {kArcX, kInnerWidth, 0}, inner[2]}, Start::smooth,
           spacing);
  add_side(outline, {corners[2], corners[0], inner[2], inner[0]}, Start::corner, spacing);
  return outline;
}

/// Distance of a point inside the outline from it.
double depth_in_outline(double x, double y) {
  const double u = x - (kLength - kRounding);
  const double w = y - (kWidth - kRounding);
  const double straight = std::min({x, kLength - x, y, kWidth - y});
  return u > 0 && w > 0 ? std::min(straight, kRounding - std::hypot(u, w)) : straight;
}

class PartBuilder {
 public:
  explicit PartBuilder(double spacing) : spacing_(spacing), outline_(make_outline(spacing)) {}

  TriangleMesh build(const ShapeSize& size) {
    const std::vector<Index> foot = add_outline(0, 0, Sharp::yes);
    const std::vector<Index> hole_foot = add_hole(0, Sharp::yes);
    std::vector<Index> below = foot;
    const double wall = kHeight - kChamfer;
    const long wall_steps = steps_for(wall);
    for (long k = 1; k <= wall_steps; ++k) {
      below = add_strip(below, wall * share(k, wall_steps), 0, k == wall_steps ? Sharp::yes : Sharp::no);
    }
    const long chamfer_steps = steps_for(kChamfer * std::numbers::sqrt2);
    for (long k = 1; k <= chamfer_steps; ++k) {
      const double inset = kChamfer * share(k, chamfer_steps);
      below = add_strip(below, wall + inset, inset, k == chamfer_steps ? Sharp::yes : Sharp::no);
    }
    std::vector<Index> hole_below = hole_foot;
    const long hole_steps = steps_for(kHeight);
    for (long k = 1; k <= hole_steps; ++k) {
      const auto ring = add_hole(kHeight * share(k, hole_steps), k == hole_steps ? Sharp::yes : Sharp::no);
      join(ring, hole_below);  // seen from the axis
      hole_below = ring;
    }
    add_face(foot, hole_foot, 0, 0);
    add_face(below, hole_below, kHeight, kChamfer);
    Random random(size.seed);
    shake(mesh_, size.jitter * spacing_, freedoms_, random);
    return std::move(mesh_);
  }

 private:
  enum class Sharp { no, yes };

  [[nodiscard]] long steps_for(double length) const { return std::max(1L, std::lround(length / spacing_)); }
  static double share(long k, long steps) { return static_cast<double>(k) / static_cast<double>(steps); }

  Index add_vertex(const Vec3& position, const Freedom& freedom) {
    mesh_.positions.push_back(position);
    freedoms_.push_back(freedom);
    return mesh_.vertex_count() - 1;
  }

  std::vector<Index> add_outline(double z, double inset, Sharp sharp) {
    std::vector<Index> ring;
    for (const OutlinePoint& p : outline_) {
      Vec3 position = p.position + inset / kChamfer * (p.inner - p.position);
      Freedom freedom = p.freedom;
      const bool corner = p.inward.isZero();
      if (sharp == Sharp::no) {
        // Up the wall, or up the chamfer; at a corner along the ridge that runs up from it.
        const Vec3 way_in = corner ? Vec3((p.inner - p.position) / kChamfer) : p.inward;
        const Vec3 up = inset > 0 ? Vec3((way_in + Vec3::UnitZ()).normalized()) : Vec3(Vec3::UnitZ());
        (corner ? freedom.first : freedom.second) = up;
      }
      position.z() = z;
      ring.push_back(add_vertex(position, freedom));
    }
    return ring;
  }

  std::vector<Index> add_strip(const std::vector<Index>& below, double z, double inset, Sharp sharp) {
    std::vector<Index> ring = add_outline(z, inset, sharp);
    join(below, ring);
    return ring;
  }

  std::vector<Index> add_hole(double z, Sharp sharp) {
    const long count = std::max(8L, std::lround(2 * std::numbers::pi * kHoleRadius / spacing_));
    std::vector<Index> ring;
    for (long i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * share(i, count);
      Freedom freedom;
      freedom.turn = 1 / kHoleRadius;
      freedom.centre = Vec3(kHoleX, kHoleY, 0);
      if (sharp == Sharp::no) freedom.second = Vec3::UnitZ();
      ring.push_back(add_vertex(
          {kHoleX + kHoleRadius * std::cos(angle), kHoleY + kHoleRadius * std::sin(angle), z}, freedom));
    }
    return ring;
  }

  /// Two rings of equally many vertices, `above` to the left of `below` when seen from outside.
  void join(const std::vector<Index>& below, const std::vector<Index>& above) {
    for (std::size_t i = 0; i < below.size(); ++i) {
      const std::size_t j = (i + 1) % below.size();
      if (i % 2 == 0) {
        mesh_.triangles.push_back({below[i], below[j], above[j]});
        mesh_.triangles.push_back({below[i], above[j], above[i]});
      } else {
        mesh_.triangles.push_back({below[i], below[j], above[i]});
        mesh_.triangles.push_back({below[j], above[j], above[i]});
      }
    }
  }

  /// A flat face between a rim and the hole: Delaunay triangles of both and a hexagonal lattice between them.
  /// The outline is convex, so nothing lies beyond it; triangles within the hole are dropped.
  void add_face(const std::vector<Index>& rim, const std::vector<Index>& hole, double z, double inset) {
    std::vector<Index> ids = rim;
    ids.insert(ids.end(), hole.begin(), hole.end());
    const std::size_t boundary = ids.size();
    Freedom freedom;
    freedom.first = Vec3::UnitX();
    freedom.second = Vec3::UnitY();
    const double margin = 0.6 * spacing_;
    const double row_height = std::sqrt(0.75) * spacing_;
    for (long row = 0; static_cast<double>(row) * row_height < kWidth; ++row) {
      for (long i = 0; static_cast<double>(i) * spacing_ < kLength; ++i) {
        const double x = (static_cast<double>(i) + (row % 2 == 1 ? 0.5 : 0)) * spacing_;
        const double y = static_cast<double>(row) * row_height;
        const bool clear_of_hole = std::hypot(x - kHoleX, y - kHoleY) > kHoleRadius + margin;
        if (clear_of_hole && depth_in_outline(x, y) > inset + margin)
          ids.push_back(add_vertex({x, y, z}, freedom));
      }
    }
    std::vector<GridPoint> points;
    for (const Index v : ids) {
      const Vec3& p = mesh_.positions[v];
      points.push_back({std::llround(kGrid * p.x()), std::llround(kGrid * p.y()), 0});
    }
    const auto in_hole = [&](Index local) { return local >= rim.size() && local < boundary; };
    for (const Triangle& t : delaunay_triangles(points)) {
      if (in_hole(t[0]) && in_hole(t[1]) && in_hole(t[2])) continue;
      const bool top = z > 0;
      mesh_.triangles.push_back({ids[t[0]], ids[t[top ? 1 : 2]], ids[t[top ? 2 : 1]]});
    }
  }

  double spacing_;
  std::vector<OutlinePoint> outline_;
  TriangleMesh mesh_;
  std::vector<Freedom> freedoms_;
};

}  // namespace

TriangleMesh make_part(const ShapeSize& size) {
  constexpr double kSurface = 18.5;  // two faces, wall, chamfer and hole, roughly
  return PartBuilder(std::min(spacing_for(kSurface, size.triangles), 0.5)).build(size);
}

}  // namespace isorelax
