#include "smoothing/surface_watch.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesh/parallel.h"
#include "quality/inverted.h"
#include "smoothing/newly_crossing.h"
#include "smoothing/outline.h"
#include "smoothing/turn_limit.h"

namespace isorelax {
namespace {

/// Share of the largest distance that vertices may go: the rest is for rounding.
constexpr double kInside = 1 - 1e-9;
/// Where one triangle is over the limit, those over this share of it are held as well.
constexpr double kNearLimit = 0.9;
/// Where the surface went too far although steps kept it near, they have to keep it nearer: first by as much,
/// and a little more, then by more, down to the least share of the limit.
constexpr double kLittleNearer = 0.995;
constexpr double kNearer = 0.93;
constexpr double kLeastShare = 0.7;

/// Vertices of the triangles over the limit, sorted.
std::vector<Index> vertices_over(const DeviationByTriangle& deviation, std::span<const Triangle> triangles,
                                 double limit) {
  std::vector<Index> vertices;
  for (Index t = 0; t < triangles.size(); ++t) {
    if (deviation.largest[t] > limit)
      vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Vertices of triangles that lie upside down now and did not before. Whether one does depends on its
/// surroundings too, which no single step looks at.
std::vector<Index> vertices_turned_over(std::span<const Index> before, std::span<const Index> now,
                                        std::span<const Triangle> triangles) {
  std::vector<Index> turned, vertices;
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(turned));
  for (const Index t : turned) vertices.insert(vertices.end(), triangles[t].begin(), triangles[t].end());
  return vertices;
}

/// Adds to a sorted list. Whether that made it longer.
bool add(std::vector<Index>& sorted, std::span<const Index> more) {
  const std::size_t before = sorted.size();
  sorted.insert(sorted.end(), more.begin(), more.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted.size() > before;
}

/// Adds the neighbours of all held vertices: how the held region grows when holding the triangles alone was
/// in vain.
void grow(std::vector<Index>& held, std::span<const Triangle> triangles, std::size_t vertex_count) {
  std::vector<std::uint8_t> inside(vertex_count, 0);
  for (const Index v : held) inside[v] = 1;
  held.clear();
  std::vector<std::uint8_t> grown = inside;
  for (const Triangle& t : triangles) {
    if (inside[t[0]] + inside[t[1]] + inside[t[2]] == 0) continue;
    for (const Index v : t) grown[v] = 1;
  }
  for (Index v = 0; v < vertex_count; ++v) {
    if (grown[v] != 0) held.push_back(v);
  }
}

}  // namespace

SurfaceWatch::SurfaceWatch(std::span<const Vec3> surface, std::span<const Vec3> start,
                           const SmoothingProblem& problem)
    : surface_(surface),
      start_(start),
      problem_(problem),
      inverted_(inverted_triangles(start, problem.triangles, problem.topology, problem.threads)) {
  if (problem.surface)
    at_the_start_ = problem.surface->flat();
  else if (!problem.plane_normal)
    at_the_start_ = std::make_shared<ClosestPointIndex>(start, problem.triangles);
}

/// Steps that know the surface lead to few of them (TurnLimit).
std::vector<Index> SurfaceWatch::facing_away(std::span<const Vec3> positions) const {
  if (problem_.plane_normal) return {};
  std::vector<std::vector<Index>> found(block_count(problem_.triangle_count()));
  parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = problem_.triangles[i];
      if (problem_.treated[i] != 0 &&
          faces_away(*at_the_start_, problem_.initial_normals[i], {positions[a], positions[b], positions[c]}))
        found[begin / kBlockSize].push_back(static_cast<Index>(i));
    }
  });
  std::vector<Index> all;
  for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
  return all;
}

SurfaceWatch::Finding SurfaceWatch::look(std::span<const Vec3> positions, double limit) const {
  Finding found;
  const std::vector<Index> inverted =
      inverted_triangles(positions, problem_.triangles, problem_.topology, problem_.threads);
  found.turned = vertices_turned_over(inverted_, inverted, problem_.triangles);
  const auto add_triangles = [&](const std::vector<Index>& triangles) {
    for (const Index t : triangles)
      found.turned.insert(found.turned.end(), problem_.triangles[t].begin(), problem_.triangles[t].end());
  };
  add_triangles(facing_away(positions));
  found.turned_triangles = found.turned.size() / 3;
  // Sheets that are thinner than they may move come to cross each other, far from each other on the mesh.
  std::vector<Index> crossing = newly_crossing(problem_, start_, positions);
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  add_triangles(crossing);
  found.crossing_triangles = crossing.size();
  if (std::ranges::equal(surface_, start_) && covers_the_same(positions, inverted)) return found;
  const DeviationByTriangle deviation = measure_deviation_by_triangle(surface_, positions, problem_.triangles,
                                                                      problem_.topology, problem_.threads);
  found.deviation = deviation.whole;
  if (is_over_limit(deviation.whole.max, limit))
    found.far = vertices_over(deviation, problem_.triangles, kNearLimit * limit);
  return found;
}

double SurfaceWatch::largest_distance(double limit) const {
  return kInside * limit * bounding_diagonal(surface_);
}

void SurfaceWatch::hold_more(SurfaceHolds& holds, double& share, const Finding& found, double limit,
                             bool steps_can_look_out) const {
  if (steps_can_look_out && found.crossing_triangles > 0 && !holds.apart) {
    holds.apart = true;
    return;
  }
  if (add(holds.still, found.turned)) return;
  if (!found.far.empty() && share > kLeastShare) {
    const double by_as_much = kLittleNearer * limit / found.deviation.max;
    share *= share == 1 ? std::max(kNearer, by_as_much) : kNearer;
    return;
  }
  if (!add(holds.still, found.far)) grow(holds.still, problem_.triangles, start_.size());
}

/// Whether the positions surely cover the same part of one plane, so that there is nothing to measure: all in
/// it but for rounding, the border where it was, no triangle upside down before or after.
bool SurfaceWatch::covers_the_same(std::span<const Vec3> after, std::span<const Index> inverted) const {
  constexpr double kRounding = 1e-14;
  if (!problem_.plane_normal || !inverted_.empty() || !inverted.empty()) return false;
  double low = INFINITY, high = -INFINITY, extent = 0;
  for (const Triangle& t : problem_.triangles) {
    for (const Index v : t) {
      extent = std::max(extent, start_[v].cwiseAbs().maxCoeff());
      for (const Vec3& x : {start_[v], after[v]}) {
        low = std::min(low, problem_.plane_normal->dot(x));
        high = std::max(high, problem_.plane_normal->dot(x));
      }
    }
  }
  return high - low <= kRounding * extent && keeps_border(after, kRounding * extent);
}

/// Whether the border only moved along its straight stretches, whose ends stayed.
bool SurfaceWatch::keeps_border(std::span<const Vec3> after, double rounding) const {
  for (Index v = 0; v < start_.size(); ++v) {
    if (start_[v] == after[v] || !problem_.topology.is_boundary(v)) continue;
    if (changes_outline(problem_, start_, v, rounding)) return false;
    const auto slides = problem_.border.find(v);
    if (slides == problem_.border.end()) return false;
    const auto& [before, behind] = slides->second;
    if (!runs_straight(after[before], after[v], after[behind], rounding)) return false;
  }
  return true;
}

}  // namespace isorelax
