#include "smoothing/lift_moved.h"

#include <algorithm>
#include <vector>

#include "surface/height_fit.h"

namespace isorelax {
namespace {

constexpr unsigned kMaxRings = 6;
constexpr std::size_t kEnoughSamples = 24;
/// Samples whose normals turn farther than this from the vertex' own are another face: cosine of 60 degrees.
constexpr double kSameFace = 0.5;
constexpr double kLargestLift = 0.5;

/// Vertices about `v` that stayed, ring by ring, until there are enough.
std::vector<Index> still_neighbours(Index v, std::span<const Triangle> triangles, const Topology& topology,
                                    std::span<const Vec3> normals, std::span<const std::uint8_t> moved) {
  std::vector<Index> seen{v}, ring{v}, still;
  for (unsigned k = 0; k < kMaxRings && still.size() < kEnoughSamples; ++k) {
    std::vector<Index> grown;
    for (const Index u : ring)
      for (const Corner c : topology.corners_of(u))
        for (const Index w : triangles[c / 3]) {
          if (std::find(seen.begin(), seen.end(), w) != seen.end()) continue;
          seen.push_back(w);
          grown.push_back(w);
          if (moved[w] == 0 && normals[w].dot(normals[v]) > kSameFace) still.push_back(w);
        }
    ring.swap(grown);
  }
  return still;
}

double mean_edge(std::span<const Vec3> x, Index v, std::span<const Triangle> triangles,
                 const Topology& topology) {
  double sum = 0;
  for (const Corner c : topology.corners_of(v))
    sum += (x[triangles[c / 3][next(c % 3)]] - x[v]).norm() +
           (x[triangles[c / 3][previous(c % 3)]] - x[v]).norm();
  return sum / (2.0 * static_cast<double>(topology.corners_of(v).size()));
}

}  // namespace

void lift_moved(std::span<Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
                std::span<const Vec3> vertex_normals, std::span<const std::uint8_t> moved) {
  const std::vector<Vec3> x(positions.begin(), positions.end());
  for (Index v = 0; v < x.size(); ++v) {
    if (moved[v] == 0) continue;
    const std::vector<Index> still = still_neighbours(v, triangles, topology, vertex_normals, moved);
    if (still.empty()) continue;
    const auto nearest = *std::min_element(still.begin(), still.end(), [&](Index a, Index b) {
      return (x[a] - x[v]).squaredNorm() < (x[b] - x[v]).squaredNorm();
    });
    std::vector<FitSample> samples;
    for (const Index w : still)
      if (w != nearest) samples.push_back({x[w], vertex_normals[w]});
    const HeightFit fit(x[nearest], vertex_normals[v], samples, {.degree = 3});
    const Vec3 lift = fit.lift(x[v]) - x[v];
    const double most = kLargestLift * mean_edge(x, v, triangles, topology);
    positions[v] = lift.norm() > most ? Vec3(x[v] + lift * (most / lift.norm())) : Vec3(x[v] + lift);
  }
}

}  // namespace isorelax
