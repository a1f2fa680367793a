#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/mesh_file.h"
#include "smoothing/bounded_run.h"
#include "surface/closest_point.h"
#include "surface/crease_graph.h"
#include "surface/flat_patches.h"

// What is promised of any mesh, on meshes that are hard to keep it on, looked at in another way than the
// library does.

namespace isorelax {
namespace {

TriangleMesh read(const char* name) {
  return read_mesh(std::string(ISORELAX_CORPUS_DIR "/") + name + ".off").mesh;
}

BoundedResult smooth(TriangleMesh& mesh, const DeviationLimit& limit) {
  return run_bounded(
      mesh.positions, mesh.triangles, {},
      [](const SmoothingProblem& p) { return make_smoother(p, Solver::automatic); }, {.iterations = 50},
      limit);
}

double diagonal(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.positions) box.extend(x);
  return box.diagonal().norm();
}

/// Largest distance of points all over the triangles of `from` to those of `to`.
double sampled_distance(const TriangleMesh& from, const TriangleMesh& to) {
  constexpr int kParts = 12;
  const ClosestPointIndex index(to.positions, to.triangles);
  double largest = 0;
  for (Index t = 0; t < from.triangles.size(); ++t) {
    const auto& [a, b, c] = from.triangles[t];
    for (int i = 0; i <= kParts; ++i) {
      for (int j = 0; i + j <= kParts; ++j) {
        const Vec3 point = from.positions[a] +
                           static_cast<double>(i) / kParts * (from.positions[b] - from.positions[a]) +
                           static_cast<double>(j) / kParts * (from.positions[c] - from.positions[a]);
        largest = std::max(largest, index.closest(point, t).distance);
      }
    }
  }
  return largest;
}

TEST(Promises, NoPointOfTheSurfaceGoesFartherThanTheLimitNorThanIsSaid) {
  // More than a hundred vertices end at the limit here, and a point inside a triangle goes farther than they.
  const TriangleMesh before = read("bones");
  TriangleMesh after = before;
  constexpr double kLimit = 5e-3;
  const BoundedResult result = smooth(after, {.max = kLimit, .automatic = {}});
  const double far =
      std::max(sampled_distance(before, after), sampled_distance(after, before)) / diagonal(before);
  EXPECT_LE(far, kLimit);
  EXPECT_GE(result.deviation.max, (1 - 2e-3) * far);
}

TEST(Promises, TheRimsOfFlatFacesStayInTheirPlanes) {
  const TriangleMesh before = read("fandisk");
  TriangleMesh after = before;
  smooth(after, {});
  const Topology topology(before.triangles, before.vertex_count());
  const VertexClasses classes = classify_vertices(before.positions, before.triangles, topology, {});
  const std::vector<double> turns = dihedral_turns_deg(before.positions, before.triangles, topology);
  const std::vector<Index> faces = flat_patches(topology, turns, classes.creases);
  std::vector<std::size_t> sizes(faces.size(), 0);
  for (const Index face : faces)
    if (face != kNone) ++sizes[face];
  const double scale = diagonal(before);
  std::size_t checked = 0;
  for (Index t = 0; t < faces.size(); ++t) {
    constexpr std::size_t kLarge = 120;
    if (faces[t] == kNone || sizes[faces[t]] < kLarge) continue;
    const Triangle& base = before.triangles[faces[t]];
    const Vec3 origin = before.positions[base[0]];
    const Vec3 normal =
        area_vector(origin, before.positions[base[1]], before.positions[base[2]]).normalized();
    for (const Index v : before.triangles[t]) {
      // A face may run on without a crease: there it ends nowhere. One is flat only as far as its digits go.
      if (classes.classes[v] == VertexClass::smooth ||
          std::abs(normal.dot(before.positions[v] - origin)) > 1e-9 * scale)
        continue;
      EXPECT_LE(std::abs(normal.dot(after.positions[v] - origin)), 1e-6 * scale) << "vertex " << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1200U) << "with the rims that are no creases by their turn";
}

TEST(Promises, CreasesDrawnFinelyStayWhatTheyAre) {
  const TriangleMesh before = read("fandisk");
  TriangleMesh after = before;
  smooth(after, {});
  const VertexClasses classes = classify_vertices(before.positions, before.triangles,
                                                  Topology(before.triangles, before.vertex_count()), {});
  std::size_t moved = 0;
  for (Index v = 0; v < before.vertex_count(); ++v) {
    if (classes.classes[v] != VertexClass::ridge || after.positions[v] == before.positions[v]) continue;
    double nearest = INFINITY;
    for (const FeatureEdge& e : classes.creases) {
      const Vec3& a = before.positions[e.vertices[0]];
      const Vec3 along = before.positions[e.vertices[1]] - a;
      const double share = std::clamp(along.dot(after.positions[v] - a) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (after.positions[v] - a - share * along).norm());
    }
    EXPECT_LE(nearest, 1e-12 * diagonal(before)) << "vertex " << v;
    ++moved;
  }
  EXPECT_GT(moved, 600U);
}

// 27 of 2741 vertices may move here, and after one evening step a second moves one by next to nothing.
TEST(Promises, ARunDoesNotEndByEveningOut) {
  TriangleMesh mesh = read("boeing");
  EXPECT_LT(smooth(mesh, {}).run.after.energy, 53'100) << "evened out: 53,629";
}

}  // namespace
}  // namespace isorelax
