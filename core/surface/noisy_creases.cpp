#include "surface/noisy_creases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <unordered_map>

#include "mesh/disjoint_sets.h"

namespace isorelax {
namespace {

/// How far a part reaches at most, and how low a sliver is, of the mean of the longest edges of the triangles
/// about it.
constexpr double kReach = 4;
constexpr double kLow = 0.25;
/// Surroundings face one way where the sum of their area vectors is at least so long, of their areas.
constexpr double kAgreement = 0.85;
/// Edges of a loop that was drawn.
constexpr std::size_t kLoop = 8;

/// Creases that hang together.
struct Part {
  Eigen::AlignedBox3d box;
  double longest_edges = 0;  // of the triangles about it, added up
  std::size_t triangles = 0;
  Vec3 area_vectors = Vec3::Zero();
  double areas = 0;
  std::size_t edges = 0, along_slivers = 0;
  bool is_loop = true;

  [[nodiscard]] double length() const { return longest_edges / static_cast<double>(triangles); }
  [[nodiscard]] bool is_noise() const {
    return !(is_loop && edges >= kLoop) && 2 * along_slivers >= edges &&
           box.diagonal().norm() < kReach * length() && area_vectors.norm() >= kAgreement * areas;
  }
};

class Parts {
 public:
  Parts(std::span<const FeatureEdge> creases, std::span<const Vec3> positions,
        std::span<const Triangle> triangles, const Topology& topology)
      : x_(positions), triangles_(triangles), topology_(topology), sets_(topology.vertex_count()) {
    std::unordered_map<Index, unsigned> count;
    for (const FeatureEdge& e : creases) {
      sets_.join(e.vertices[0], e.vertices[1]);
      for (const Index v : e.vertices) ++count[v];
    }
    for (const FeatureEdge& e : creases) ++of(e).edges;
    for (const auto& [v, creases_there] : count) {
      if (creases_there != 2) parts_[sets_.find(v)].is_loop = false;
    }
    for (const FeatureEdge& e : creases)
      for (const Index v : e.vertices) add_surroundings(of(e), v);
    for (const FeatureEdge& e : creases) {
      const double lowest = std::min(height_over(e.corner), height_over(topology.opposite(e.corner)));
      if (lowest < kLow * of(e).length()) ++of(e).along_slivers;
    }
  }

  [[nodiscard]] Part& of(const FeatureEdge& e) { return parts_[sets_.find(e.vertices[0])]; }

 private:
  void add_surroundings(Part& part, Index v) const {
    part.box.extend(x_[v]);
    for (const Corner c : topology_.corners_of(v)) {
      const auto& [i, j, k] = triangles_[c / 3];
      const std::array<double, 3> edges = {(x_[i] - x_[j]).norm(), (x_[j] - x_[k]).norm(),
                                           (x_[k] - x_[i]).norm()};
      part.longest_edges += *std::max_element(edges.begin(), edges.end());
      ++part.triangles;
      const Vec3 area = area_vector(x_[i], x_[j], x_[k]);
      part.area_vectors += area;
      part.areas += area.norm();
    }
  }

  /// Height of a triangle over the edge opposite to a corner.
  [[nodiscard]] double height_over(Corner c) const {
    const Triangle& t = triangles_[c / 3];
    const Vec3 from = x_[t[next(c % 3)]];
    const Vec3 edge = x_[t[previous(c % 3)]] - from;
    return (x_[t[c % 3]] - from).cross(edge).norm() / edge.norm();
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  DisjointSets sets_;
  std::unordered_map<Index, Part> parts_;  // by the set of its vertices
};

}  // namespace

void take_out_noise(std::vector<FeatureEdge>& creases, std::span<const Vec3> positions,
                    std::span<const Triangle> triangles, const Topology& topology) {
  Parts parts(creases, positions, triangles, topology);
  std::erase_if(creases, [&](const FeatureEdge& e) { return parts.of(e).is_noise(); });
}

}  // namespace isorelax
