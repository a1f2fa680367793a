#include "quality/inverted.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/parallel.h"
#include "quality/folded_patches.h"
#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

constexpr double kPlanarTolerance = 1e-6;

struct Faces {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;

  [[nodiscard]] Vec3 area_vector_of(std::size_t t) const {
    const auto [a, b, c] = triangles[t];
    return area_vector(positions[a], positions[b], positions[c]);
  }
  [[nodiscard]] bool degenerate(std::size_t t) const {
    return measure_triangle(positions, triangles[t]).degenerate;
  }
};

/// Sum of all area vectors, block by block: the same for any number of threads.
Vec3 total_area_vector(const Faces& faces, unsigned threads) {
  std::vector<Vec3> sums(block_count(faces.triangles.size()), Vec3::Zero());
  parallel_for_blocks(faces.triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) sums[begin / kBlockSize] += faces.area_vector_of(t);
  });
  Vec3 total = Vec3::Zero();
  for (const Vec3& sum : sums) total += sum;
  return total;
}

/// Whether every vertex in use lies in one plane orthogonal to `normal`.
bool lies_in_plane(const Faces& faces, const Topology& topology, const Vec3& normal) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low = Vec3::Constant(kInfinity);
  Vec3 high = -low;
  double nearest = kInfinity;
  double farthest = -kInfinity;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (topology.corners_of(v).empty()) continue;
    const Vec3& p = faces.positions[v];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    nearest = std::min(nearest, p.dot(normal));
    farthest = std::max(farthest, p.dot(normal));
  }
  return farthest - nearest <= kPlanarTolerance * (high - low).norm();
}

/// Whether the surface folds over across enough of the edges of triangle t.
bool turns_back(const Faces& faces, const Topology& topology, std::size_t t, const Vec3& normal) {
  unsigned neighbours = 0;
  unsigned folds = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner beyond = topology.opposite(static_cast<Corner>(3 * t + k));
    if (beyond == kNone) continue;
    const bool consistent = faces.triangles[beyond / 3][next(beyond % 3)] == faces.triangles[t][previous(k)];
    if (!consistent) continue;
    ++neighbours;
    const Vec3 other = faces.area_vector_of(beyond / 3).stableNormalized();
    if (normal.stableNormalized().dot(other) < kFoldCosine) ++folds;
  }
  return folds > 0 && folds >= std::min(2U, neighbours);
}

/// Whether triangle t faces away from the mean of all triangles that share a vertex with it.
bool opposes_surroundings(const Faces& faces, const Topology& topology, std::size_t t, const Vec3& normal) {
  std::vector<Corner> around;
  for (const Index v : faces.triangles[t]) {
    for (const Corner c : topology.corners_of(v)) around.push_back(c / 3);
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Vec3 mean = Vec3::Zero();
  for (const Corner other : around) mean += faces.area_vector_of(other);
  return normal.stableNormalized().dot(mean.stableNormalized()) < 0;
}

}  // namespace

std::optional<Vec3> plane_normal(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                 const Topology& topology, unsigned threads) {
  const Faces faces{positions, triangles};
  const Vec3 total = total_area_vector(faces, threads);
  const Vec3 normal = total.stableNormalized();
  if (!(normal.norm() > 0) || !lies_in_plane(faces, topology, normal)) return std::nullopt;
  return normal;
}

std::vector<Index> inverted_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                      const Topology& topology, unsigned threads) {
  const Faces faces{positions, triangles};
  const std::optional<Vec3> plane = plane_normal(positions, triangles, topology, threads);
  std::vector<std::uint8_t> folded;
  if (!plane) folded = folded_patches(positions, triangles, topology);
  std::vector<std::vector<Index>> found(block_count(triangles.size()));
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3 normal = faces.area_vector_of(t);
      const bool inverted = plane ? normal.dot(*plane) < 0
                                  : folded[t] != 0 || (turns_back(faces, topology, t, normal) &&
                                                       opposes_surroundings(faces, topology, t, normal));
      if (inverted && !faces.degenerate(t)) found[begin / kBlockSize].push_back(static_cast<Index>(t));
    }
  });
  std::vector<Index> all;
  for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace isorelax
