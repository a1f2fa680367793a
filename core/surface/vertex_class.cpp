#include "surface/vertex_class.h"

#include <algorithm>
#include <cmath>

#include "mesh/angle.h"
#include "mesh/parallel.h"
#include "surface/crease_graph.h"
#include "surface/flat_patches.h"

namespace isorelax {
namespace {

/// A border that turns by no more than this in a vertex runs straight through it, by more than that it does
/// not.
constexpr double kStraightDeg = 0.003;
constexpr double kKinkDeg = 0.05;
constexpr double kRoundingDeg = 1e-6;
/// A meshed flat face ends in an edge that turns by more than this, not in an uneven triangle.
constexpr double kRimDeg = 2;
/// A flat face is meshed for its own sake with as many vertices inside as on its rim; beside another one,
/// with so many for each on the rim.
constexpr double kMeshed = 1;
constexpr double kCoarselyMeshed = 0.25;
/// A peak without a crease is one only if it stands out by this share of its edges' mean length: one of 45
/// degrees by half of it, noise at a short edge by what is noise beside the others.
constexpr double kLeastHeight = 0.2;

/// Angle of a matrix eigenvalue ratio: a crease with dihedral turn phi between equal areas has l2 / l1 =
/// tan^2(phi / 2).
double spread(double part, double whole) {
  return whole > 0 ? 2 * std::atan(std::sqrt(std::max(0.0, part) / whole)) * kDegrees : 0;
}

class Classifier {
 public:
  Classifier(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
             const FeatureOptions& options, VertexClasses& result, std::span<const double> turns_deg)
      : x_(positions),
        triangles_(triangles),
        topology_(topology),
        options_(options),
        r_(result),
        turns_(turns_deg),
        is_crease_(3 * triangles.size(), 0) {}

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
      angles += angle_between_deg(x_[t[next(k)]] - x_[v], x_[t[previous(k)]] - x_[v]);
      for (const unsigned side : {next(k), previous(k)}) sharpest = std::max(sharpest, turns_[c - k + side]);
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

  /// Between the passes: what is_crease_ and the lines go by.
  void find_lines() {
    r_.creases =
        find_creases(x_, triangles_, topology_, options_, turns_, r_.spread_deg, r_.angle_defect_deg);
    for (const FeatureEdge& e : r_.creases) mark_crease(e.corner);
    const bool rims = options_.ridge_angle_deg < 180 &&
                      std::ranges::any_of(turns_, [](double turn) { return turn > kRimDeg; });
    if (!rims && r_.creases.empty()) return;
    flat_ = flat_patches(topology_, turns_, r_.creases);
    if (rims) add_rims();
  }

  /// Second pass: needs the creases.
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
  void mark_crease(Corner c) { is_crease_[c] = is_crease_[topology_.opposite(c)] = 1; }

  /// Where a meshed flat face ends in a turn, however gentle, somebody drew an edge; where it meets another
  /// one, coarser meshes will do.
  void add_rims() {
    const std::vector<double> inner = inner_shares(topology_, flat_);
    const auto are_meshed = [&](Index t, Index u) {
      return std::max(inner[t], inner[u]) >= kMeshed || std::min(inner[t], inner[u]) >= kCoarselyMeshed;
    };
    for (Corner c = 0; c < turns_.size(); ++c) {
      const Corner other = topology_.opposite(c);
      if (other == kNone || other < c || is_crease_[c] != 0 || turns_[c] <= kRimDeg) continue;
      if (flat_[c / 3] == flat_[other / 3] || !are_meshed(c / 3, other / 3)) continue;
      const Triangle& t = triangles_[c / 3];
      r_.creases.push_back({{t[next(c % 3)], t[previous(c % 3)]}, c});
      mark_crease(c);
    }
    std::ranges::sort(r_.creases, {}, &FeatureEdge::corner);
  }

  void set(Index v, VertexClass c, double margin) {
    r_.classes[v] = c;
    r_.margin_deg[v] = margin;
  }

  void classify_boundary(Index v) {
    const std::vector<Index> ends = border_neighbours(v);
    if (ends.size() != 2 || !crease_neighbours(v).empty()) return set(v, VertexClass::corner, 180);
    r_.turn_deg[v] = turn(v, {ends[0], ends[1]});
    // An angle of just the limit is one whichever way it was rounded.
    const double over = r_.turn_deg[v] - options_.boundary_turn_deg - kRoundingDeg;
    if (over <= 0 && ends_a_straight_stretch(v, {ends[0], ends[1]}))
      return set(v, VertexClass::corner, r_.turn_deg[v] - kKinkDeg);
    set(v, over > 0 ? VertexClass::corner : VertexClass::boundary, std::abs(over));
  }

  /// Whether the border runs straight through a neighbour on it, but not through this vertex.
  [[nodiscard]] bool ends_a_straight_stretch(Index v, std::array<Index, 2> neighbours) const {
    if (r_.turn_deg[v] <= kKinkDeg) return false;
    return std::any_of(neighbours.begin(), neighbours.end(), [&](Index w) {
      const std::vector<Index> ends = border_neighbours(w);
      return ends.size() == 2 && turn(w, {ends[0], ends[1]}) <= kStraightDeg;
    });
  }

  /// The flat faces on both sides of an edge, in no order.
  [[nodiscard]] std::array<Index, 2> flat_faces(Index v, Index w) const {
    std::array<Index, 2> found{kNone, kNone};
    unsigned sides = 0;
    for (const Corner c : topology_.corners_of(v)) {
      const Triangle& t = triangles_[c / 3];
      if ((t[0] == w || t[1] == w || t[2] == w) && sides < 2) found[sides++] = flat_[c / 3];
    }
    return {std::min(found[0], found[1]), std::max(found[0], found[1])};
  }

  /// Whether a crease leaves a flat face here, or comes to one: vertices that slide on would take the face's
  /// rim along.
  [[nodiscard]] bool leaves_a_flat_face(Index v, const std::vector<Index>& ends) const {
    return flat_faces(v, ends[0]) != flat_faces(v, ends[1]);
  }

  void classify_interior(Index v) {
    const std::vector<Index> ends = crease_neighbours(v);
    // Without a crease a peak is a corner; a saddle, whose angles are too many, is none.
    const double defect = r_.angle_defect_deg[v];
    const bool is_noise = ends.empty() && defect >= options_.corner_defect_deg && !stands_out(v);
    double corner = (is_noise ? 0 : ends.empty() ? defect : std::abs(defect)) - options_.corner_defect_deg;
    if (ends.size() == 2) {
      r_.turn_deg[v] =
          std::min(turn(v, {ends[0], ends[1]}), turn(v, {beyond(ends[0], v), beyond(ends[1], v)}));
      corner = std::max(corner, r_.turn_deg[v] - options_.turn_deg);
      if (corner < 0 && leaves_a_flat_face(v, ends)) corner = 0;
    } else if (!ends.empty()) {
      corner = std::max({corner, over_ridge(v), 0.0});
    }
    if (corner >= 0) return set(v, VertexClass::corner, corner);
    // What is no crease by its spread is one as the rim of a flat face.
    double ridge = over_ridge(v);
    if (ridge < 0 && !ends.empty()) ridge = r_.sharpest_edge_deg[v] - kRimDeg;
    set(v, ends.empty() ? VertexClass::smooth : VertexClass::ridge, std::min(std::abs(ridge), -corner));
  }

  /// Whether a vertex is farther from the plane about its neighbours than noise on a short edge would bring
  /// it.
  [[nodiscard]] bool stands_out(Index v) const {
    Vec3 normal = Vec3::Zero(), sum = Vec3::Zero();
    double lengths = 0;
    for (const Corner c : topology_.corners_of(v)) {
      const Triangle& t = triangles_[c / 3];
      const Vec3 a = x_[t[next(c % 3)]] - x_[v];
      const Vec3 b = x_[t[previous(c % 3)]] - x_[v];
      normal += a.cross(b);
      sum += a + b;
      lengths += a.norm() + b.norm();
    }
    return std::abs(sum.dot(normal.stableNormalized())) >= kLeastHeight * lengths;
  }

  /// How far the vertex is over the ridge's thresholds.
  [[nodiscard]] double over_ridge(Index v) const {
    const double spread_over = r_.spread_deg[v] - options_.ridge_angle_deg;
    const bool sharp = r_.sharpest_edge_deg[v] > options_.sharp_edge_deg &&
                       r_.spread_deg[v] >= 0.5 * options_.ridge_angle_deg;
    return sharp ? std::max(spread_over, r_.sharpest_edge_deg[v] - options_.sharp_edge_deg) : spread_over;
  }

  /// Turn of the line from one point over the vertex to the other.
  [[nodiscard]] double turn(Index v, std::array<Index, 2> ends) const {
    return 180 - angle_between_deg(x_[ends[0]] - x_[v], x_[ends[1]] - x_[v]);
  }

  /// The next vertex of the line that comes from `behind` to `v`; `v` where it does not run on.
  [[nodiscard]] Index beyond(Index v, Index behind) const {
    const std::vector<Index> ends = crease_neighbours(v);
    if (ends.size() != 2 || topology_.is_boundary(v)) return v;
    return ends[0] == behind ? ends[1] : ends[0];
  }

  template <typename Predicate>
  [[nodiscard]] std::vector<Index> neighbours_where(Index v, const Predicate& wanted) const {
    std::vector<Index> found;
    for (const Corner c : topology_.corners_of(v)) {
      const unsigned k = c % 3;
      for (const unsigned side : {next(k), previous(k)}) {
        const Index w = triangles_[c / 3][3 - k - side];
        // Opposite to this corner: the edge from v to w.
        if (wanted(c - k + side) && std::find(found.begin(), found.end(), w) == found.end())
          found.push_back(w);
      }
    }
    return found;
  }

  [[nodiscard]] std::vector<Index> border_neighbours(Index v) const {
    return neighbours_where(v, [&](Corner edge) { return topology_.is_boundary_edge(edge); });
  }
  [[nodiscard]] std::vector<Index> crease_neighbours(Index v) const {
    return neighbours_where(v, [&](Corner edge) { return is_crease_[edge] != 0; });
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  const FeatureOptions& options_;
  VertexClasses& r_;
  std::span<const double> turns_;        // of the edge opposite to each corner
  std::vector<std::uint8_t> is_crease_;  // likewise
  std::vector<Index> flat_;              // flat face of each triangle; only where there can be creases
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
  const std::vector<double> turns = dihedral_turns_deg(positions, triangles, topology, threads);
  Classifier classifier(positions, triangles, topology, options, result, turns);
  const auto for_all = [&](auto pass) {
    parallel_for_blocks(n, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) (classifier.*pass)(static_cast<Index>(v));
    });
  };
  for_all(&Classifier::measure);
  classifier.find_lines();
  for_all(&Classifier::classify);
  return result;
}

}  // namespace isorelax
