#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "generate/random.h"
#include "generate/shake.h"
#include "generate/shapes.h"

namespace isorelax {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A point of the curve that is turned about the z axis.
struct ProfilePoint {
  double radius = 0;
  double z = 0;
  /// Direction in which the surface goes on to both sides; zero at a sharp edge.
  double along_radius = 0;
  double along_z = 0;
};

/// Straight pieces between the corners, cut into steps of about `spacing`; the corners are sharp.
std::vector<ProfilePoint> make_profile(const std::vector<std::array<double, 2>>& corners, double spacing) {
  std::vector<ProfilePoint> profile;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const auto [r0, z0] = corners[i];
    const auto [r1, z1] = corners[i + 1];
    const double length = std::hypot(r1 - r0, z1 - z0);
    const long steps = std::max(1L, std::lround(length / (std::sqrt(0.75) * spacing)));
    for (long k = 0; k < steps; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(steps);
      ProfilePoint point{r0 + share * (r1 - r0), z0 + share * (z1 - z0), 0, 0};
      if (k > 0) {
        point.along_radius = (r1 - r0) / length;
        point.along_z = (z1 - z0) / length;
      }
      profile.push_back(point);
    }
  }
  profile.push_back({corners.back()[0], corners.back()[1], 0, 0});
  return profile;
}

struct Ring {
  Index first = 0;
  Index count = 1;
  double phase = 0;  // angle of the first vertex, in steps

  [[nodiscard]] Index at(Index i) const { return first + i % count; }
  [[nodiscard]] double angle(Index i) const { return kTurn * (i + phase) / count; }
};

/// Triangles between two rings, going around with whichever side lags behind.
void join(const Ring& a, const Ring& b, std::vector<Triangle>& triangles) {
  const Index steps_a = a.count == 1 ? 0 : a.count;
  const Index steps_b = b.count == 1 ? 0 : b.count;
  Index i = 0;
  Index j = 0;
  while (i < steps_a || j < steps_b) {
    const bool advance_a = j == steps_b || (i < steps_a && a.angle(i + 1) <= b.angle(j + 1));
    if (advance_a) {
      triangles.push_back({a.at(i), a.at(i + 1), b.at(j)});
      ++i;
    } else {
      triangles.push_back({a.at(i), b.at(j + 1), b.at(j)});
      ++j;
    }
  }
}

/// Turns a profile that starts and ends on the axis and runs up the outside.
TriangleMesh revolve(const std::vector<ProfilePoint>& profile, double spacing, const ShapeSize& size) {
  TriangleMesh mesh;
  std::vector<Freedom> freedoms;
  Ring before;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const ProfilePoint& p = profile[k];
    Ring ring{mesh.vertex_count(), 1, 0};
    if (p.radius > 0)
      ring.count = std::max<Index>(6, static_cast<Index>(std::lround(kTurn * p.radius / spacing)));
    if (k % 2 == 1) ring.phase = 0.5;
    for (Index i = 0; i < ring.count; ++i) {
      const double c = std::cos(ring.angle(i));
      const double s = std::sin(ring.angle(i));
      mesh.positions.emplace_back(p.radius * c, p.radius * s, p.z);
      Freedom freedom;
      if (p.radius > 0) {
        freedom.turn = 1 / p.radius;
        freedom.second = Vec3(p.along_radius * c, p.along_radius * s, p.along_z);
      }
      freedoms.push_back(freedom);
    }
    if (k > 0) join(before, ring, mesh.triangles);
    before = ring;
  }
  Random random(size.seed);
  shake(mesh, size.jitter * spacing, freedoms, random);
  return mesh;
}

}  // namespace

TriangleMesh make_cylinder(const ShapeSize& size) {
  const double spacing = spacing_for(std::numbers::pi * 1.5, size.triangles);
  return revolve(make_profile({{0, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {0, 0.5}}, spacing), spacing, size);
}

TriangleMesh make_cone(const ShapeSize& size) {
  const double area = std::numbers::pi * 0.5 * (0.5 + std::hypot(0.5, 1));
  const double spacing = spacing_for(area, size.triangles);
  return revolve(make_profile({{0, 0}, {0.5, 0}, {0, 1}}, spacing), spacing, size);
}

TriangleMesh make_cube(const ShapeSize& size) {
  const long n = std::max(1L, std::lround(std::sqrt(static_cast<double>(size.triangles) / 12)));
  using Node = std::array<long, 3>;
  TriangleMesh mesh;
  std::vector<Freedom> freedoms;
  std::map<Node, Index> ids;
  const auto vertex = [&](const Node& node) {
    const auto [at, is_new] = ids.emplace(node, mesh.vertex_count());
    if (!is_new) return at->second;
    Vec3 p;
    std::vector<Vec3> ways;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = static_cast<double>(node[axis]) / static_cast<double>(n);
      if (node[axis] > 0 && node[axis] < n) ways.push_back(Vec3::Unit(axis));
    }
    Freedom freedom;
    if (!ways.empty()) freedom.first = ways[0];
    if (ways.size() > 1) freedom.second = ways[1];
    mesh.positions.push_back(p);
    freedoms.push_back(freedom);
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const long side : {0L, n}) {
      const int u = side == 0 ? (axis + 2) % 3 : (axis + 1) % 3;
      const int w = 3 - axis - u;
      for (long i = 0; i < n; ++i) {
        for (long j = 0; j < n; ++j) {
          const auto corner = [&](long di, long dj) {
            Node node{};
            node[axis] = side;
            node[u] = i + di;
            node[w] = j + dj;
            return vertex(node);
          };
          const Index a = corner(0, 0);
          const Index b = corner(1, 0);
          const Index c = corner(1, 1);
          const Index d = corner(0, 1);
          if ((i + j) % 2 == 0) {
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
          } else {
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
          }
        }
      }
    }
  }
  Random random(size.seed);
  shake(mesh, size.jitter / static_cast<double>(n), freedoms, random);
  return mesh;
}

}  // namespace isorelax
