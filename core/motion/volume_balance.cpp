#include "motion/volume_balance.h"

#include <algorithm>
#include <cmath>

#include "surface/deviation.h"

namespace isorelax {

VolumeBalance::VolumeBalance(std::span<const Triangle> triangles, const Topology& topology, unsigned threads)
    : triangles_(triangles.begin(), triangles.end()),
      threads_(threads),
      middles_(triangles, topology, threads) {
  degrees_.resize(topology.vertex_count());
  for (const MiddledEdge& edge : middles_.edges()) {
    ++degrees_[edge.a];
    ++degrees_[edge.b];
  }
  normals_.resize(topology.vertex_count());
  moves_.resize(topology.vertex_count());
  lengths_.resize(topology.vertex_count());
}

BalanceReport VolumeBalance::balance(const FlowMap& map, std::span<const MaterialPoint> points,
                                     std::span<const std::uint8_t> held, double volume,
                                     std::span<Vec3> positions) {
  constexpr double kMostOfEdge = 0.25;
  constexpr double kLargestFactor = 4;
  constexpr int kSecants = 6;
  middles_.measure(map, points, positions);
  std::ranges::fill(normals_, Vec3::Zero());
  for (const Triangle& t : triangles_) {
    const Vec3 area = area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
    for (const Index v : t) normals_[v] += area;
  }
  std::ranges::fill(moves_, Vec3::Zero());
  std::ranges::fill(lengths_, 0.0);
  for (std::size_t e = 0; e < middles_.edges().size(); ++e) {
    const MiddledEdge& edge = middles_.edges()[e];
    const double length = (positions[edge.b] - positions[edge.a]).norm();
    for (const Index v : {edge.a, edge.b}) {
      moves_[v] += middles_.heights()[e] / degrees_[v];
      lengths_[v] += length / degrees_[v];
    }
  }
  for (std::size_t v = 0; v < moves_.size(); ++v) {
    if (held[v] != 0) {
      moves_[v].setZero();
      continue;
    }
    const double norm = normals_[v].norm();
    const Vec3 normal = norm > 0 ? Vec3(normals_[v] / norm) : Vec3::Zero();
    const double most = kMostOfEdge * lengths_[v];
    moves_[v] = std::clamp(moves_[v].dot(normal), -most, most) * normal;
  }

  base_.assign(positions.begin(), positions.end());
  const auto volume_at = [&](double factor) {
    for (std::size_t v = 0; v < base_.size(); ++v) {
      const double most = kMostOfEdge * lengths_[v];
      const double length = factor * moves_[v].norm();
      const double share = std::abs(length) > most ? most / std::abs(length) : 1;
      positions[v] = base_[v] + share * factor * moves_[v];
    }
    return enclosed_volume(positions, triangles_, threads_);
  };
  BalanceReport report;
  report.volume_before = report.volume_after = volume_at(0);
  double last = 0;
  double last_volume = report.volume_before;
  double factor = 0.5;
  for (int i = 0; i < kSecants && last_volume != volume; ++i) {
    const double at = volume_at(factor);
    const double slope = (at - last_volume) / (factor - last);
    last = factor;
    last_volume = at;
    if (!(std::abs(slope) > 0)) break;
    factor = std::clamp(factor + (volume - at) / slope, -kLargestFactor, kLargestFactor);
    if (factor == last) break;
  }
  report.factor = last;
  report.volume_after = volume_at(last);
  for (std::size_t v = 0; v < base_.size(); ++v)
    report.largest = std::max(report.largest, (positions[v] - base_[v]).norm());
  return report;
}

}  // namespace isorelax
