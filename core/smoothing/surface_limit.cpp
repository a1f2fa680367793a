#include "smoothing/surface_limit.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Share of the largest distance that may be measured: elsewhere a surface may be a little farther.
constexpr double kMeasured = 0.97;
/// What is left to the limit is counted a little short, for rounding.
constexpr double kRounding = 1e-9;
/// Distances along a line have kinks where it crosses edges of the other surface, and one of those is the
/// farthest point. It is measured at quarters; at eighths where between quarters it could be too far, if the
/// surfaces make no larger an angle than one with this sine (outlines may make any); and likewise about the
/// farthest at smaller and smaller distances.
constexpr double kSlope = 0.25;
/// Share of the limit up to which quarters tell that the surfaces are the same there.
constexpr double kSame = 0.01;
constexpr unsigned kHalvings = 4;
constexpr int kMaxWalk = 1000;
/// Share of a vertex' move that counts at a point from which on it is to blame.
constexpr double kLeastWeight = 0.05;

/// Whether what was so far away is near for sure when it moved by no more than that.
bool is_near_still(double distance, double moved2, double allowed) {
  if (moved2 == 0) return distance <= allowed;
  const double left = (1 - kRounding) * allowed - distance;
  return left > 0 && moved2 < left * left;
}

/// Looks about the farthest point of a line that was seen, at finer and finer steps. `look` tells the
/// distance at a share of the line.
template <typename Look>
void refine(const Look& look, double step, double& share, double& distance, double allowed) {
  for (unsigned i = 0; i < kHalvings && distance <= allowed; ++i, step *= 0.5) {
    for (const double there : {std::max(0.0, share - step), std::min(1.0, share + step)}) {
      const double found = look(there);
      if (found <= distance) continue;
      distance = found;
      share = there;
      break;
    }
  }
}

}  // namespace

SurfaceLimit::SurfaceLimit(const SmoothingProblem& problem) : problem_(problem) {
  if (!problem.near) return;
  const NearSurface& near = *problem.near;
  const Topology& topology = problem.topology;
  allowed_ = kMeasured * near.distance;
  last_ = near.positions;
  moved_.assign(last_.size(), 0);
  stirred_ = moved_;
  const auto add_line = [&](const std::array<Index, 2>& ends, Index triangle, std::uint32_t probes) {
    const double length = (near.positions[ends[1]] - near.positions[ends[0]]).norm();
    lines_.push_back(
        {ends, static_cast<std::uint32_t>(probes_.size()), probes, length, {0, 0.5, triangle}, 0});
    probes_.insert(probes_.end(), probes, {triangle, corners_of(near.positions, triangle), 0});
  };
  for (Index v = 0; v < problem.vertex_count(); ++v) {
    const auto corners = topology.corners_of(v);
    if (near.kept[v] != 0 && !corners.empty()) add_line({v, v}, corners[0] / 3, 1);
  }
  for (Corner c = 0; c < 3 * problem.triangle_count(); ++c) {
    if (topology.opposite(c) != kNone && topology.opposite(c) < c) continue;
    const Triangle& t = problem.triangles[c / 3];
    const std::array<Index, 2> ends = {t[next(c % 3)], t[previous(c % 3)]};
    if (near.kept[ends[0]] == 0 && near.kept[ends[1]] == 0) continue;
    edges_.push_back({ends, {near.positions[ends[0]], near.positions[ends[1]]}, 0, 0, c / 3});
    add_line(ends, c / 3, 3);
  }
}

SurfaceLimit::Corners SurfaceLimit::corners_of(std::span<const Vec3> x, Index triangle) const {
  const auto& [a, b, c] = problem_.triangles[triangle];
  return {x[a], x[b], x[c]};
}

Vec3 SurfaceLimit::point_of(const Line& line, double share) const {
  const std::vector<Vec3>& then = problem_.near->positions;
  return (1 - share) * then[line.ends[0]] + share * then[line.ends[1]];
}

/// From triangle to triangle as long as that comes nearer: over the edge or about the vertex that the closest
/// point lies on.
SurfacePoint SurfaceLimit::walk(std::span<const Vec3> x, const Vec3& point, Index triangle) const {
  const auto foot = [&](Index t) {
    const Corners y = corners_of(x, t);
    SurfacePoint found = closest_point_of_triangle(point, y[0], y[1], y[2]);
    found.triangle = t;
    return found;
  };
  SurfacePoint best = foot(triangle);
  for (int step = 0; step < kMaxWalk; ++step) {
    SurfacePoint nearest = best;
    const auto look_at = [&](Index t) {
      const SurfacePoint found = foot(t);
      if (found.distance < nearest.distance) nearest = found;
    };
    for (unsigned k = 0; k < 3; ++k) {
      const Corner opposite = problem_.topology.opposite(3 * best.triangle + k);
      if (best.barycentric[k] == 1) {
        for (const Corner c : problem_.topology.corners_of(problem_.triangles[best.triangle][k]))
          look_at(c / 3);
      } else if (best.barycentric[k] == 0 && opposite != kNone) {
        look_at(opposite / 3);
      }
    }
    if (nearest.triangle == best.triangle) break;
    best = nearest;
  }
  return best;
}

/// A walk mostly ends at the closest point of all; where it leads too far, that is looked for.
SurfacePoint SurfaceLimit::nearest_then(const Vec3& point, Index triangle) const {
  const SurfacePoint found = walk(problem_.near->positions, point, triangle);
  return found.distance <= allowed_ ? found : problem_.near->surface->closest(point, found.triangle);
}

double SurfaceLimit::slope_along(const std::array<Index, 2>& ends) const {
  return problem_.topology.is_boundary(ends[0]) && problem_.topology.is_boundary(ends[1]) ? 1 : kSlope;
}

/// Whether what was measured at the quarters of a line tells whether it is near.
bool SurfaceLimit::is_settled(double distance, double slope, double length) const {
  const bool same = distance <= kSame * allowed_ && slope < 1;
  return distance > allowed_ || same || distance + slope * length / 8 <= allowed_;
}

void SurfaceLimit::measure(std::span<const Vec3> x, Edge& edge) const {
  const Vec3& a = x[edge.vertices[0]];
  const Vec3& b = x[edge.vertices[1]];
  const double moved2 = std::max((a - edge.ends[0]).squaredNorm(), (b - edge.ends[1]).squaredNorm());
  if (is_near_still(edge.distance, moved2, allowed_)) return;
  edge.ends = {a, b};
  edge.distance = 0;
  edge.share = 0.5;
  const auto distance_at = [&](double share) {
    const SurfacePoint found = nearest_then((1 - share) * a + share * b, edge.near);
    edge.near = found.triangle;
    return found.distance;
  };
  const auto look = [&](double share) {
    const double distance = distance_at(share);
    if (distance > edge.distance) edge.distance = distance, edge.share = share;
  };
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) look(share);
  const double slope = slope_along(edge.vertices);
  if (is_settled(edge.distance, slope, (b - a).norm())) return;
  for (const double share : {0.125, 0.375, 0.625, 0.875}) look(share);
  if (edge.distance + slope * (b - a).norm() / 16 > allowed_)
    refine(distance_at, 0.0625, edge.share, edge.distance, allowed_);
}

/// A bound on the distance of a point of then, which is measured where the last one does not do.
double SurfaceLimit::probe(std::span<const Vec3> x, const Vec3& point, Probe& last) const {
  const Corners here = corners_of(x, last.triangle);
  double moved2 = 0;
  for (unsigned k = 0; k < 3; ++k) moved2 = std::max(moved2, (here[k] - last.corners[k]).squaredNorm());
  if (is_near_still(last.distance, moved2, allowed_)) return last.distance + std::sqrt(moved2);
  const SurfacePoint found = walk(x, point, last.triangle);
  last = {found.triangle, corners_of(x, found.triangle), found.distance};
  return found.distance;
}

SurfaceLimit::Peak SurfaceLimit::peak_of(std::span<const Vec3> x, const Line& line) {
  Peak peak;
  for (std::uint32_t i = 0; i < line.probes; ++i) {
    const double share = (i + 1.0) / (line.probes + 1.0);
    Probe& last = probes_[line.first_probe + i];
    const double bound = probe(x, point_of(line, share), last);
    if (bound > peak.bound || peak.triangle == kNone) peak = {bound, share, last.triangle};
  }
  const double slope = slope_along(line.ends);
  if (is_settled(peak.bound, slope, line.length)) return peak;
  const auto distance_at = [&](double share) {
    const SurfacePoint found = walk(x, point_of(line, share), peak.triangle);
    peak.triangle = found.triangle;
    return found.distance;
  };
  for (const double share : {0.0, 0.125, 0.375, 0.625, 0.875, 1.0}) {
    const double distance = distance_at(share);
    if (distance > peak.bound) peak.bound = distance, peak.share = share;
  }
  if (peak.bound + slope * line.length / 16 > allowed_)
    refine(distance_at, 0.0625, peak.share, peak.bound, allowed_);
  return peak;
}

void SurfaceLimit::blame_edge(const Edge& edge, std::span<const Vec3> x, Blame blame,
                              std::vector<Excess>& to) const {
  const double least = blame == Blame::all ? 0 : kLeastWeight;
  const Vec3 point = (1 - edge.share) * x[edge.vertices[0]] + edge.share * x[edge.vertices[1]];
  const Vec3 outwards = (point - nearest_then(point, edge.near).point).stableNormalized();
  if (1 - edge.share >= least) to.push_back({edge.vertices[0], outwards});
  if (edge.share >= least) to.push_back({edge.vertices[1], outwards});
}

void SurfaceLimit::blame_about(const Line& line, const Peak& peak, std::span<const Vec3> x, Blame blame,
                               std::vector<Excess>& to) const {
  const Vec3 point = point_of(line, peak.share);
  const SurfacePoint found = walk(x, point, peak.triangle);
  const Vec3 outwards = (found.point - point).stableNormalized();
  for (unsigned k = 0; k < 3; ++k) {
    const Index v = problem_.triangles[found.triangle][k];
    if (blame == Blame::movers) {
      if (found.barycentric[k] >= kLeastWeight) to.push_back({v, outwards});
      continue;
    }
    for (const Corner c : problem_.topology.corners_of(v))
      for (const Index w : problem_.triangles[c / 3]) to.push_back({w, outwards});
  }
}

std::vector<SurfaceLimit::Excess> SurfaceLimit::too_far(std::span<const Vec3> x, Blame blame) {
  std::vector<Excess> all;
  if (!problem_.near) return all;
  const auto collect = [&](std::size_t count, const auto& check) {
    far_.resize(block_count(count));
    parallel_for_blocks(count, problem_.threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Excess>& far = far_[begin / kBlockSize];
      far.clear();
      for (std::size_t i = begin; i < end; ++i) check(i, far);
    });
    for (const auto& far : far_) all.insert(all.end(), far.begin(), far.end());
  };
  collect(edges_.size(), [&](std::size_t i, std::vector<Excess>& far) {
    measure(x, edges_[i]);
    if (edges_[i].distance > allowed_) blame_edge(edges_[i], x, blame, far);
  });
  note_moves(x);
  collect(lines_.size(), [&](std::size_t i, std::vector<Excess>& far) {
    Line& line = lines_[i];
    if (!is_as_measured(line)) {
      line.peak = peak_of(x, line);
      line.measured = call_;
    }
    if (line.peak.bound > allowed_) blame_about(line, line.peak, x, blame, far);
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const Excess& a, const Excess& b) { return a.vertex < b.vertex; });
  return all;
}

void SurfaceLimit::note_moves(std::span<const Vec3> x) {
  ++call_;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (x[v] != last_[v]) moved_[v] = call_;
  for (const auto& [a, b, c] : problem_.triangles) {
    const std::uint32_t last = std::max({moved_[a], moved_[b], moved_[c]});
    for (const Index v : {a, b, c}) stirred_[v] = std::max(stirred_[v], last);
  }
  last_.assign(x.begin(), x.end());
}

/// Whether a corner of the triangle, or a neighbour of one, has moved.
bool SurfaceLimit::has_moved_since(Index triangle, std::uint32_t call) const {
  const Triangle& t = problem_.triangles[triangle];
  return std::any_of(t.begin(), t.end(), [&](Index v) { return stirred_[v] > call; });
}

/// Whether nothing that was near to a line has moved since.
bool SurfaceLimit::is_as_measured(const Line& line) const {
  if (has_moved_since(line.peak.triangle, line.measured)) return false;
  for (std::uint32_t i = 0; i < line.probes; ++i)
    if (has_moved_since(probes_[line.first_probe + i].triangle, line.measured)) return false;
  return true;
}

void SurfaceLimit::start(std::span<const Vec3> x) {
  if (!problem_.near) return;
  edges_at_.assign(problem_.vertex_count(), {});
  for (Index e = 0; e < edges_.size(); ++e)
    for (const Index v : edges_[e].vertices) edges_at_[v].push_back(e);
  lines_near_.assign(problem_.triangle_count(), {});
  for (Index i = 0; i < lines_.size(); ++i) {
    static_cast<void>(peak_of(x, lines_[i]));
    for (std::uint32_t k = 0; k < lines_[i].probes; ++k)
      lines_near_[probes_[lines_[i].first_probe + k].triangle].push_back(i);
  }
}

bool SurfaceLimit::keeps(std::span<const Vec3> x, Index vertex) {
  if (!problem_.near) return true;
  for (const Index e : edges_at_[vertex]) {
    measure(x, edges_[e]);
    if (edges_[e].distance > allowed_) return false;
  }
  std::vector<Index> concerned;
  for (const Corner c : problem_.topology.corners_of(vertex))
    concerned.insert(concerned.end(), lines_near_[c / 3].begin(), lines_near_[c / 3].end());
  std::sort(concerned.begin(), concerned.end());
  concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
  std::vector<Probe> before;
  bool kept = true;
  for (const Index i : concerned) {
    const auto first = probes_.begin() + lines_[i].first_probe;
    before.insert(before.end(), first, first + lines_[i].probes);
    kept = kept && peak_of(x, lines_[i]).bound <= allowed_;
  }
  auto old = before.begin();
  for (const Index i : concerned) {
    for (std::uint32_t k = 0; k < lines_[i].probes; ++k, ++old) {
      Probe& now = probes_[lines_[i].first_probe + k];
      if (!kept) now = *old;
      if (now.triangle != old->triangle) lines_near_[now.triangle].push_back(i);
    }
  }
  return kept;
}

}  // namespace isorelax
