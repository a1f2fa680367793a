#include "mesh/orientation.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace isorelax {
namespace {

std::pair<Index, Index> edge_of(std::span<const Triangle> triangles, Corner corner) {
  const Triangle& t = triangles[corner / 3];
  return std::minmax(t[next(corner % 3)], t[previous(corner % 3)]);
}

/// Spreads over edges with two triangles from patch to patch, then joins patches over edges with more.
class Search {
 public:
  Search(std::span<const Triangle> triangles, const Topology& topology)
      : triangles_(triangles), topology_(topology), patch_(triangles.size(), kNone) {
    found_.component.assign(triangles.size(), kNone);
    found_.turn.assign(triangles.size(), false);
  }

  Orientation run() {
    for (Index t = 0; t < triangles_.size(); ++t) {
      if (patch_[t] == kNone) spread_from(t);
    }
    DisjointSets components(orientable_.size());
    for (const auto& corners : crowded_edges(triangles_, topology_)) {
      for (const Corner c : corners) components.join(patch_[corners[0] / 3], patch_[c / 3]);
    }
    number(components);
    return std::move(found_);
  }

 private:
  void spread_from(Index seed) {
    const auto id = static_cast<Index>(orientable_.size());
    orientable_.push_back(true);
    members_.assign(1, seed);
    patch_[seed] = id;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) {  // NOLINT(modernize-loop-convert): it grows meanwhile
      const Index t = members_[i];
      turned += found_.turn[t] ? 1 : 0;
      for (Corner c = 3 * t; c < 3 * t + 3; ++c) step_across(c, id);
    }
    if (2 * turned > members_.size()) {
      for (const Index t : members_) found_.turn[t] = !found_.turn[t];
    }
  }

  void step_across(Corner corner, Index id) {
    const Corner beyond = topology_.opposite(corner);
    if (beyond == kNone) return;
    const Index t = beyond / 3;
    const bool turn = found_.turn[corner / 3] == consistent_across(triangles_, topology_, corner);
    if (patch_[t] == kNone) {
      patch_[t] = id;
      found_.turn[t] = turn;
      members_.push_back(t);
    } else if (found_.turn[t] != turn) {
      orientable_[id] = false;
    }
  }

  /// Patches stand in the order of their first triangles, and so do components.
  void number(DisjointSets& components) {
    std::vector<Index> component(orientable_.size(), kNone);
    for (Index patch = 0; patch < orientable_.size(); ++patch) {
      const Index first = components.find(patch);
      if (first == patch) {
        component[patch] = found_.component_count++;
        found_.orientable.push_back(true);
      } else {
        component[patch] = component[first];
      }
      if (!orientable_[patch]) found_.orientable[component[patch]] = false;
    }
    for (Index t = 0; t < triangles_.size(); ++t) found_.component[t] = component[patch_[t]];
  }

  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::vector<Index> patch_;      // of every triangle
  std::vector<bool> orientable_;  // per patch
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
