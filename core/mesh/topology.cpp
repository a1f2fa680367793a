#include "mesh/topology.h"

#include <algorithm>

namespace isorelax {
namespace {

struct HalfEdge {
  Index far_end;  // the larger of the edge's two vertices; the smaller one is the bucket
  Corner corner;  // opposite to the edge
};

/// Whether the triangle of `corner` runs along the edge opposite to it from `from` to the other end.
bool runs_from(std::span<const Triangle> triangles, Corner corner, Index from) {
  return triangles[corner / 3][next(corner % 3)] == from;
}

}  // namespace

Topology::Topology(std::span<const Triangle> triangles, Index vertex_count) : flags_(vertex_count, 0) {
  offsets_.assign(vertex_count + 1U, 0);
  for (const Triangle& t : triangles) {
    for (const Index v : t) ++offsets_[v + 1U];
  }
  for (Index v = 0; v < vertex_count; ++v) {
    if (offsets_[v + 1U] == 0) flags_[v] = kIsolatedVertex;
    offsets_[v + 1U] += offsets_[v];
  }
  corners_.resize(3 * triangles.size());
  std::vector<std::uint32_t> fill(offsets_.begin(), offsets_.end() - 1);
  for (Corner c = 0; c < corners_.size(); ++c) corners_[fill[triangles[c / 3][c % 3]]++] = c;
  pair_edges(triangles);
  find_several_fans(triangles);
}

void Topology::pair_edges(std::span<const Triangle> triangles) {
  const std::size_t corner_count = 3 * triangles.size();
  opposite_.assign(corner_count, kNone);
  edge_triangles_.assign(corner_count, 0);

  std::vector<std::uint32_t> start(flags_.size() + 1, 0);
  const auto ends = [&](Corner c) {
    const Triangle& t = triangles[c / 3];
    return std::minmax(t[next(c % 3)], t[previous(c % 3)]);
  };
  for (Corner c = 0; c < corner_count; ++c) ++start[ends(c).first + 1U];
  for (std::size_t v = 0; v < flags_.size(); ++v) start[v + 1] += start[v];
  std::vector<HalfEdge> half_edges(corner_count);
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  for (Corner c = 0; c < corner_count; ++c) {
    const auto [near_end, far_end] = ends(c);
    half_edges[fill[near_end]++] = {far_end, c};
  }

  for (Index v = 0; v < flags_.size(); ++v) {
    const auto first = half_edges.begin() + start[v];
    const auto last = half_edges.begin() + start[v + 1U];
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return a.far_end != b.far_end ? a.far_end < b.far_end : a.corner < b.corner;
    });
    for (auto group = first; group != last;) {
      const auto end =
          std::find_if(group, last, [&](const HalfEdge& h) { return h.far_end != group->far_end; });
      const auto count = end - group;
      const Index w = group->far_end;
      if (w == v) {
        flags_[v] |= kRepeatedVertex;
      } else {
        for (auto h = group; h != end; ++h)
          edge_triangles_[h->corner] = static_cast<std::uint8_t>(std::min<long>(count, 255));
        std::uint8_t flag = 0;
        if (count == 1) flag = kBoundaryVertex;
        if (count > 2) flag = kNonManifoldVertex;
        if (count == 2) {
          const Corner a = group[0].corner;
          const Corner b = group[1].corner;
          opposite_[a] = b;
          opposite_[b] = a;
          if (runs_from(triangles, a, v) == runs_from(triangles, b, v)) flag = kInconsistentVertex;
        }
        flags_[v] |= flag;
        flags_[w] |= flag;
      }
      group = end;
    }
  }
  // The third vertex of a triangle that names another one twice cannot be treated either.
  for (const Triangle& t : triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) continue;
    for (const Index v : t) flags_[v] |= kRepeatedVertex;
  }
}

/// From the triangle beyond the edge opposite to `edge`: the corner whose edge also holds `pivot` and leads
/// on around it. kNone where the fan ends.
Corner Topology::across(std::span<const Triangle> triangles, Corner edge, Index pivot) const {
  const Corner beyond = opposite_[edge];
  if (beyond == kNone) return kNone;
  const Corner base = beyond - beyond % 3;
  for (unsigned k = 0; k < 3; ++k) {
    if (base + k != beyond && triangles[base / 3][k] != pivot) return base + k;
  }
  return kNone;
}

void Topology::find_several_fans(std::span<const Triangle> triangles) {
  constexpr std::uint8_t kUnclear = kNonManifoldVertex | kRepeatedVertex | kIsolatedVertex;
  for (Index v = 0; v < flags_.size(); ++v) {
    if ((flags_[v] & kUnclear) != 0) continue;
    const auto corners = corners_of(v);
    const Corner first = corners.front();
    const Corner base = first - first % 3;
    std::size_t visited = 1;
    bool closed = false;
    for (const unsigned side : {next(first % 3), previous(first % 3)}) {
      for (Corner edge = across(triangles, base + side, v); edge != kNone;
           edge = across(triangles, edge, v)) {
        if (edge - edge % 3 == base) {
          closed = true;
          break;
        }
        ++visited;
      }
      if (closed) break;
    }
    if (visited < corners.size()) flags_[v] |= kNonManifoldVertex;
  }
}

}  // namespace isorelax
