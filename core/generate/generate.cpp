#include "generate/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "generate/random.h"
#include "generate/shapes.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

constexpr std::size_t kDefaultTriangles = 2000;
constexpr double kDefaultJitter = 0.45;
/// Corners are numbered with 32 bits, three to a triangle.
constexpr std::size_t kMostTriangles = 1000000000;

constexpr std::array<ShapeInfo, 9> kKinds{{
    {ShapeKind::random_square, "random", "unit square, random points, Delaunay triangles (the paper's R)"},
    {ShapeKind::hexagonal_square, "hexagonal",
     "unit square, shaken rows of equilateral triangles (the paper's U)"},
    {ShapeKind::sphere, "sphere", "unit sphere of Fibonacci points: n vertices, 2n-4 triangles"},
    {ShapeKind::random_sphere, "random-sphere", "unit sphere of independent random points"},
    {ShapeKind::torus, "torus", "radii 1 and 0.4"},
    {ShapeKind::cube, "cube", "side 1"},
    {ShapeKind::cylinder, "cylinder", "radius 0.5, height 1, closed by flat ends"},
    {ShapeKind::cone, "cone", "radius 0.5, height 1, closed by a flat end"},
    {ShapeKind::part, "part", "block with a hole, a chamfer and a rounded corner: ridges and corners"},
}};

/// Points on each side of a square such that they lie about as far apart as random points inside.
std::size_t boundary_points(std::size_t vertices) {
  const auto side = static_cast<std::size_t>(std::lround(0.9 * std::sqrt(static_cast<double>(vertices))));
  return 4 * std::max<std::size_t>(side, 1);
}

/// 2 v - 2 - b triangles from v points with b on the boundary.
TriangleMesh random_square(const GenerateOptions& options) {
  RandomSquareSize size;
  size.seed = options.seed;
  if (options.vertices) {
    if (*options.vertices < 4) throw UsageError("a random square needs at least 4 vertices");
    size.vertices = *options.vertices;
    size.boundary = std::min(size.vertices, boundary_points(size.vertices));
  } else {
    const std::size_t triangles = options.triangles.value_or(kDefaultTriangles);
    if (triangles < 2) throw UsageError("a random square needs at least 2 triangles");
    size.boundary = std::min(boundary_points(triangles / 2), triangles + 2) / 2 * 2 + triangles % 2;
    size.vertices = (triangles + 2 + size.boundary) / 2;
  }
  return make_random_square(size);
}

std::size_t target_triangles(ShapeKind kind, const GenerateOptions& options) {
  const bool sphere = kind == ShapeKind::sphere || kind == ShapeKind::random_sphere;
  if (sphere && options.vertices && *options.vertices < 4) {
    throw UsageError("a sphere needs at least 4 vertices");
  }
  if (sphere && options.triangles && (*options.triangles < 4 || *options.triangles % 2 != 0)) {
    throw UsageError("a sphere has an even number of triangles, at least 4");
  }
  if (options.vertices) return std::max<std::size_t>(2 * *options.vertices, 8) - 4;
  return std::max<std::size_t>(options.triangles.value_or(kDefaultTriangles), 4);
}

}  // namespace

std::span<const ShapeInfo> shape_kinds() {
  return kKinds;
}

double spacing_for(double area, std::size_t triangles) {
  return std::sqrt(4 * area / (std::sqrt(3.0) * static_cast<double>(triangles)));
}

namespace {

TriangleMesh generate_sound(ShapeKind kind, const GenerateOptions& options) {
  if (options.vertices && options.triangles)
    throw UsageError("give a number of vertices or of triangles, not both");
  if (std::max(options.vertices.value_or(0), options.triangles.value_or(0)) > kMostTriangles) {
    throw UsageError("at most " + std::to_string(kMostTriangles) + " triangles can be made");
  }
  if (options.jitter && !(*options.jitter >= 0 && *options.jitter <= 1)) {
    throw UsageError("the jitter must lie between 0 and 1");
  }
  if (kind == ShapeKind::random_square) return random_square(options);
  const bool shaken = kind == ShapeKind::hexagonal_square || kind == ShapeKind::part;
  const ShapeSize size{options.seed, target_triangles(kind, options),
                       options.jitter.value_or(shaken ? kDefaultJitter : 0)};
  switch (kind) {
    case ShapeKind::hexagonal_square:
      return make_hexagonal_square(size);
    case ShapeKind::sphere:
      return make_fibonacci_sphere(size);
    case ShapeKind::random_sphere:
      return make_random_sphere(size);
    case ShapeKind::torus:
      return make_torus(size);
    case ShapeKind::cube:
      return make_cube(size);
    case ShapeKind::cylinder:
      return make_cylinder(size);
    case ShapeKind::cone:
      return make_cone(size);
    case ShapeKind::random_square:
    case ShapeKind::part:
      break;
  }
  return make_part(size);
}

/// Throws a share of the inner vertices of a unit square anywhere inside.
void tangle(TriangleMesh& mesh, double share, Random& random) {
  std::vector<Index> inner;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = mesh.positions[v];
    if (std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) > 0) inner.push_back(v);
  }
  const auto thrown = static_cast<std::size_t>(std::lround(share * static_cast<double>(inner.size())));
  for (std::size_t i = 0; i < thrown; ++i) {
    std::swap(inner[i], inner[i + random.below(inner.size() - i)]);
    mesh.positions[inner[i]] = Vec3(random.uniform(), random.uniform(), 0);
  }
}

}  // namespace

TriangleMesh generate(ShapeKind kind, const GenerateOptions& options) {
  if (!(options.tangle >= 0 && options.tangle <= 1)) throw UsageError("the tangle must lie between 0 and 1");
  const bool square = kind == ShapeKind::random_square || kind == ShapeKind::hexagonal_square;
  if (options.tangle > 0 && !square) throw UsageError("only random and hexagonal squares can be tangled");
  TriangleMesh mesh = generate_sound(kind, options);
  Random random(options.seed + 0x7461'6e67);
  if (options.tangle > 0) tangle(mesh, options.tangle, random);
  return mesh;
}

}  // namespace isorelax
