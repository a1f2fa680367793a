#include "smoothing/size_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "surface/deviation.h"

namespace isorelax {
namespace {

constexpr int kAveragingRounds = 2;
/// Curvature times extent below which a surface counts as flat.
constexpr double kFlatCurvature = 1e-6;

class CurvatureField {
 public:
  CurvatureField(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                 const Topology& topology, const CurvatureFieldOptions& options)
      : x_(positions),
        triangles_(triangles),
        topology_(topology),
        options_(options),
        classes_(
            classify_vertices(positions, triangles, topology, options.features, options.threads).classes) {
    find_normals();
  }

  [[nodiscard]] std::vector<double> edge_lengths() const {
    std::vector<double> curvature(x_.size());
    for (Index v = 0; v < x_.size(); ++v) curvature[v] = is_smooth(v) ? curvature_at(v) : -1;
    for (int round = 0; round < kAveragingRounds; ++round) average(curvature);
    double sum = 0;
    std::size_t count = 0;
    for (const double k : curvature) {
      if (k < 0) continue;
      sum += k;
      ++count;
    }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
    const double edge = mean_edge();
    std::vector<double> lengths(x_.size(), edge);
    if (!(mean * bounding_diagonal(x_) > kFlatCurvature)) return lengths;
    for (Index v = 0; v < x_.size(); ++v) {
      if (curvature[v] < 0) continue;
      const double ratio = std::sqrt(mean / std::max(curvature[v], 1e-300));
      lengths[v] = edge * std::clamp(ratio, 1 / options_.range, options_.range);
    }
    limit_gradation(lengths);
    return lengths;
  }

 private:
  [[nodiscard]] bool is_smooth(Index v) const {
    return !topology_.corners_of(v).empty() &&
           (classes_[v] == VertexClass::smooth || classes_[v] == VertexClass::boundary);
  }

  template <typename Visit>
  void for_neighbours(Index v, const Visit& visit) const {
    for (const Corner c : topology_.corners_of(v)) {
      visit(triangles_[c / 3][next(c % 3)]);
      visit(triangles_[c / 3][previous(c % 3)]);
    }
  }

  void find_normals() {
    normals_.assign(x_.size(), Vec3::Zero());
    for (const Triangle& t : triangles_) {
      const Vec3 area = area_vector(x_[t[0]], x_[t[1]], x_[t[2]]);
      for (const Index v : t) normals_[v] += area;
    }
    for (Vec3& n : normals_) n = n.stableNormalized();
  }

  /// Least squares for the shape operator S over the tangent plane: S (x_w - x_v) = n_w - n_v.
  [[nodiscard]] double curvature_at(Index v) const {
    const Vec3& n = normals_[v];
    if (n.isZero(0)) return -1;
    const Vec3 t1 = n.unitOrthogonal();
    const Vec3 t2 = n.cross(t1);
    Eigen::Matrix2d edges = Eigen::Matrix2d::Zero(), turns = Eigen::Matrix2d::Zero();
    for_neighbours(v, [&](Index w) {
      if (!is_smooth(w)) return;
      const Vec3 e = x_[w] - x_[v];
      const double squared = e.squaredNorm();
      if (!(squared > 0)) return;
      const Vec3 dn = normals_[w] - n;
      const Eigen::Vector2d u(e.dot(t1), e.dot(t2)), s(dn.dot(t1), dn.dot(t2));
      edges += u * u.transpose() / squared;
      turns += s * u.transpose() / squared;
    });
    if (!(edges.determinant() > 0.01 * edges.trace() * edges.trace())) return -1;
    const Eigen::Matrix2d shape = turns * edges.inverse();
    const double mean = 0.5 * shape.trace();
    const double across = 0.5 * (shape(0, 1) + shape(1, 0));
    const double apart = std::hypot(0.5 * (shape(0, 0) - shape(1, 1)), across);
    return std::abs(mean) + apart;
  }

  /// One round of means with the neighbours; unknown values (negative) take part in none and get one.
  void average(std::vector<double>& values) const {
    const std::vector<double> old = values;
    for (Index v = 0; v < x_.size(); ++v) {
      double sum = std::max(old[v], 0.0);
      double count = old[v] >= 0 ? 1 : 0;
      for_neighbours(v, [&](Index w) {
        if (old[w] < 0) return;
        sum += 0.5 * old[w];
        count += 0.5;
      });
      if (count > 0) values[v] = sum / count;
    }
  }

  /// Lowers lengths until none exceeds a neighbour's by more than the gradation allows (Dijkstra's order).
  void limit_gradation(std::vector<double>& lengths) const {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
    for (Index v = 0; v < x_.size(); ++v) waiting.emplace(lengths[v], v);
    while (!waiting.empty()) {
      const double length = waiting.top().first;
      const Index v = waiting.top().second;
      waiting.pop();
      if (length > lengths[v]) continue;
      for_neighbours(v, [&](Index w) {
        const double most = lengths[v] + options_.gradation * (x_[w] - x_[v]).norm();
        if (most >= lengths[w]) return;
        lengths[w] = most;
        waiting.emplace(most, w);
      });
    }
  }

  [[nodiscard]] double mean_edge() const {
    double sum = 0;
    for (const Triangle& t : triangles_)
      for (unsigned k = 0; k < 3; ++k) sum += (x_[t[next(k)]] - x_[t[k]]).norm();
    return sum / (3 * static_cast<double>(triangles_.size()));
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  const CurvatureFieldOptions& options_;
  std::vector<VertexClass> classes_;
  std::vector<Vec3> normals_;
};

}  // namespace

std::vector<double> curvature_size_field(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                         const Topology& topology, const CurvatureFieldOptions& options) {
  return CurvatureField(positions, triangles, topology, options).edge_lengths();
}

}  // namespace isorelax
