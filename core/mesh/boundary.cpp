#include "mesh/boundary.h"

#include <algorithm>

namespace isorelax {
namespace {

class Walker {
 public:
  Walker(std::span<const Triangle> triangles, const Topology& topology)
      : triangles_(triangles), topology_(topology), visited_(3 * triangles.size(), false) {}

  std::vector<BoundaryLoop> run() {
    std::vector<BoundaryLoop> loops;
    for (Corner c = 0; c < visited_.size(); ++c) {
      if (topology_.is_boundary_edge(c) && !visited_[c]) loops.push_back(loop_through(c));
    }
    return loops;
  }

 private:
  BoundaryLoop loop_through(Corner start) {
    const Index from = triangles_[start / 3][next(start % 3)];
    const Index to = triangles_[start / 3][previous(start % 3)];
    BoundaryLoop loop;
    loop.triangle = start / 3;
    loop.vertices.push_back(from);
    visited_[start] = true;
    loop.closed = follow(start, to, loop.vertices);
    if (loop.closed) {
      loop.vertices.pop_back();  // the first vertex again
    } else {
      std::vector<Index> before;
      follow(start, from, before);
      loop.vertices.insert(loop.vertices.begin(), before.rbegin(), before.rend() - 1);
    }
    return loop;
  }

  /// Appends `pivot` and what follows it along the boundary; true when the walk comes round to its start.
  bool follow(Corner edge, Index pivot, std::vector<Index>& vertices) {
    const Corner start = edge;
    for (;;) {
      vertices.push_back(pivot);
      edge = next_boundary_edge(edge, pivot);
      if (edge == kNone) return false;
      if (edge == start) return true;
      visited_[edge] = true;
      const Triangle& t = triangles_[edge / 3];
      const Index end = t[next(edge % 3)];
      pivot = end == pivot ? t[previous(edge % 3)] : end;
    }
  }

  /// Turns about `pivot` through the fan of the boundary edge's triangle to the fan's other end.
  Corner next_boundary_edge(Corner edge, Index pivot) const {
    for (;;) {
      const Corner base = edge - edge % 3;
      Corner other = kNone;
      for (Corner c = base; c < base + 3; ++c) {
        if (c != edge && triangles_[base / 3][c - base] != pivot) other = c;
      }
      if (other == kNone || topology_.is_boundary_edge(other)) return other;
      edge = topology_.opposite(other);
      if (edge == kNone) return kNone;
    }
  }

  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::vector<bool> visited_;
};

}  // namespace

std::vector<BoundaryLoop> boundary_loops(std::span<const Triangle> triangles, const Topology& topology) {
  return Walker(triangles, topology).run();
}

}  // namespace isorelax
