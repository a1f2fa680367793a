#include "surface/vertex_class.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/parallel.h"
#include "surface/feature_edges.h"

namespace isorelax {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Angle of a matrix eigenvalue ratio: a crease with dihedral turn phi between equal areas has l2 / l1 =
/// tan^2(phi / 2).
double spread(double part, double whole) {
  return whole > 0 ? 2 * std::atan(std::sqrt(std::max(0.0, part) / whole)) * kDegrees : 0;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

class Classifier {
 public:
  Classifier(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
             const FeatureOptions& options, VertexClasses& result)
      : x_(positions), triangles_(triangles), topology_(topology), options_(options), r_(result) {}

  /// First pass: all that one vertex's own triangles tell.
  void measure(Index v) {
    const CovarianceEigen eigen = decompose(normal_covariance(x_, triangles_, topology_, v));
    r_.eigenvalues[v] = eigen.values;
    r_.spread_deg[v] = spread(eigen.values[1], eigen.values[0]);
    double angles = 0;
    double sharpest = 0;
    for (const Corner c : topology_.corners_of(v)) {
      const Triangle& t = triangles_[c / 3];
      const unsigned k = c % 3;
      angles += angle_between(x_[t[next(k)]] - x_[v], x_[t[previous(k)]] - x_[v]);
      for (const unsigned side : {next(k), previous(k)})
        sharpest = std::max(sharpest, turn_across(c - k + side));
    }
    r_.sharpest_edge_deg[v] = sharpest;
    r_.angle_defect_deg[v] = (topology_.is_boundary(v) ? 180.0 : 360.0) - angles;
  }

  /// Second pass: lines through the vertex, which need the neighbours' measurements.
  void classify(Index v) {
    const auto line_ends = topology_.is_boundary(v) ? border_neighbours(v) : crease_neighbours(v);
    if (line_ends.size() == 2) {
      r_.turn_deg[v] = 180 - angle_between(x_[line_ends[0]] - x_[v], x_[line_ends[1]] - x_[v]);
    }
    if (topology_.flags(v) & kIsolatedVertex) {
      set(v, VertexClass::corner, 180);
    } else if (topology_.is_boundary(v)) {
      classify_boundary(v, line_ends.size());
    } else {
      classify_interior(v, line_ends.size());
    }
  }

 private:
  void set(Index v, VertexClass c, double margin) {
    r_.classes[v] = c;
    r_.margin_deg[v] = margin;
  }

  void classify_boundary(Index v, std::size_t lines) {
    const bool creased = !crease_neighbours(v).empty();
    const double over = r_.turn_deg[v] - options_.turn_deg;
    if (lines != 2 || creased) return set(v, VertexClass::corner, 180);
    set(v, over > 0 ? VertexClass::corner : VertexClass::boundary, std::abs(over));
  }

  void classify_interior(Index v, std::size_t creases) {
    const double defect = std::abs(r_.angle_defect_deg[v]) - options_.corner_defect_deg;
    if (defect >= 0) return set(v, VertexClass::corner, defect);
    const double spread_over = r_.spread_deg[v] - options_.ridge_angle_deg;
    const double sharp_over = has_sharp_edge(v) ? r_.sharpest_edge_deg[v] - options_.sharp_edge_deg : -180;
    if (spread_over < 0 && sharp_over <= 0)
      return set(v, VertexClass::smooth, std::min(-spread_over, -defect));
    const double third = spread(r_.eigenvalues[v][2], r_.eigenvalues[v][0]) - options_.ridge_angle_deg;
    if (third >= 0) return set(v, VertexClass::corner, third);
    if (creases >= 3) return set(v, VertexClass::corner, std::max(spread_over, sharp_over));
    const double turn = r_.turn_deg[v] - options_.turn_deg;
    if (creases == 2 && turn > 0) return set(v, VertexClass::corner, turn);
    set(v, VertexClass::ridge, std::min({std::max(spread_over, sharp_over), -defect, -third}));
  }

  [[nodiscard]] double turn_across(Corner corner) const {
    return dihedral_turn_deg(x_, triangles_, topology_, corner);
  }

  [[nodiscard]] bool has_sharp_edge(Index v) const {
    return r_.sharpest_edge_deg[v] > options_.sharp_edge_deg &&
           r_.spread_deg[v] >= 0.5 * options_.ridge_angle_deg;
  }

  template <typename Predicate>
  [[nodiscard]] std::vector<Index> neighbours_where(Index v, const Predicate& wanted) const {
    std::vector<Index> found;
    for (const Corner c : topology_.corners_of(v)) {
      const unsigned k = c % 3;
      for (const unsigned side : {next(k), previous(k)}) {
        const Corner edge = c - k + side;  // opposite to this corner: the edge from v to the remaining one
        const Index w = triangles_[c / 3][3 - k - side];
        if (wanted(edge, w) && std::find(found.begin(), found.end(), w) == found.end()) found.push_back(w);
      }
    }
    return found;
  }

  [[nodiscard]] std::vector<Index> border_neighbours(Index v) const {
    return neighbours_where(v, [&](Corner edge, Index) { return topology_.is_boundary_edge(edge); });
  }
  [[nodiscard]] std::vector<Index> crease_neighbours(Index v) const {
    return neighbours_where(v, [&](Corner edge, Index w) {
      return is_crease(options_, turn_across(edge), {r_.spread_deg[v], r_.spread_deg[w]});
    });
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  const FeatureOptions& options_;
  VertexClasses& r_;
};

}  // namespace

std::string_view to_string(VertexClass c) {
  switch (c) {
    case VertexClass::smooth:
      return "smooth";
    case VertexClass::ridge:
      return "ridge";
    case VertexClass::corner:
      return "corner";
    case VertexClass::boundary:
      return "boundary";
  }
  return "unknown";
}

VertexClasses classify_vertices(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                const Topology& topology, const FeatureOptions& options, unsigned threads) {
  const std::size_t n = positions.size();
  VertexClasses result;
  result.classes.assign(n, VertexClass::smooth);
  result.eigenvalues.assign(n, Vec3::Zero());
  for (auto* values : {&result.spread_deg, &result.angle_defect_deg, &result.sharpest_edge_deg,
                       &result.turn_deg, &result.margin_deg}) {
    values->assign(n, 0);
  }
  Classifier classifier(positions, triangles, topology, options, result);
  parallel_for_blocks(n, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) classifier.measure(static_cast<Index>(v));
  });
  parallel_for_blocks(n, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) classifier.classify(static_cast<Index>(v));
  });
  return result;
}

}  // namespace isorelax
