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
      : x_(positions),
        triangles_(triangles),
        topology_(topology),
        options_(options),
        r_(result),
        lines_(positions.size(), 0) {}

  /// First pass: all that one vertex's own triangles tell.
  void measure(Index v) {
    const CovarianceEigen eigen = decompose(spread_of_normals(v));
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

  /// Covariance of the normals around a vertex, each weighted with the sine of its triangle's angle there:
  /// the area it would have with edges of length one. A long face does not outweigh a short one, and a sliver
  /// counts for little.
  [[nodiscard]] SymmetricMatrix spread_of_normals(Index v) const {
    SymmetricMatrix sum;
    for (const Corner c : topology_.corners_of(v)) {
      const Triangle& t = triangles_[c / 3];
      const Vec3 a = x_[t[next(c % 3)]] - x_[v];
      const Vec3 b = x_[t[previous(c % 3)]] - x_[v];
      const Vec3 n = a.cross(b);
      const double weight = n.norm() * a.norm() * b.norm();
      if (!(weight > 0)) continue;
      const Vec3 weighted = n / std::sqrt(weight);
      sum.add_outer(weighted.x(), weighted.y(), weighted.z());
    }
    return sum;
  }

  /// Second pass: the lines through the vertex, which need the neighbours' measurements.
  void trace_lines(Index v) {
    const auto ends = topology_.is_boundary(v) ? border_neighbours(v) : crease_neighbours(v);
    lines_[v] = static_cast<std::uint8_t>(std::min<std::size_t>(ends.size(), 255));
    if (ends.size() == 2) r_.turn_deg[v] = 180 - angle_between(x_[ends[0]] - x_[v], x_[ends[1]] - x_[v]);
  }

  /// Third pass: needs the neighbours' lines.
  void classify(Index v) {
    if (topology_.flags(v) & kIsolatedVertex) {
      set(v, VertexClass::corner, 180);
    } else if (topology_.is_boundary(v)) {
      classify_boundary(v);
    } else {
      classify_interior(v);
    }
  }

 private:
  void set(Index v, VertexClass c, double margin) {
    r_.classes[v] = c;
    r_.margin_deg[v] = margin;
  }

  void classify_boundary(Index v) {
    const double over = r_.turn_deg[v] - options_.turn_deg;
    if (lines_[v] != 2 || !crease_neighbours(v).empty()) return set(v, VertexClass::corner, 180);
    set(v, over > 0 ? VertexClass::corner : VertexClass::boundary, std::abs(over));
  }

  /// How far an inner vertex is over the nearest of the corner's thresholds, degrees; negative: under all of
  /// them.
  [[nodiscard]] double over_corner(Index v) const {
    const double defect = std::abs(r_.angle_defect_deg[v]) - options_.corner_defect_deg;
    const double third = spread(r_.eigenvalues[v][2], r_.eigenvalues[v][0]) - options_.ridge_angle_deg;
    double over = std::max(defect, third);
    if (lines_[v] >= 3) over = std::max(over, over_ridge(v));
    if (lines_[v] == 2 && over_ridge(v) >= 0) over = std::max(over, r_.turn_deg[v] - options_.turn_deg);
    return over;
  }

  /// How far it is over the ridge's thresholds.
  [[nodiscard]] double over_ridge(Index v) const {
    const double spread_over = r_.spread_deg[v] - options_.ridge_angle_deg;
    return has_sharp_edge(v) ? std::max(spread_over, r_.sharpest_edge_deg[v] - options_.sharp_edge_deg)
                             : spread_over;
  }

  /// A ridge is a line: two crease edges, or one that continues in a line beyond its other end. Normals that
  /// spread without such a line are those of a strongly curved but smooth place.
  [[nodiscard]] bool is_on_line(Index v) const {
    if (lines_[v] >= 2 || has_sharp_edge(v)) return true;
    const auto ends = crease_neighbours(v);
    return ends.size() == 1 && lines_[ends[0]] >= 2 && over_corner(ends[0]) < 0;
  }

  void classify_interior(Index v) {
    const double corner = over_corner(v);
    const double ridge = over_ridge(v);
    if (corner >= 0) return set(v, VertexClass::corner, corner);
    if (ridge >= 0 && is_on_line(v)) return set(v, VertexClass::ridge, std::min(ridge, -corner));
    set(v, VertexClass::smooth, std::min(std::abs(ridge), -corner));
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
  std::vector<std::uint8_t> lines_;  // crease edges at an inner vertex, border edges at a boundary vertex
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
  const auto for_all = [&](auto pass) {
    parallel_for_blocks(n, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) (classifier.*pass)(static_cast<Index>(v));
    });
  };
  for_all(&Classifier::measure);
  for_all(&Classifier::trace_lines);
  for_all(&Classifier::classify);
  return result;
}

}  // namespace isorelax
