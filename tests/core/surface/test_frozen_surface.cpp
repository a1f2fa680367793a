#include "surface/frozen_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/surface/shapes.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

/// A mesh with its topology, classes and frozen surface.
struct Frozen {
  explicit Frozen(TriangleMesh m, const FeatureOptions& features = {})
      : mesh(std::move(m)),
        topology(mesh.triangles, mesh.vertex_count()),
        classes(classify_vertices(mesh.positions, mesh.triangles, topology, features, 1)),
        surface(mesh.positions, mesh.triangles, topology, classes, 1) {}

  [[nodiscard]] Projection project(Index v, const Vec3& point) const {
    return surface.project(point, classes.classes[v], surface.anchor(v));
  }
  [[nodiscard]] double edge_length(Index v) const {
    const Corner c = topology.corners_of(v)[0];
    return (mesh.positions[mesh.triangles[c / 3][next(c % 3)]] - mesh.positions[v]).norm();
  }
  /// The vertex moved in its tangent plane by about a third of an edge.
  [[nodiscard]] Vec3 moved(Index v, std::mt19937& random) const {
    std::uniform_real_distribution<double> u(-0.3, 0.3);
    Vec3 d = edge_length(v) * Vec3::NullaryExpr([&] { return u(random); });
    Vec3 normal = Vec3::Zero();
    for (const Corner c : topology.corners_of(v)) {
      const auto& [i, j, k] = mesh.triangles[c / 3];
      normal += area_vector(mesh.positions[i], mesh.positions[j], mesh.positions[k]);
    }
    normal.normalize();
    return mesh.positions[v] + d - normal.dot(d) * normal;
  }

  TriangleMesh mesh;
  Topology topology;
  VertexClasses classes;
  FrozenSurface surface;
};

double off_sphere(const Vec3& x) {
  return std::abs(x.norm() - 1);
}
double off_torus(const Vec3& x) {
  return std::abs(std::hypot(std::hypot(x.x(), x.y()) - 1, x.z()) - 0.4);
}

/// Largest error over the triangles' middles, each reached from one of its vertices.
template <typename Error>
double largest_error(const Frozen& f, const Error& error) {
  double largest = 0;
  for (const Triangle& t : f.mesh.triangles) {
    const Vec3 middle = (f.mesh.positions[t[0]] + f.mesh.positions[t[1]] + f.mesh.positions[t[2]]) / 3;
    largest = std::max(largest, error(f.project(t[0], middle).point));
  }
  return largest;
}

TEST(FrozenSurface, KeepsVerticesThatDoNotMove) {
  for (const ShapeKind kind :
       {ShapeKind::sphere, ShapeKind::part, ShapeKind::cone, ShapeKind::random_square}) {
    const Frozen f(with_triangles(kind, 1500));
    for (Index v = 0; v < f.mesh.vertex_count(); ++v)
      EXPECT_LT((f.project(v, f.mesh.positions[v]).point - f.mesh.positions[v]).norm(), 1e-15);
  }
}

TEST(FrozenSurface, ItsTangentAxesAreTheNormalsOfASphereWhateverTheTriangles) {
  const Frozen f(with_vertices(ShapeKind::random_sphere, 3000));
  std::mt19937 random(3);
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec3 point = f.project(v, f.moved(v, random)).point;
    const Vec3 axis = f.surface.tangent_axis(point, VertexClass::smooth, f.surface.anchor(v));
    EXPECT_NEAR(axis.norm(), 1, 1e-12);
    EXPECT_LT(axis.cross(point).norm(), 2e-3) << "vertex " << v;
  }
}

TEST(FrozenSurface, ItsTangentAxesFollowARim) {
  const Frozen f(with_triangles(ShapeKind::cylinder, 2000, 0.3));
  std::mt19937 random(3);
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    if (f.classes.classes[v] != VertexClass::ridge) continue;
    const Vec3 point = f.project(v, f.moved(v, random)).point;
    const Vec3 axis = f.surface.tangent_axis(point, VertexClass::ridge, f.surface.anchor(v));
    EXPECT_NEAR(axis.norm(), 1, 1e-12);
    EXPECT_LT(std::abs(axis.z()), 1e-9);
    EXPECT_LT(std::abs(axis.dot(Vec3(point.x(), point.y(), 0))), 1e-3);
  }
}

TEST(FrozenSurface, OfASphereIsOfHighOrder) {
  const double coarse = largest_error(Frozen(with_vertices(ShapeKind::sphere, 1458)), off_sphere);
  const double fine = largest_error(Frozen(with_vertices(ShapeKind::sphere, 5832)), off_sphere);
  std::printf("sphere of 1458, 5832 vertices: radial error %.1e, %.1e, order %.1f\n", coarse, fine,
              std::log2(coarse / fine));
  EXPECT_LT(fine, 1e-7);
  EXPECT_GT(std::log2(coarse / fine), 4);
}

TEST(FrozenSurface, OfARandomSphereIsWithinAHundredThousandth) {
  const Frozen f(with_vertices(ShapeKind::random_sphere, 5832), FeatureOptions::none());
  EXPECT_LT(largest_error(f, off_sphere), 1e-5);
}

TEST(FrozenSurface, OfAShakenTorusIsOfHighOrder) {
  const double coarse =
      largest_error(Frozen(with_triangles(ShapeKind::torus, 4000, 0.4), FeatureOptions::none()), off_torus);
  const double fine =
      largest_error(Frozen(with_triangles(ShapeKind::torus, 16000, 0.4), FeatureOptions::none()), off_torus);
  std::printf("torus of 4000, 16000 triangles: error %.1e, %.1e, order %.1f\n", coarse, fine,
              std::log2(coarse / fine));
  EXPECT_LT(fine, 1e-5);
  EXPECT_GT(std::log2(coarse / fine), 3);
}

TEST(FrozenSurface, KeepsPlanesAndStraightEdgesExactly) {
  const Frozen f(with_triangles(ShapeKind::cube, 3000, 0.4));
  std::mt19937 random(21);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : f.mesh.positions) box.extend(x);
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec3& x = f.mesh.positions[v];
    const Vec3 p = f.project(v, f.moved(v, random)).point;
    if (f.classes.classes[v] == VertexClass::corner) continue;
    for (int k = 0; k < 3; ++k) {
      const bool on_side = std::abs(x[k] - box.min()[k]) < 1e-15 || std::abs(x[k] - box.max()[k]) < 1e-15;
      if (on_side) {
        EXPECT_NEAR(p[k], x[k], 1e-15);
      }
    }
  }
}

TEST(FrozenSurface, KeepsPlanesThatRunIntoARounding) {
  const Frozen f(with_triangles(ShapeKind::part, 4000));
  std::mt19937 random(22);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : f.mesh.positions) box.extend(x);
  int checked = 0;
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec3& x = f.mesh.positions[v];
    if (f.classes.classes[v] == VertexClass::corner) continue;
    const Vec3 p = f.project(v, f.moved(v, random)).point;
    const SurfacePoint flat = f.surface.closest(p);
    for (int k = 0; k < 3; ++k) {
      // Vertices inside a side of the box, not on the rim of the rounding where the plane ends.
      for (const double side : {box.min()[k], box.max()[k]}) {
        bool inside = x[k] == side;
        for (const Corner c : f.topology.corners_of(v))
          for (const Index w : f.mesh.triangles[c / 3]) inside = inside && f.mesh.positions[w][k] == side;
        if (!inside) continue;
        ++checked;
        EXPECT_NEAR(p[k], side, 1e-14);
        EXPECT_LT(flat.distance, 1e-14);
      }
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(FrozenSurface, OfACylinderIsRoundOnItsSideAndAlongItsRims) {
  const Frozen f(with_triangles(ShapeKind::cylinder, 4000));
  std::mt19937 random(23);
  double side = 0, rim = 0, cap = 0;
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec3& x = f.mesh.positions[v];
    const Vec3 p = f.project(v, f.moved(v, random)).point;
    const double off = std::abs(std::hypot(p.x(), p.y()) - 0.5);
    if (f.classes.classes[v] == VertexClass::ridge) {
      rim = std::max({rim, off, std::abs(p.z() - x.z())});
    } else if (std::abs(std::hypot(x.x(), x.y()) - 0.5) < 1e-12) {
      side = std::max(side, off);
    } else {
      cap = std::max(cap, std::abs(p.z() - x.z()));
    }
  }
  std::printf("cylinder: side %.1e, rim %.1e, cap %.1e\n", side, rim, cap);
  EXPECT_LT(side, 5e-6);  // the flat triangles: 1e-3
  EXPECT_LT(rim, 1e-6);
  EXPECT_LT(cap, 1e-15);
}

TEST(FrozenSurface, KeepsAStraightBorderAndFollowsACurvedOne) {
  const Frozen square(with_triangles(ShapeKind::hexagonal_square, 600));
  std::mt19937 random(24);
  for (Index v = 0; v < square.mesh.vertex_count(); ++v) {
    if (square.classes.classes[v] != VertexClass::boundary) continue;
    const Vec3 p = square.project(v, square.moved(v, random)).point;
    const double off = std::min({std::abs(p.x()), std::abs(p.y()), std::abs(p.x() - 1), std::abs(p.y() - 1)});
    EXPECT_LT(off, 1e-15);
  }
  TriangleMesh tube = with_triangles(ShapeKind::cylinder, 4000);
  std::erase_if(tube.triangles, [&](const Triangle& t) {
    const double z = tube.positions[t[0]].z();
    return z == tube.positions[t[1]].z() && z == tube.positions[t[2]].z();
  });
  const Frozen open(tube);
  int borders = 0;
  for (Index v = 0; v < tube.vertex_count(); ++v) {
    if (open.classes.classes[v] != VertexClass::boundary) continue;
    ++borders;
    const Vec3 p = open.project(v, open.moved(v, random)).point;
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.5, 1e-6);
    EXPECT_NEAR(p.z(), tube.positions[v].z(), 1e-15);
  }
  EXPECT_GT(borders, 20);
}

TEST(FrozenSurface, DoesNotLetASmoothVertexOverACrease) {
  const Frozen f(with_triangles(ShapeKind::cube, 1200));
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    if (f.classes.classes[v] != VertexClass::smooth) continue;
    const auto& [a, b, c] = f.mesh.triangles[f.surface.anchor(v).triangle];
    const Vec3 n = area_vector(f.mesh.positions[a], f.mesh.positions[b], f.mesh.positions[c]).normalized();
    for (int k = 0; k < 3; ++k) {
      // Beyond an edge and deep under the face: nearest to the side behind the edge.
      const Vec3 beyond = f.mesh.positions[v] + 1.5 * Vec3::Unit(k) - 0.4 * n;
      EXPECT_NEAR(n.dot(f.project(v, beyond).point - f.mesh.positions[v]), 0, 1e-12);
    }
  }
}

TEST(FrozenSurface, DoesNotJumpToAnotherSheet) {
  // Two parallel squares, closer to each other than the move.
  TriangleMesh mesh = with_triangles(ShapeKind::hexagonal_square, 400);
  const Index n = mesh.vertex_count();
  const std::size_t triangles = mesh.triangles.size();
  for (Index v = 0; v < n; ++v) mesh.positions.emplace_back(mesh.positions[v] + Vec3(0, 0, 0.01));
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + n, c + n, b + n});
  }
  const Frozen f(mesh);
  for (Index v = 0; v < n; ++v) {
    if (f.classes.classes[v] == VertexClass::corner) continue;
    EXPECT_EQ(f.project(v, mesh.positions[v] + Vec3(0.01, 0, 0.009)).point.z(), 0);
  }
  EXPECT_NEAR(f.surface.closest({0.5, 0.5, 0.009}).distance, 0.001, 1e-15);
}

TEST(FrozenSurface, ProjectsItsOwnPointsToThemselves) {
  const Frozen f(with_triangles(ShapeKind::torus, 3000, 0.3), FeatureOptions::none());
  std::mt19937 random(25);
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Projection once = f.project(v, f.moved(v, random));
    const Projection twice = f.surface.project(once.point, f.classes.classes[v], once.anchor);
    EXPECT_LT((twice.point - once.point).norm(), 1e-4 * f.edge_length(v));
  }
}

TEST(FrozenSurface, DoesNotOvershootOnNoise) {
  Frozen clean(with_vertices(ShapeKind::sphere, 3000));
  std::mt19937 random(26);
  std::normal_distribution<double> noise(0, 0.1);
  TriangleMesh rough = clean.mesh;
  for (Index v = 0; v < rough.vertex_count(); ++v)
    rough.positions[v] *= 1 + noise(random) * clean.edge_length(v);
  const Frozen f(rough, FeatureOptions::none());
  for (Index v = 0; v < rough.vertex_count(); ++v) {
    const Vec3 p = f.project(v, f.moved(v, random)).point;
    EXPECT_LT(f.surface.closest(p).distance, 0.4 * clean.edge_length(v));
  }
}

TEST(FrozenSurface, ItsFitsAgreeOnASphereAndNotOnNoise) {
  Frozen sphere(with_vertices(ShapeKind::random_sphere, 2000));
  EXPECT_EQ(sphere.surface.agreement(), 1);
  std::mt19937 random(27);
  std::normal_distribution<double> noise(0, 0.1);
  TriangleMesh rough = sphere.mesh;
  for (Index v = 0; v < rough.vertex_count(); ++v)
    rough.positions[v] *= 1 + noise(random) * sphere.edge_length(v);
  EXPECT_LT(Frozen(rough, FeatureOptions::none()).surface.agreement(), 0.2);
  EXPECT_EQ(Frozen(with_vertices(ShapeKind::cube, 600)).surface.agreement(), 0) << "nothing is curved";
}

TEST(FrozenSurface, IsTheSameForAnyNumberOfThreads) {
  const Frozen f(with_triangles(ShapeKind::part, 9000));
  const FrozenSurface other(f.mesh.positions, f.mesh.triangles, f.topology, f.classes, 3);
  std::mt19937 random(27);
  for (Index v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec3 to = f.moved(v, random);
    EXPECT_EQ(f.project(v, to).point, other.project(to, f.classes.classes[v], other.anchor(v)).point);
  }
}

TEST(FrozenSurface, AcceptsFlawedMeshes) {
  const TriangleMesh flawed = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {5, 5, 5}},
      {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 2, 3}, {3, 3, 3}, {0, 2, 1}},
      {},
  };
  const Frozen f(flawed);
  for (Index v = 0; v < 5; ++v)
    EXPECT_TRUE(f.project(v, flawed.positions[v] + Vec3(0.1, 0.2, 0.3)).point.allFinite());
  EXPECT_EQ(f.surface.anchor(5).triangle, kNone);
  EXPECT_EQ(Frozen(TriangleMesh()).surface.closest({0, 0, 0}).triangle, kNone);
}

}  // namespace
}  // namespace isorelax
