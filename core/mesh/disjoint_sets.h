#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Sets of the numbers below `count`, at first one of each; the representative of each is its smallest
/// member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace isorelax
