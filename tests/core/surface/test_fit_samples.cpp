#include "surface/fit_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "generate/generate.h"

namespace isorelax {
namespace {

/// A mesh in sectors, each with its own number as the x of its sample.
struct Numbered {
  Topology topology;
  Sectors sectors;
  SectorNeighbours neighbours;
  std::vector<FitSample> samples;

  Numbered(const TriangleMesh& mesh, const EdgeWalls& walls)
      : topology(mesh.triangles, mesh.vertex_count()),
        sectors(mesh.triangles, topology, walls),
        neighbours(sectors) {
    for (Index s = 0; s < sectors.count(); ++s)
      samples.push_back({Vec3(static_cast<double>(s), 0, 0), Vec3::UnitZ()});
  }

  std::vector<Index> collect(Index sector, std::size_t wanted) const {
    FitSampler sampler(neighbours, samples);
    std::vector<Index> found;
    for (const FitSample& sample : sampler.collect(sector, wanted))
      found.push_back(static_cast<Index>(sample.point.x()));
    return found;
  }
};

/// The sectors up to `rings` edges away, by looking at all corners again and again.
std::set<Index> rings_about(const Sectors& sectors, Index sector, int rings) {
  std::set<Index> found{sector};
  for (int ring = 0; ring < rings; ++ring) {
    for (const Index s : std::set<Index>(found))
      for (const Corner c : sectors.corners(s))
        for (unsigned k = 0; k < 3; ++k) found.insert(sectors.of(c - c % 3 + k));
  }
  found.erase(sector);
  return found;
}

TEST(FitSampler, TakesWholeRingsEachSectorOnce) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 3, .vertices = 400});
  const Numbered numbered(mesh, EdgeWalls(3 * mesh.triangles.size(), 0));
  for (Index s = 0; s < numbered.sectors.count(); ++s) {
    const std::size_t two = rings_about(numbered.sectors, s, 2).size();
    for (const auto& [wanted, rings] : {std::pair{std::size_t{0}, 2}, {two, 2}, {two + 1, 3}}) {
      const std::vector<Index> found = numbered.collect(s, wanted);
      const std::set<Index> expected = rings_about(numbered.sectors, s, rings);
      EXPECT_EQ(std::set<Index>(found.begin(), found.end()).size(), found.size());
      EXPECT_EQ(found.size(), std::min<std::size_t>(expected.size(), HeightFit::kMaxSamples));
      EXPECT_TRUE(std::ranges::all_of(found, [&](Index f) { return expected.contains(f); }));
    }
  }
}

TEST(FitSampler, DoesNotCrossAWall) {
  // A wall about one triangle: three sectors that know each other only.
  const TriangleMesh mesh = generate(ShapeKind::hexagonal_square, {.seed = 1, .triangles = 200, .jitter = 0});
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const auto inside = static_cast<Index>(mesh.triangles.size() / 2);
  EdgeWalls walls(3 * mesh.triangles.size(), 0);
  for (unsigned k = 0; k < 3; ++k) walls[3 * inside + k] = walls[topology.opposite(3 * inside + k)] = 1;
  const Numbered numbered(mesh, walls);
  for (unsigned k = 0; k < 3; ++k)
    EXPECT_EQ(numbered.collect(numbered.sectors.of(3 * inside + k), 60).size(), 2U);
}

TEST(FitSampler, EndsAtTheLargestNumber) {
  const TriangleMesh mesh = generate(ShapeKind::random_sphere, {.seed = 3, .vertices = 400});
  const Numbered numbered(mesh, EdgeWalls(3 * mesh.triangles.size(), 0));
  EXPECT_EQ(numbered.collect(0, 1000).size(), static_cast<std::size_t>(HeightFit::kMaxSamples));
}

}  // namespace
}  // namespace isorelax
