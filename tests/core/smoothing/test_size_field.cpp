#include "smoothing/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generate/generate.h"
#include "mesh/error.h"
#include "smoothing/bounded_run.h"

namespace isorelax {
namespace {

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * area_vector(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]).norm();
}

/// Mean area of the triangles left of x = 0.5 over that of those on the right.
double left_over_right(const TriangleMesh& mesh) {
  std::array<double, 2> sum{}, count{};
  for (const Triangle& t : mesh.triangles) {
    const double x = (mesh.positions[t[0]].x() + mesh.positions[t[1]].x() + mesh.positions[t[2]].x()) / 3;
    sum[x < 0.5 ? 0 : 1] += area_of(mesh, t);
    count[x < 0.5 ? 0 : 1] += 1;
  }
  return sum[0] / count[0] / (sum[1] / count[1]);
}

std::vector<std::string> smooth_to_sizes(TriangleMesh& mesh, const ProblemOptions& options) {
  return run_bounded(
             mesh.positions, mesh.triangles, options,
             [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
             {.iterations = 60}, {})
      .notes;
}

std::vector<double> growing_to_the_right(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  for (const Vec3& p : mesh.positions) lengths.push_back(p.x() < 0.5 ? 3 : 9);
  return lengths;
}

TEST(SizeField, MakesTrianglesSmallWhereItIsSmall) {
  TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.triangles = 800, .jitter = 0});
  const ProblemOptions options{.weights = EnergyWeights::from_mu(0.8),
                               .reference = SizeFieldReference{growing_to_the_right(mesh)},
                               .boundary = BoundaryRule::slide};
  EXPECT_NEAR(left_over_right(mesh), 1, 0.1);
  smooth_to_sizes(mesh, options);
  EXPECT_LT(left_over_right(mesh), 0.7);
}

TEST(SizeField, OnlyItsRatiosCount) {
  TriangleMesh one = generate(ShapeKind::random_square, {.triangles = 300});
  TriangleMesh other = one;
  std::vector<double> lengths = growing_to_the_right(one);
  ProblemOptions options{.weights = EnergyWeights::from_mu(0.5), .reference = SizeFieldReference{lengths}};
  smooth_to_sizes(one, options);
  for (double& length : lengths) length *= 1024;
  options.reference = SizeFieldReference{lengths};
  smooth_to_sizes(other, options);
  EXPECT_EQ(one.positions, other.positions);
}

TEST(SizeField, ReferencesCoverTheMesh) {
  const TriangleMesh mesh = generate(ShapeKind::sphere, {.vertices = 200});
  std::vector<double> lengths;
  for (const Vec3& p : mesh.positions) lengths.push_back(2 + p.z());
  const ReferenceMesh reference = make_reference(SizeFieldReference{lengths}, mesh.positions, mesh.triangles);
  double wanted = 0, is = 0;
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    wanted += 0.5 * reference.d1(t);
    is += area_of(mesh, mesh.triangles[t]);
  }
  EXPECT_NEAR(wanted, is, 1e-12 * is);
}

TEST(SizeField, SaysWhenItHasNoEffectAndRefusesWhatIsNone) {
  TriangleMesh mesh = generate(ShapeKind::random_square, {.triangles = 100});
  ProblemOptions options{.reference = SizeFieldReference{growing_to_the_right(mesh)}};
  const auto notes = smooth_to_sizes(mesh, options);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("no effect") != std::string::npos;
  }));
  options.reference = SizeFieldReference{{1, 2, 3}};
  EXPECT_THROW(smooth_to_sizes(mesh, options), MeshError);
  std::vector<double> zero(mesh.positions.size(), 0);
  options.reference = SizeFieldReference{zero};
  EXPECT_THROW(smooth_to_sizes(mesh, options), UsageError);
}

TEST(SizeField, OfCurvatureIsSmallerWhereASurfaceBendsMore) {
  TriangleMesh mesh = generate(ShapeKind::sphere, {.vertices = 1500});
  for (Vec3& p : mesh.positions) p.x() *= 3;  // an ellipsoid whose tips bend nine times as much as its waist
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const std::vector<double> lengths = curvature_size_field(mesh.positions, mesh.triangles, topology);
  double tip = 0, waist = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].x() > 2.9) tip = std::max(tip, lengths[v]);
    if (std::abs(mesh.positions[v].x()) < 0.2) waist = std::max(waist, lengths[v]);
  }
  EXPECT_LT(tip, 0.75 * waist);
  double steepest = 0;
  for (const Triangle& t : mesh.triangles)
    for (unsigned k = 0; k < 3; ++k)
      steepest = std::max(steepest, std::abs(lengths[t[k]] - lengths[t[next(k)]]) /
                                        (mesh.positions[t[k]] - mesh.positions[t[next(k)]]).norm());
  EXPECT_LE(steepest, 0.3 + 1e-12);
}

TEST(SizeField, OfAFlatMeshIsEvenAndOfACubeKnowsNoCreases) {
  for (const ShapeKind kind : {ShapeKind::random_square, ShapeKind::cube}) {
    const TriangleMesh mesh = generate(kind, {.triangles = 600});
    const Topology topology(mesh.triangles, mesh.vertex_count());
    const auto lengths = curvature_size_field(mesh.positions, mesh.triangles, topology);
    const auto [low, high] = std::minmax_element(lengths.begin(), lengths.end());
    EXPECT_LT(*high / *low, 1.05);
  }
}

}  // namespace
}  // namespace isorelax
