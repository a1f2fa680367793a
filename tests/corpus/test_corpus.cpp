#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "io/mesh_file.h"
#include "quality/inverted.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"
#include "smoothing/polish.h"
#include "smoothing/turn_limit.h"
#include "surface/feature_edges.h"

// Smooths real meshes as `isorelax smooth IN -o OUT --iterations 100` does, and asks what anybody
// who smooths a mesh would ask.

namespace isorelax {
namespace {

/// Largest distance that a ridge vertex may end from the ridge lines of the input, in mean edge lengths.
constexpr double kRidgeDistance = 0.25;

std::vector<std::string> names_in(const char* text) {
  std::vector<std::string> names;
  std::istringstream list(text);
  for (std::string name; list >> name;) names.push_back(name);
  return names;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

/// Edges of the mesh that join two vertices on features.
std::vector<std::pair<Vec3, Vec3>> ridge_edges(std::span<const Vec3> positions,
                                               const SmoothingProblem& problem) {
  const auto on_feature = [&](Index v) { return problem.classes.classes[v] != VertexClass::smooth; };
  std::vector<std::pair<Vec3, Vec3>> edges;
  for (const Triangle& t : problem.triangles)
    for (unsigned k = 0; k < 3; ++k)
      if (on_feature(t[k]) && on_feature(t[next(k)]))
        edges.emplace_back(positions[t[k]], positions[t[next(k)]]);
  return edges;
}

/// Everything that the tests look at, from one run per mesh.
struct Smoothed {
  TriangleMesh before, after;
  SmoothingProblem problem;
  BoundedResult result;
};

class Corpus : public testing::TestWithParam<std::string> {
 protected:
  static const Smoothed& smoothed() {
    static std::map<std::string, Smoothed> cache;
    const auto found = cache.find(GetParam());
    if (found != cache.end()) return found->second;
    TriangleMesh before = read_mesh(std::string(ISORELAX_CORPUS_DIR "/") + GetParam() + ".off").mesh;
    const ProblemOptions options;
    SmoothingProblem problem = make_problem(before.positions, before.triangles, options);
    TriangleMesh after = before;
    // The blade's long thin triangles take longer.
    const unsigned iterations = GetParam() == "blade" ? 60 : 40;
    BoundedResult result = run_bounded(
        after.positions, after.triangles, options,
        [](const SmoothingProblem& p) { return make_smoother(p, Solver::automatic); },
        RunOptions{.iterations = iterations}, DeviationLimit{});
    Smoothed smoothed{std::move(before), std::move(after), std::move(problem), std::move(result)};
    return cache.emplace(GetParam(), std::move(smoothed)).first->second;
  }
};

TEST_P(Corpus, NoTriangleIsNewlyInverted) {
  const Smoothed& s = smoothed();
  const auto before = inverted_triangles(s.before.positions, s.before.triangles, s.problem.topology);
  const auto after = inverted_triangles(s.after.positions, s.after.triangles, s.problem.topology);
  EXPECT_LE(after.size(), before.size());
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
}

TEST_P(Corpus, NoEdgeFoldsThatDidNot) {
  const Smoothed& s = smoothed();
  std::size_t folded = 0;
  for (Corner c = 0; c < 3 * s.before.triangles.size(); ++c) {
    const Corner across = s.problem.topology.opposite(c);
    if (across == kNone || across < c) continue;
    const auto turn = [&](const TriangleMesh& m) {
      return dihedral_turn_deg(m.positions, m.triangles, s.problem.topology, c);
    };
    if (turn(s.before) < 150 && turn(s.after) > 150) ++folded;
  }
  EXPECT_EQ(folded, 0U);
}

TEST_P(Corpus, NoTriangleFacesAwayFromTheSurfaceBesideIt) {
  const Smoothed& s = smoothed();
  if (s.problem.plane_normal || !s.result.untangled.moved.empty()) return;  // a run from another surface
  const ClosestPointIndex surface(s.before.positions, s.before.triangles);
  std::size_t away = 0;
  for (Index t = 0; t < s.after.triangle_count(); ++t) {
    const auto& [a, b, c] = s.after.triangles[t];
    const std::vector<Vec3>& x = s.after.positions;
    if (s.problem.treated[t] != 0 && faces_away(surface, s.problem.initial_normals[t], {x[a], x[b], x[c]}))
      ++away;
  }
  EXPECT_EQ(away, 0U);
}

// But one that stood on its surroundings may come to face as they do.
TEST_P(Corpus, NoTriangleTurnsItsBack) {
  const Smoothed& s = smoothed();
  const std::vector<Index>& untangled = s.result.untangled.moved;
  std::size_t turned = 0;
  for (Index i = 0; i < s.before.triangle_count(); ++i) {
    const Triangle& t = s.before.triangles[i];
    if (std::ranges::any_of(t, [&](Index v) { return std::ranges::binary_search(untangled, v); })) continue;
    const auto normal = [&t](const TriangleMesh& m) {
      return area_vector(m.positions[t[0]], m.positions[t[1]], m.positions[t[2]]);
    };
    const auto around = s.problem.surrounding_normals.find(i);
    if (around != s.problem.surrounding_normals.end() && around->second.dot(normal(s.after)) > 0) continue;
    if (normal(s.before).dot(normal(s.after)) < 0) ++turned;
  }
  EXPECT_EQ(turned, 0U);
}

TEST_P(Corpus, TheMeanOfTheSmallestAnglesGrowsAndTheWorstAreNotWorse) {
  const Smoothed& s = smoothed();
  const QualityReport before = measure_quality(s.before);
  const QualityReport after = measure_quality(s.after);
  constexpr double kSameMean = 0.01;
  EXPECT_GT(after.mean_min_angle_deg, before.mean_min_angle_deg - kSameMean);
  EXPECT_GE(after.min_angle_deg, before.min_angle_deg - 1e-9);
  EXPECT_LE(after.max_angle_deg, std::max(before.max_angle_deg, 120.0) + 1e-9);
  EXPECT_LE(after.degenerate, before.degenerate);
  EXPECT_LE(s.result.run.after.energy, s.result.run.before.energy);
  std::printf("%s: smallest angle %.2f -> %.2f, mean %.2f -> %.2f, %u iterations, %.2f s\n",
              GetParam().c_str(), before.min_angle_deg, after.min_angle_deg, before.mean_min_angle_deg,
              after.mean_min_angle_deg, s.result.run.iterations, s.result.run.seconds);
}

TEST_P(Corpus, BoundaryAndCornersStayBitForBit) {
  const Smoothed& s = smoothed();
  for (Index v = 0; v < s.before.vertex_count(); ++v) {
    if (!s.problem.topology.is_boundary(v) && s.problem.classes.classes[v] != VertexClass::corner) continue;
    EXPECT_EQ(s.before.positions[v], s.after.positions[v]) << "vertex " << v;
  }
}

TEST_P(Corpus, RidgesStayWhereTheyAre) {
  const Smoothed& s = smoothed();
  const auto edges = ridge_edges(s.before.positions, s.problem);
  double furthest = 0;
  for (Index v = 0; v < s.before.vertex_count(); ++v) {
    if (s.problem.classes.classes[v] != VertexClass::ridge) continue;
    if (s.before.positions[v] == s.after.positions[v]) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : edges)
      nearest = std::min(nearest, distance_to_segment(s.after.positions[v], a, b));
    furthest = std::max(furthest, nearest);
  }
  EXPECT_LE(furthest, kRidgeDistance * s.problem.mean_edge_length);
}

TEST_P(Corpus, TheSurfaceStaysWhereItIs) {
  EXPECT_LE(smoothed().result.deviation.max, smoothed().result.deviation_limit);
  EXPECT_LE(smoothed().result.deviation_limit, 0.02);
}

TEST_P(Corpus, TheOrderAndTheTrianglesAreKept) {
  const Smoothed& s = smoothed();
  EXPECT_EQ(s.before.triangles, s.after.triangles);
  EXPECT_EQ(s.before.vertex_count(), s.after.vertex_count());
}

/// Meshes on which runs that look at each triangle alone turn one over its neighbours.
class FoldProne : public testing::TestWithParam<std::string> {};

TEST_P(FoldProne, NoStepTurnsATriangleOver) {
  const TriangleMesh mesh = read_mesh(std::string(ISORELAX_CORPUS_DIR "/") + GetParam() + ".off").mesh;
  const SmoothingProblem problem = make_problem(mesh.positions, mesh.triangles, {});
  const auto before = inverted_triangles(mesh.positions, mesh.triangles, problem.topology);
  std::vector<Vec3> positions = mesh.positions;
  const auto steps_of = [&](Smoother& smoother) {
    run(smoother, problem, positions, {.iterations = 40, .tolerance = kPolishTolerance},
        [&](unsigned iteration, const StepRecord& record, std::span<const Vec3> moved) {
          const auto now = inverted_triangles(moved, mesh.triangles, problem.topology);
          EXPECT_TRUE(std::ranges::includes(before, now))
              << "after iteration " << iteration << ", " << step_kind_name(record.kind);
          return true;
        });
  };
  steps_of(*make_smoother(problem, Solver::automatic));
  steps_of(*make_polish(problem, {.goal = PolishGoal::mean, .worst_share = 0}));
}

INSTANTIATE_TEST_SUITE_P(RealMeshes, FoldProne, testing::ValuesIn(names_in(ISORELAX_FOLD_PRONE_MESHES)),
                         [](const auto& mesh) { return mesh.param; });

INSTANTIATE_TEST_SUITE_P(RealMeshes, Corpus, testing::ValuesIn(names_in(ISORELAX_CORPUS_MESHES)),
                         [](const auto& mesh) { return mesh.param; });

}  // namespace
}  // namespace isorelax
