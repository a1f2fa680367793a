#include "smoothing/trial.h"

#include <utility>

#include "mesh/parallel.h"
#include "smoothing/tangent.h"

namespace isorelax {

namespace {

/// How far from its triangles the smooth surface may be, and a smooth feature from its edges, of the distance
/// that the mesh may: what is left is for the triangles between vertices on it.
constexpr double kLargestShareOnSurface = 0.5;
constexpr double kLargestShareOnCurves = 0.9;
/// A move that leads outwards by less than this share of its length slides already.
constexpr double kLeastSlide = 1e-3;

}  // namespace

Vec3 bring_back(const SmoothingProblem& problem, Index vertex, const Vec3& target) {
  if (!problem.surface) return target;
  // The walk starts where the vertex was at the start of the run: the point does not depend on the way there.
  const SurfaceAnchor anchor = problem.anchors[vertex];
  const VertexClass vertex_class = class_on_surface(problem, vertex);
  if (problem.plane_normal && vertex_class == VertexClass::smooth) return target;  // in the plane already
  const auto [there, at] = problem.surface->project(target, vertex_class, anchor);
  if (!problem.near) return there;
  if (at.edge == kNone && problem.near->on_fits) return there;
  const double share = at.edge == kNone ? kLargestShareOnSurface : kLargestShareOnCurves;
  const double most = share * problem.near->distance;
  if (problem.surface->closest_of(at.triangle, there).distance <= most) return there;
  const SurfacePoint foot = problem.surface->closest(there, at.triangle);
  return foot.distance <= most ? there : Vec3(foot.point + (there - foot.point) * (most / foot.distance));
}

void Trial::start(std::span<const Vec3> from, StepRecord& record, bool lead_there) {
  from_ = from;
  to_.resize(from.size());
  if (bends_) tangent_ = record.displacement;
  parallel_for_blocks(from.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (lead_there) {
        to_[v] = from_[v] + record.displacement[v];
      } else {
        place(record, static_cast<Index>(v));
      }
    }
  });
  take_touched();
}

/// Where the accepted share of the move leads, and the displacement that leads there.
void Trial::place(StepRecord& record, Index vertex) {
  const double alpha = record.alpha[vertex];
  if (bends_ && alpha > 0 && !tangent_[vertex].isZero(0)) {
    const Vec3 asked = from_[vertex] + alpha * tangent_[vertex];
    record.displacement[vertex] = (bring_back(problem_, vertex, asked) - from_[vertex]) / alpha;
  }
  to_[vertex] = from_[vertex] + alpha * record.displacement[vertex];
}

bool Trial::cut(StepRecord& record, Index vertex, double factor, Limit why) {
  if (record.alpha[vertex] == 0 || record.displacement[vertex].isZero(0)) return false;
  record.alpha[vertex] *= factor;
  record.limits[vertex] |= why;
  place(record, vertex);
  touch(vertex);
  return true;
}

void Trial::cut_all(StepRecord& record, double alpha, Limit why) {
  begin_pass(record, why);
  parallel_for_blocks(from_.size(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (record.displacement[v].isZero(0)) continue;
      record.alpha[v] = alpha;
      record.limits[v] |= why;
      place(record, static_cast<Index>(v));
    }
  });
  for (Index v = 0; v < from_.size() && record.detail; ++v)
    if (!record.displacement[v].isZero(0)) note_cut(record, v, kNone);
  take_touched();
}

bool Trial::slide(StepRecord& record, Index vertex, const Vec3& outwards) {
  if (problem_.mobility[vertex] != Mobility::plane) return false;
  Vec3& move = bends_ ? tangent_[vertex] : record.displacement[vertex];
  const Vec3 axis = tangent_axis(problem_, from_, vertex);
  const Vec3 along = tangent_part(Mobility::plane, axis, outwards).stableNormalized();
  const double outward = move.dot(along);
  if (!(outward > kLeastSlide * move.norm())) return false;
  move -= outward * along;
  record.limits[vertex] |= kLimitSurface;
  place(record, vertex);
  touch(vertex);
  return true;
}

void Trial::touch(Index vertex) {
  for (const Corner c : problem_.topology.corners_of(vertex)) {
    const Index t = c / 3;
    if (stamp_[t] == round_) continue;
    stamp_[t] = round_;
    touched_.push_back(t);
  }
}

std::vector<Index> Trial::take_touched() {
  ++round_;
  return std::exchange(touched_, {});
}

}  // namespace isorelax
