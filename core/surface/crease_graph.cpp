#include "surface/crease_graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/parallel.h"
#include "surface/feature_edges.h"
#include "surface/noisy_creases.h"

namespace isorelax {
namespace {

/// Creases as a graph: what meets in a vertex, and what is left while lines are taken out.
class CreaseGraph {
 public:
  CreaseGraph(std::vector<FeatureEdge> edges, const Topology& topology, const FeatureOptions& options,
              std::span<const double> turns_deg)
      : edges_(std::move(edges)),
        topology_(topology),
        options_(options),
        turns_(turns_deg),
        at_(topology.vertex_count()),
        kept_(edges_.size(), 1) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const Index v : edges_[e].vertices) at_[v].push_back(e);
  }

  /// Takes out short lines with a free end, and short loops, until there are none left: without one another
  /// may end freely. All that are short at a time go together, so that the numbering of vertices does not
  /// matter.
  std::vector<FeatureEdge> without_short_lines() {
    for (;;) {
      std::vector<std::size_t> out;
      for (Index v = 0; v < at_.size(); ++v) {
        if (!is_free_end(v)) continue;
        const Line line = follow(v);
        if (is_short(line)) out.insert(out.end(), line.edges.begin(), line.edges.end());
      }
      for (std::size_t e = 0; e < edges_.size(); ++e)
        if (kept_[e] != 0 && is_in_short_loop(e)) out.push_back(e);
      if (out.empty()) break;
      for (const std::size_t e : out) kept_[e] = 0;
    }
    std::vector<FeatureEdge> left;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (kept_[e] != 0) left.push_back(edges_[e]);
    return left;
  }

 private:
  struct Line {
    std::vector<std::size_t> edges;
    Index end;
  };

  [[nodiscard]] std::size_t count_at(Index v) const {
    return static_cast<std::size_t>(
        std::count_if(at_[v].begin(), at_[v].end(), [&](std::size_t e) { return kept_[e] != 0; }));
  }
  [[nodiscard]] bool is_free_end(Index v) const { return !topology_.is_boundary(v) && count_at(v) == 1; }

  /// From a free end to where the line ends, branches or meets the border.
  [[nodiscard]] Line follow(Index v) const {
    const std::size_t only = beyond(v, edges_.size());
    Line line{{only}, other_end(only, v)};
    while (!topology_.is_boundary(line.end) && count_at(line.end) == 2) {
      line.edges.push_back(beyond(line.end, line.edges.back()));
      line.end = other_end(line.edges.back(), line.end);
    }
    return line;
  }

  /// The next edge of a line that comes to a vertex by this one. Precondition: there is another.
  [[nodiscard]] std::size_t beyond(Index v, std::size_t edge) const {
    return *std::find_if(at_[v].begin(), at_[v].end(),
                         [&](std::size_t e) { return kept_[e] != 0 && e != edge; });
  }

  [[nodiscard]] Index other_end(std::size_t edge, Index v) const {
    const auto& ends = edges_[edge].vertices;
    return ends[0] == v ? ends[1] : ends[0];
  }

  /// A loop that few edges close, and that meets other creases in one vertex at most, goes around a single
  /// pimple or dent of the mesh.
  [[nodiscard]] bool is_in_short_loop(std::size_t edge) const {
    for (const Index start : edges_[edge].vertices) {
      Index at = other_end(edge, start);
      std::size_t last = edge;
      for (unsigned edges = 1; edges < options_.least_crease_edges; ++edges) {
        if (at == start) return true;
        if (topology_.is_boundary(at) || count_at(at) != 2) break;
        last = beyond(at, last);
        at = other_end(last, at);
      }
    }
    return false;
  }

  [[nodiscard]] bool is_short(const Line& line) const {
    // What meets nothing at either end has to be twice as long.
    const bool alone = is_free_end(line.end);
    if (line.edges.size() >= (alone ? 2 : 1) * options_.least_crease_edges) return false;
    double turn = 0;
    for (const std::size_t e : line.edges) turn += turns_[edges_[e].corner];
    const bool sharp = turn > options_.sharp_edge_deg * static_cast<double>(line.edges.size());
    return alone || !sharp;
  }

  std::vector<FeatureEdge> edges_;
  const Topology& topology_;
  const FeatureOptions& options_;
  std::span<const double> turns_;
  std::vector<std::vector<std::size_t>> at_;
  std::vector<std::uint8_t> kept_;
};

/// Looks for gentle edges that lead from the free end of a line to another line.
class GapBridge {
 public:
  GapBridge(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
            const FeatureOptions& options, std::span<const double> turns_deg,
            const std::vector<FeatureEdge>& creases)
      : x_(positions),
        triangles_(triangles),
        topology_(topology),
        options_(options),
        turns_(turns_deg),
        creases_(topology.vertex_count()) {
    for (const FeatureEdge& e : creases) {
      creases_[e.vertices[0]].push_back(e.vertices[1]);
      creases_[e.vertices[1]].push_back(e.vertices[0]);
    }
  }

  /// The edges of all gaps, each once.
  [[nodiscard]] std::vector<FeatureEdge> edges() const {
    std::vector<FeatureEdge> all;
    for (Index v = 0; v < creases_.size(); ++v) {
      if (creases_[v].size() != 1 || topology_.is_boundary(v)) continue;
      const std::vector<FeatureEdge> gap = from(creases_[v][0], v);
      all.insert(all.end(), gap.begin(), gap.end());
    }
    std::ranges::sort(all, {}, &FeatureEdge::corner);
    const auto same = [](const FeatureEdge& a, const FeatureEdge& b) { return a.corner == b.corner; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    return all;
  }

 private:
  static constexpr std::size_t kLongest = 16;
  static constexpr double kGentlest = 0.5;     // of the ridge angle
  static constexpr double kStraightest = 0.7;  // cosine of the largest turn of the line
  static constexpr double kStandsOut = 1.5;    // times the next edge at a vertex

  /// The way on from `at`, where a line from `before` ends; empty where it leads nowhere.
  [[nodiscard]] std::vector<FeatureEdge> from(Index before, Index at) const {
    std::vector<FeatureEdge> gap;
    while (gap.size() < kLongest) {
      const std::optional<FeatureEdge> edge = next_edge(before, at);
      if (!edge) break;
      gap.push_back(*edge);
      before = at;
      at = edge->vertices[0] == before ? edge->vertices[1] : edge->vertices[0];
      if (!creases_[at].empty() || topology_.is_boundary(at)) return gap;
    }
    return {};
  }

  /// The one edge at a vertex that stands out and goes on as the line came.
  [[nodiscard]] std::optional<FeatureEdge> next_edge(Index before, Index at) const {
    const Vec3 came = (x_[at] - x_[before]).stableNormalized();
    std::optional<FeatureEdge> found;
    double most = kGentlest * options_.ridge_angle_deg, second = 0;
    for (const Corner own : topology_.corners_of(at)) {
      // Of the two edges at the vertex the one that the corner after it looks at: all of them, once.
      const Corner c = own - own % 3 + next(own % 3);
      const Corner other = topology_.opposite(c);
      const Index end = triangles_[own / 3][previous(own % 3)];
      if (other == kNone || end == before) continue;
      if (turns_[c] <= most) {
        second = std::max(second, turns_[c]);
        continue;
      }
      if (found) second = most;
      most = turns_[c];
      found = FeatureEdge{{at, end}, std::min(c, other)};
    }
    if (!found || most < kStandsOut * second) return {};
    const Vec3 goes = (x_[found->vertices[1]] - x_[at]).stableNormalized();
    return came.dot(goes) > kStraightest ? found : std::nullopt;
  }

  std::span<const Vec3> x_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  const FeatureOptions& options_;
  std::span<const double> turns_;
  std::vector<std::vector<Index>> creases_;  // the other ends, by vertex
};

/// Vertices where creases go every which way: at least four, and half of the edges. Flat surroundings tell a
/// corner from them, and so does how far its angles are from those of a plane.
std::vector<std::uint8_t> webs(std::span<const FeatureEdge> creases, const Topology& topology,
                               const FeatureOptions& options, std::span<const double> angle_defect_deg) {
  constexpr std::size_t kMany = 4;
  constexpr double kPeak = 0.75;
  std::vector<std::uint8_t> count(topology.vertex_count(), 0);
  for (const FeatureEdge& e : creases)
    for (const Index v : e.vertices) count[v] = static_cast<std::uint8_t>(std::min(count[v] + 1, 255));
  for (Index v = 0; v < count.size(); ++v) {
    const bool peak = std::abs(angle_defect_deg[v]) >= kPeak * options.corner_defect_deg;
    const bool many = count[v] >= kMany && 2 * std::size_t{count[v]} >= topology.corners_of(v).size();
    count[v] = many && !peak ? 1 : 0;
  }
  return count;
}

/// Sums of the turns of the edges at each vertex that are no creases, and their number.
struct Roughness {
  std::vector<double> sum;
  std::vector<unsigned> count;

  explicit Roughness(std::size_t vertices) : sum(vertices, 0), count(vertices, 0) {}
  [[nodiscard]] double mean(const std::array<Index, 2>& ends) const {
    const unsigned edges = count[ends[0]] + count[ends[1]];
    return edges == 0 ? 0 : (sum[ends[0]] + sum[ends[1]]) / edges;
  }
};

}  // namespace

std::vector<double> dihedral_turns_deg(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                       const Topology& topology, unsigned threads) {
  std::vector<double> turns(3 * triangles.size(), 0);
  parallel_for_blocks(triangles.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (Corner c = static_cast<Corner>(3 * begin); c < 3 * end; ++c)
      turns[c] = dihedral_turn_deg(positions, triangles, topology, c);
  });
  return turns;
}

std::vector<FeatureEdge> find_creases(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                      const Topology& topology, const FeatureOptions& options,
                                      std::span<const double> turns_deg, std::span<const double> spread_deg,
                                      std::span<const double> angle_defect_deg) {
  std::vector<FeatureEdge> creases;
  Roughness roughness(topology.vertex_count());
  for (Corner c = 0; c < 3 * triangles.size(); ++c) {
    if (topology.opposite(c) == kNone || topology.opposite(c) < c) continue;
    const std::array<Index, 2> ends = {triangles[c / 3][next(c % 3)], triangles[c / 3][previous(c % 3)]};
    if (is_crease(options, turns_deg[c], {spread_deg[ends[0]], spread_deg[ends[1]]})) {
      creases.push_back({ends, c});
      continue;
    }
    for (const Index v : ends) {
      roughness.sum[v] += turns_deg[c];
      ++roughness.count[v];
    }
  }
  std::erase_if(creases, [&](const FeatureEdge& e) {
    return turns_deg[e.corner] < options.over_roughness * roughness.mean(e.vertices);
  });
  const std::vector<std::uint8_t> in_web = webs(creases, topology, options, angle_defect_deg);
  std::erase_if(creases, [&](const FeatureEdge& e) {
    return turns_deg[e.corner] <= options.sharp_edge_deg && in_web[e.vertices[0]] + in_web[e.vertices[1]] > 0;
  });
  creases = CreaseGraph(std::move(creases), topology, options, turns_deg).without_short_lines();
  take_out_noise(creases, positions, triangles, topology);
  if (!(options.ridge_angle_deg < 180)) return creases;
  const std::vector<FeatureEdge> gaps =
      GapBridge(positions, triangles, topology, options, turns_deg, creases).edges();
  creases.insert(creases.end(), gaps.begin(), gaps.end());
  std::ranges::sort(creases, {}, &FeatureEdge::corner);
  return creases;
}

}  // namespace isorelax
