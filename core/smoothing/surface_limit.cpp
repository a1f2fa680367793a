#include "smoothing/surface_limit.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"
#include "smoothing/outline.h"
#include "surface/deviation.h"
#include "surface/feature_edges.h"
#include "surface/walk.h"

namespace isorelax {
namespace {

/// Share of the largest distance that may be seen: what is between that and the bound decides how often edges
/// have to be divided.
constexpr double kSeen = 0.98;
/// Where edges cross, the distances one way and the other differ by the cosine of half the turn of one edge:
/// up to this turn, by no more than what is left above the share that may be proven, with some for rounding.
constexpr double kSharpTurnDeg = 10;
constexpr double kProven = 0.99619469809174555 - 1e-9;
/// Of the diagonal: nearer than that nothing can be told to be.
constexpr double kRoundingShare = 5e-15;
/// An edge is divided that often at most, and not too near to an end.
constexpr unsigned kDivisions = 8;
constexpr double kLeastPart = 0.1;
/// Triangles that an edge is followed over before it is divided instead.
constexpr unsigned kMostParts = 128;
/// Share of a vertex' move that counts at a point from which on it is to blame.
constexpr double kLeastWeight = 0.05;

}  // namespace

/// Not before it is needed: of the solvers of a run, some never step.
void SurfaceLimit::prepare() {
  if (!last_.empty()) return;
  const NearSurface& near = *problem_.near;
  const Topology& topology = problem_.topology;
  const double rounding = kRoundingShare * bounding_diagonal(near.positions);
  seen_ = std::max(kSeen * near.distance, rounding);
  proven_ = std::max(kProven * near.distance, rounding);
  last_ = near.positions;
  travelled_.assign(last_.size(), 0);
  moves_.assign(last_.size(), 0);
  std::vector<std::uint8_t> is_end(last_.size(), 0);
  std::vector<std::array<Index, 2>> sharp;
  for (Corner c = 0; c < 3 * problem_.triangle_count(); ++c) {
    if (topology.opposite(c) != kNone && topology.opposite(c) < c) continue;
    const Triangle& t = problem_.triangles[c / 3];
    const std::array<Index, 2> ends = {t[next(c % 3)], t[previous(c % 3)]};
    // In a plane only the outline can be far from where it was.
    if (problem_.plane_normal && !changes_outline(problem_, near.positions, ends[0], rounding) &&
        !changes_outline(problem_, near.positions, ends[1], rounding))
      continue;
    ends_of_.push_back(ends);
    for (const Index v : ends) is_end[v] = 1;
    if (topology.opposite(c) == kNone ||
        dihedral_turn_deg(near.positions, problem_.triangles, topology, c) > kSharpTurnDeg)
      sharp.push_back(ends);
  }
  count_now_ = ends_of_.size();
  feet_now_.resize(last_.size());
  for (Index v = 0; v < last_.size(); ++v) {
    if (is_end[v] == 0) continue;
    ends_.push_back(v);
    ends_of_.push_back({v, v});
    feet_now_[v] = {topology.corners_of(v)[0] / 3, 0};
  }
  ends_of_.insert(ends_of_.end(), sharp.begin(), sharp.end());
  feet_then_ = feet_now_;
  lines_.assign(ends_of_.size(), {INFINITY, {}, {}});
}

SurfaceLimit::View SurfaceLimit::view_of(std::size_t line, std::span<const Vec3> x) const {
  const std::span<const Vec3> then = problem_.near->positions;
  const auto& [a, b] = ends_of_[line];
  if (is_of_now(line)) return {true, x[a], x[b], then};
  return {false, then[a], then[b], x};
}

SurfacePoint SurfaceLimit::closest_of(const View& view, Index triangle, const Vec3& point) const {
  if (view.now) return problem_.near->surface->closest_of(triangle, point);
  return closest_point_of_triangle(point, view.surface, problem_.triangles, triangle);
}

/// A walk mostly ends at the closest point of all. Where it leads too far, as on the wrong side of a ridge,
/// that is looked for: in the index of the surface as it was, or farther about.
SurfacePoint SurfaceLimit::nearest(const View& view, const Vec3& point, Index triangle) const {
  const Topology& topology = problem_.topology;
  const auto foot = [&](Index t) { return closest_of(view, t, point); };
  const auto walk_from = [&](const SurfacePoint& start) {
    return walk_over_mesh(start, foot, problem_.triangles, topology);
  };
  SurfacePoint found = walk_from(foot(triangle));
  if (found.distance > seen_ && view.now) return problem_.near->surface->closest(point, found.triangle);
  while (found.distance > seen_) {
    SurfacePoint nearer = found;
    for (unsigned k = 0; k < 3; ++k) {
      for (const Corner c : topology.corners_of(problem_.triangles[found.triangle][k])) {
        const SurfacePoint other = foot(c / 3);
        if (other.distance < nearer.distance) nearer = other;
      }
    }
    if (nearer.triangle == found.triangle) break;
    found = walk_from(nearer);
  }
  return found;
}

SurfaceLimit::Foot SurfaceLimit::foot_of(bool now, std::span<const Vec3> x, Index vertex) const {
  const std::span<const Vec3> then = problem_.near->positions;
  const Vec3& point = now ? x[vertex] : then[vertex];
  const SurfacePoint found =
      nearest({now, point, point, now ? then : x}, point, (now ? feet_now_ : feet_then_)[vertex].triangle);
  return {found.triangle, found.distance};
}

void SurfaceLimit::note_use(Line& line, Index vertex) const {
  if (std::ranges::none_of(line.uses, [&](const Use& use) { return use.vertex == vertex; }))
    line.uses.push_back({vertex, travelled_[vertex]});
}

/// Moving a triangle or an end moves no distance by more than that.
bool SurfaceLimit::is_near_still(const Line& line) const {
  const double left = proven_ - line.bound;
  return left >= 0 && std::ranges::all_of(line.uses, [&](const Use& use) {
           return travelled_[use.vertex] - use.travelled <= left;
         });
}

LineBound SurfaceLimit::bound(const View& view, const Sample& a, const Sample& b) const {
  const auto distance = [&](const Sample& at, const Foot& other) {
    if (at.foot.triangle == other.triangle) return at.foot.distance;
    return closest_of(view, other.triangle, view.at(at.share)).distance;
  };
  return bound_between(a.foot.distance, distance(b, a.foot), distance(a, b.foot), b.foot.distance);
}

bool SurfaceLimit::is_near(const View& view, const Sample& a, const Sample& b, unsigned divisions,
                           Line& line) const {
  const LineBound most = bound(view, a, b);
  if (most.distance <= proven_) {
    line.bound = std::max(line.bound, most.distance);
    if (!view.now) {
      for (const Index t : {a.foot.triangle, b.foot.triangle})
        for (const Index v : problem_.triangles[t]) note_use(line, v);
    }
    return true;
  }
  if (divisions == 0) return false;
  const double part = std::clamp(most.share, kLeastPart, 1 - kLeastPart);
  const double share = a.share + part * (b.share - a.share);
  const SurfacePoint found = nearest(view, view.at(share), a.foot.triangle);
  const Sample between{share, {found.triangle, found.distance}};
  if (found.distance > line.peak.foot.distance) line.peak = between;
  return found.distance <= seen_ && is_near(view, a, between, divisions - 1, line) &&
         is_near(view, between, b, divisions - 1, line);
}

/// A bound on the distances from an edge of now, followed over the triangles of then from the one nearest to
/// its first end. The distance to a triangle is convex: on the part of the edge that lies over it, it is
/// largest at an end of that part.
double SurfaceLimit::bound_along(const View& view, Index triangle) const {
  double most = 0, at = 0;
  for (unsigned parts = 0; parts < kMostParts; ++parts) {
    const PreparedTriangle& t = problem_.near->surface->prepared(triangle);
    if (!t.has_area) return INFINITY;
    const Vec3 first = t.barycentric(view.first);
    const Vec3 change = t.barycentric(view.second) - first;
    double end = 1;
    unsigned side = 3;
    for (unsigned k = 0; k < 3; ++k) {
      if (!(change[k] < 0) || !(-first[k] > end * change[k])) continue;
      end = -first[k] / change[k];
      side = k;
    }
    end = std::max(end, at);
    for (const double share : {at, end}) {
      Vec3 w = (first + share * change).cwiseMax(0);
      w /= w.sum();
      const Vec3 foot = w[0] * t.a + w[1] * t.b + w[2] * t.c;
      most = std::max(most, (view.at(share) - foot).squaredNorm());
    }
    if (side == 3) return std::sqrt(most);
    const Corner across = problem_.topology.opposite(3 * triangle + side);
    if (across == kNone) return INFINITY;
    triangle = across / 3;
    at = end;
  }
  return INFINITY;
}

void SurfaceLimit::measure(std::size_t id, std::span<const Vec3> x, const std::array<Foot, 2>& ends) {
  Line& line = lines_[id];
  const View view = view_of(id, x);
  const Sample a{0, ends[0]};
  const Sample b{1, ends[1]};
  line.bound = 0;
  line.uses.clear();
  line.peak = a.foot.distance < b.foot.distance ? b : a;
  if (view.now) {
    for (const Index v : ends_of_[id]) note_use(line, v);
  }
  if (view.now && line.peak.foot.distance <= seen_ && a.foot.triangle != b.foot.triangle) {
    line.bound = bound_along(view, a.foot.triangle);
    if (line.bound <= proven_) return;
    line.bound = 0;
  }
  if (line.peak.foot.distance <= seen_ && is_near(view, a, b, kDivisions, line)) return;
  // What is too far depends on the triangles nearest to it, as what is near does: they are about these.
  line.bound = INFINITY;
  if (view.now) return;
  for (const Index t : {a.foot.triangle, b.foot.triangle, line.peak.foot.triangle})
    for (const Index v : problem_.triangles[t])
      for (const Corner c : problem_.topology.corners_of(v))
        for (const Index w : problem_.triangles[c / 3]) note_use(line, w);
}

/// A triangle of now within the limit, even where no walk leads there: it was moved away from.
SurfacePoint SurfaceLimit::surely_nearest(const View& view, const Vec3& point, Index triangle) const {
  SurfacePoint found = nearest(view, point, triangle);
  if (found.distance <= proven_) return found;
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    const SurfacePoint other = closest_of(view, t, point);
    if (other.distance < found.distance) found = other;
  }
  return found;
}

void SurfaceLimit::blame_for(std::size_t id, std::span<const Vec3> x, Blame blame, std::span<const Vec3> from,
                             std::vector<Excess>& to) const {
  const View view = view_of(id, x);
  const auto& [share, foot] = lines_[id].peak;
  const Vec3 point = view.at(share);
  const SurfacePoint found = nearest(view, point, foot.triangle);
  const Vec3 outwards = (view.now ? point - found.point : found.point - point).stableNormalized();
  const double least = blame == Blame::all ? 0 : kLeastWeight;
  if (view.now) {
    const auto& [a, b] = ends_of_[id];
    if (1 - share >= least) to.push_back({a, outwards});
    if (share >= least) to.push_back({b, outwards});
    return;
  }
  if (blame == Blame::movers) {
    for (unsigned k = 0; k < 3; ++k)
      if (found.barycentric[k] >= least) to.push_back({problem_.triangles[found.triangle][k], outwards});
    return;
  }
  const auto blame_all_about = [&](Index triangle) {
    for (const Index v : problem_.triangles[triangle])
      for (const Corner c : problem_.topology.corners_of(v))
        for (const Index w : problem_.triangles[c / 3]) to.push_back({w, outwards});
  };
  blame_all_about(found.triangle);
  // What is near now need not have moved: what was near has.
  if (!from.empty())
    blame_all_about(surely_nearest({false, view.first, view.second, from}, point, found.triangle).triangle);
}

void SurfaceLimit::note_moves(std::span<const Vec3> x) {
  for (std::size_t v = 0; v < x.size(); ++v) {
    moves_[v] = x[v] != last_[v] ? 1 : 0;
    if (moves_[v] != 0) travelled_[v] += (x[v] - last_[v]).norm();
  }
  last_.assign(x.begin(), x.end());
}

std::vector<SurfaceLimit::Excess> SurfaceLimit::too_far(std::span<const Vec3> x, Blame blame,
                                                        std::span<const Vec3> from) {
  if (!problem_.near) return {};
  prepare();
  note_moves(x);
  const auto moves = [&](Index v) { return moves_[v] != 0; };
  parallel_for_blocks(ends_.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index v = ends_[i];
      if (moves(v)) feet_now_[v] = foot_of(true, x, v);
      if (std::ranges::any_of(problem_.triangles[feet_then_[v].triangle], moves))
        feet_then_[v] = foot_of(false, x, v);
    }
  });
  far_.resize(block_count(lines_.size()));
  parallel_for_blocks(lines_.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Excess>& far = far_[begin / kBlockSize];
    far.clear();
    for (std::size_t id = begin; id < end; ++id) {
      if (is_near_still(lines_[id])) continue;
      const auto& feet = is_of_now(id) ? feet_now_ : feet_then_;
      measure(id, x, {feet[ends_of_[id][0]], feet[ends_of_[id][1]]});
      if (lines_[id].bound > proven_) blame_for(id, x, blame, from, far);
    }
  });
  std::vector<Excess> all;
  for (const auto& far : far_) all.insert(all.end(), far.begin(), far.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Excess& a, const Excess& b) { return a.vertex < b.vertex; });
  return all;
}

void SurfaceLimit::start(std::span<const Vec3> x) {
  if (!problem_.near) return;
  static_cast<void>(too_far(x, Blame::movers));
  lines_of_.assign(problem_.vertex_count(), {});
  for (Index id = 0; id < lines_.size(); ++id) {
    for (const Use& use : lines_[id].uses) lines_of_[use.vertex].push_back(id);
  }
}

bool SurfaceLimit::keeps(std::span<const Vec3> x, Index vertex) {
  if (!problem_.near) return true;
  const double travelled = travelled_[vertex];
  const Foot foot = feet_now_[vertex];
  travelled_[vertex] += (x[vertex] - last_[vertex]).norm();
  if (foot.triangle != kNone) feet_now_[vertex] = foot_of(true, x, vertex);
  std::vector<std::pair<Index, Line>> before;
  const auto is_kept = [&](Index id) {
    if (is_near_still(lines_[id])) return true;
    before.emplace_back(id, lines_[id]);
    const auto& [a, b] = ends_of_[id];
    measure(id, x,
            is_of_now(id) ? std::array{feet_now_[a], feet_now_[b]}
                          : std::array{foot_of(false, x, a), foot_of(false, x, b)});
    return lines_[id].bound <= proven_;
  };
  std::vector<Index>& lines = lines_of_[vertex];
  const auto broken = std::ranges::find_if_not(lines, is_kept);
  if (broken != lines.end()) {
    // What held it back will most likely hold it back again.
    std::rotate(lines.begin(), broken, std::next(broken));
    for (auto& [id, line] : before) lines_[id] = std::move(line);
    feet_now_[vertex] = foot;
    travelled_[vertex] = travelled;
    return false;
  }
  last_[vertex] = x[vertex];
  for (const auto& [id, line] : before) {
    for (const Use& use : lines_[id].uses) {
      std::vector<Index>& users = lines_of_[use.vertex];
      if (std::ranges::find(users, id) == users.end()) users.push_back(id);
    }
  }
  return true;
}

}  // namespace isorelax
