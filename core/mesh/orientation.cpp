#include "mesh/orientation.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace isorelax {
namespace {

std::pair<Index, Index> edge_of(std::span<const Triangle> triangles, Corner corner) {
  const Triangle& t = triangles[corner / 3];
  return std::minmax(t[next(corner % 3)], t[previous(corner % 3)]);
}

/// Triangles beyond crowded edges, for the search to step over: sorted pairs of (triangle, neighbour).
std::vector<std::pair<Index, Index>> crowded_links(std::span<const Triangle> triangles,
                                                   const Topology& topology) {
  std::vector<std::pair<Index, Index>> links;
  for (const auto& corners : crowded_edges(triangles, topology)) {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      links.emplace_back(corners[i - 1] / 3, corners[i] / 3);
      links.emplace_back(corners[i] / 3, corners[i - 1] / 3);
    }
  }
  std::sort(links.begin(), links.end());
  return links;
}

class Search {
 public:
  Search(std::span<const Triangle> triangles, const Topology& topology)
      : triangles_(triangles), topology_(topology), links_(crowded_links(triangles, topology)) {
    found_.component.assign(triangles.size(), kNone);
    found_.turn.assign(triangles.size(), false);
  }

  Orientation run() {
    for (Index t = 0; t < triangles_.size(); ++t) {
      if (found_.component[t] == kNone) spread_from(t);
    }
    return std::move(found_);
  }

 private:
  void spread_from(Index seed) {
    const Index id = found_.component_count++;
    found_.orientable.push_back(true);
    members_.assign(1, seed);
    found_.component[seed] = id;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) {  // NOLINT(modernize-loop-convert): it grows meanwhile
      const Index t = members_[i];
      turned += found_.turn[t] ? 1 : 0;
      for (Corner c = 3 * t; c < 3 * t + 3; ++c) step_across(c, id);
      const auto first = std::lower_bound(links_.begin(), links_.end(), std::pair(t, Index{0}));
      for (auto link = first; link != links_.end() && link->first == t; ++link) reach(link->second, id);
    }
    if (2 * turned > members_.size()) {
      for (const Index t : members_) found_.turn[t] = !found_.turn[t];
    }
  }

  void step_across(Corner corner, Index id) {
    const Corner beyond = topology_.opposite(corner);
    if (beyond == kNone) return;
    const bool turn = found_.turn[corner / 3] == consistent_across(triangles_, topology_, corner);
    if (reach(beyond / 3, id)) {
      found_.turn[beyond / 3] = turn;
    } else if (found_.turn[beyond / 3] != turn) {
      found_.orientable[id] = false;
    }
  }

  bool reach(Index t, Index id) {
    if (found_.component[t] != kNone) return false;
    found_.component[t] = id;
    members_.push_back(t);
    return true;
  }

  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::vector<std::pair<Index, Index>> links_;
  std::vector<Index> members_;
  Orientation found_;
};

}  // namespace

bool consistent_across(std::span<const Triangle> triangles, const Topology& topology, Corner corner) {
  const Corner beyond = topology.opposite(corner);
  return triangles[corner / 3][next(corner % 3)] == triangles[beyond / 3][previous(beyond % 3)];
}

std::vector<std::vector<Corner>> crowded_edges(std::span<const Triangle> triangles,
                                               const Topology& topology) {
  std::vector<std::tuple<std::pair<Index, Index>, Corner>> sides;
  for (Corner c = 0; c < 3 * triangles.size(); ++c) {
    if (topology.edge_triangle_count(c) > 2) sides.emplace_back(edge_of(triangles, c), c);
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::vector<Corner>> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [edge, corner] = sides[i];
    if (i == 0 || std::get<0>(sides[i - 1]) != edge) edges.emplace_back();
    edges.back().push_back(corner);
  }
  return edges;
}

Orientation find_orientation(std::span<const Triangle> triangles, const Topology& topology) {
  return Search(triangles, topology).run();
}

}  // namespace isorelax
