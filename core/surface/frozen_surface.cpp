#include "surface/frozen_surface.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"
#include "surface/deviation.h"
#include "surface/feature_edges.h"
#include "surface/fit_samples.h"
#include "surface/walk.h"

namespace isorelax {
namespace {

/// Distance from a plane over distance from a point of it, up to which a vertex counts as in the plane.
constexpr double kPlanar = 5e-5;
/// A sphere lifts the middle of an equilateral triangle by 0.15 of its edge times the turn of the normals of
/// the triangles about it; noise may not make much more of it.
constexpr double kLargestLift = 0.4;
/// Fits that differ by less of their height than this are of one mind.
constexpr double kSmallSpread = 0.2;
constexpr int kCorrections = 2;

Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

Vec3 normal_of(std::span<const Vec3> x, const Triangle& t) {
  return area_vector(x[t[0]], x[t[1]], x[t[2]]);
}

}  // namespace

// Set-up --------------------------------------------------------------------------------------------------

FrozenSurface::FrozenSurface(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                             const Topology& topology, const VertexClasses& classes, unsigned threads)
    : x_(positions.begin(), positions.end()),
      triangles_(triangles.begin(), triangles.end()),
      flat_(std::make_shared<ClosestPointIndex>(positions, triangles)) {
  const double diagonal = bounding_diagonal(x_);
  resolution2_ = 1e-26 * diagonal * diagonal;

  std::vector<Corner> crease_corners;
  std::vector<FeatureCurves::Edge> creases;
  for (const FeatureEdge& e : classes.creases) {
    crease_corners.push_back(e.corner);
    creases.push_back(e.vertices);
  }
  find_walls(topology, crease_corners);
  find_planar_patches(topology);
  fit_sectors(threads);
  bound_lifts(threads);
  measure_agreement(threads);
  find_curves(topology, classes, creases);
}

void FrozenSurface::find_walls(const Topology& topology, std::span<const Corner> creases) {
  walls_.assign(3 * triangles_.size(), 0);
  opposite_.resize(3 * triangles_.size());
  for (Corner c = 0; c < opposite_.size(); ++c) {
    opposite_[c] = topology.opposite(c);
    if (opposite_[c] == kNone) walls_[c] = 1;
  }
  for (const Corner c : creases) {
    walls_[c] = walls_[opposite_[c]] = 1;
    opposite_[opposite_[c]] = kNone;
    opposite_[c] = kNone;
  }
  faces_ = Sectors(triangles_, topology, walls_);
}

/// Whether a vertex with enough triangles about it to tell lies in one plane with all of them.
bool FrozenSurface::is_planar(const Sectors& sectors, Index sector) const {
  const auto corners = sectors.corners(sector);
  if (!sectors.is_closed(sector) && corners.size() < 3) return false;
  Vec3 sum = Vec3::Zero();
  for (const Corner c : corners) sum += normal_of(x_, triangles_[c / 3]);
  const Vec3 normal = unit(sum);
  const Vec3& origin = x_[sectors.vertex(sector)];
  double height = 0, radius2 = 0;
  for (const Corner c : corners) {
    if (normal_of(x_, triangles_[c / 3]).dot(normal) < 0) return false;
    for (const unsigned k : {next(c % 3), previous(c % 3)}) {
      const Vec3 d = x_[triangles_[c / 3][k]] - origin;
      height = std::max(height, std::abs(d.dot(normal)));
      radius2 = std::max(radius2, d.squaredNorm());
    }
  }
  return height <= kPlanar * std::sqrt(radius2);
}

/// Triangles about planar vertices make planar patches. Their rims are walls for fits: where a plane runs
/// smoothly into a fillet, no polynomial is good for both.
void FrozenSurface::find_planar_patches(const Topology& topology) {
  planar_.assign(triangles_.size(), 0);
  bool any = false;
  for (Index s = 0; s < faces_.count(); ++s) {
    if (!is_planar(faces_, s)) continue;
    any = true;
    for (const Corner c : faces_.corners(s)) planar_[c / 3] = 1;
  }
  if (!any) {
    patches_ = faces_;
    return;
  }
  EdgeWalls rims = walls_;
  for (Corner c = 0; c < rims.size(); ++c)
    if (opposite_[c] != kNone && planar_[c / 3] != planar_[opposite_[c] / 3]) rims[c] = 1;
  patches_ = Sectors(triangles_, topology, rims);
}

void FrozenSurface::fit_sectors(unsigned threads) {
  const std::size_t count = patches_.count();
  normals_.resize(count);
  fits_.resize(count);
  parallel_for_blocks(count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      Vec3 sum = Vec3::Zero();
      for (const Corner c : patches_.corners(static_cast<Index>(s))) sum += normal_of(x_, triangles_[c / 3]);
      normals_[s] = unit(sum);
    }
  });
  std::vector<FitSample> samples(count);
  for (Index s = 0; s < count; ++s) samples[s] = {x_[patches_.vertex(s)], normals_[s]};
  const SectorNeighbours neighbours(patches_);
  const HeightFitOptions options;
  const std::size_t wanted = HeightFit::samples_for(options);
  Scratch<FitSampler> samplers([&] { return std::make_unique<FitSampler>(neighbours, samples); });
  parallel_for_blocks(count, threads, [&](std::size_t begin, std::size_t end) {
    samplers.with_one([&](FitSampler& sampler) {
      for (Index s = static_cast<Index>(begin); s < end; ++s) {
        if (planar_[patches_.corners(s)[0] / 3] != 0) continue;
        fits_[s] = HeightFit(samples[s].point, samples[s].normal, sampler.collect(s, wanted), options);
      }
    });
  });
}

/// The turn of the normals of the triangles about, rather than of vertex normals or of the fits: those may
/// lean to one large triangle, and a fit must not be its own judge.
void FrozenSurface::bound_lifts(unsigned threads) {
  std::vector<Vec3> normals(triangles_.size());
  parallel_for_blocks(triangles_.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) normals[t] = unit(normal_of(x_, triangles_[t]));
  });
  largest_lift_.assign(triangles_.size(), 0);
  parallel_for_blocks(triangles_.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (Index t = static_cast<Index>(begin); t < end; ++t) {
      if (planar_[t] != 0) continue;
      double chord2 = 0, longest2 = 0;  // of the arc of normals: good enough for an angle
      for (unsigned k = 0; k < 3; ++k) {
        for (const Corner c : patches_.corners(patches_.of(3 * t + k)))
          chord2 = std::max(chord2, (normals[c / 3] - normals[t]).squaredNorm());
        longest2 = std::max(longest2, (x_[triangles_[t][next(k)]] - x_[triangles_[t][k]]).squaredNorm());
      }
      largest_lift_[t] = kLargestLift * std::sqrt(longest2 * std::min(chord2, 1.0));
    }
  });
}

void FrozenSurface::measure_agreement(unsigned threads) {
  enum class Fits : std::uint8_t { none, differ, agree };
  std::vector<Fits> over(triangles_.size(), Fits::none);
  parallel_for_blocks(triangles_.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (Index t = static_cast<Index>(begin); t < end; ++t) {
      if (!(largest_lift_[t] > 0)) continue;
      const auto& [a, b, c] = triangles_[t];
      const Vec3 middle = (x_[a] + x_[b] + x_[c]) / 3;
      std::array<Vec3, 3> lifts;
      for (unsigned k = 0; k < 3; ++k) lifts[k] = fits_[patches_.of(3 * t + k)].lift(middle) - middle;
      const Vec3 mean = (lifts[0] + lifts[1] + lifts[2]) / 3;
      double spread = 0;
      for (const Vec3& lift : lifts) spread += (lift - mean).norm() / 3;
      over[t] = spread < kSmallSpread * mean.norm() ? Fits::agree : Fits::differ;
    }
  });
  const auto agreeing = static_cast<double>(std::ranges::count(over, Fits::agree));
  const double curved = agreeing + static_cast<double>(std::ranges::count(over, Fits::differ));
  agreement_ = curved == 0 ? 0 : agreeing / curved;
}

void FrozenSurface::find_curves(const Topology& topology, const VertexClasses& classes,
                                std::span<const FeatureCurves::Edge> creases) {
  std::vector<FeatureCurves::Edge> edges(creases.begin(), creases.end());
  for (Corner c = 0; c < 3 * triangles_.size(); ++c)
    if (topology.is_boundary_edge(c))
      edges.push_back({triangles_[c / 3][next(c % 3)], triangles_[c / 3][previous(c % 3)]});
  std::vector<std::uint8_t> is_corner(x_.size(), 0);
  for (std::size_t v = 0; v < x_.size(); ++v) is_corner[v] = classes.classes[v] == VertexClass::corner;
  curves_ = FeatureCurves(x_, edges, is_corner, creases.size());
  anchors_.resize(x_.size());
  for (Index v = 0; v < x_.size(); ++v) {
    const auto corners = topology.corners_of(v);
    if (corners.empty()) continue;
    // The largest triangle, whatever the numbering: the faces of a crease that ends here may differ.
    const auto area2 = [&](Corner c) { return normal_of(x_, triangles_[c / 3]).squaredNorm(); };
    const Corner largest = *std::ranges::max_element(corners, {}, area2);
    anchors_[v] = {largest / 3, curves_.edge_of(v)};
  }
}

// Queries -------------------------------------------------------------------------------------------------

SurfacePoint FrozenSurface::walk(const Vec3& point, Index triangle) const {
  const auto foot = [&](Index t) { return closest_of(t, point); };
  return walk_nearer(
      foot(triangle), foot, [&](Corner c) { return opposite_[c]; },
      [&](Corner c) { return faces_.corners(faces_.of(c)); });
}

FrozenSurface::Lifted FrozenSurface::lift(const SurfacePoint& foot) const {
  const double largest = largest_lift_[foot.triangle];
  if (!(largest > 0) || foot.barycentric.maxCoeff() == 1) return {foot, foot.point};
  Vec3 offset = Vec3::Zero();
  for (unsigned k = 0; k < 3; ++k) {
    const HeightFit& fit = fits_[patches_.of(3 * foot.triangle + k)];
    offset += foot.barycentric[k] * (fit.lift(foot.point) - foot.point);
  }
  const double length = offset.norm();
  if (length > largest) offset *= largest / length;
  return {foot, foot.point + offset};
}

FrozenSurface::Lifted FrozenSurface::project_to_face(const Vec3& point, Index from) const {
  Lifted at = lift(walk(point, from));
  // The lift moves a little along the surface as well: take that back.
  for (int i = 0; i < kCorrections && at.point != at.foot.point; ++i) {
    Vec3 normal = Vec3::Zero();
    for (unsigned k = 0; k < 3; ++k)
      normal += at.foot.barycentric[k] * normals_[patches_.of(3 * at.foot.triangle + k)];
    normal = unit(normal);
    Vec3 back = point - at.point;
    back -= normal.dot(back) * normal;
    if (back.squaredNorm() <= resolution2_) break;
    at = lift(walk(at.foot.point + back, at.foot.triangle));
  }
  return at;
}

/// The blend of the fits' normals with the weights of the blend of the fits.
Vec3 FrozenSurface::normal(const SurfacePoint& foot) const {
  if (!(largest_lift_[foot.triangle] > 0)) return unit(normal_of(x_, triangles_[foot.triangle]));
  Vec3 sum = Vec3::Zero();
  for (unsigned k = 0; k < 3; ++k) {
    if (foot.barycentric[k] == 0) continue;
    sum += foot.barycentric[k] * unit(fits_[patches_.of(3 * foot.triangle + k)].normal(foot.point));
  }
  return unit(sum);
}

Projection FrozenSurface::project(const Vec3& point, VertexClass vertex_class,
                                  const SurfaceAnchor& from) const {
  if (vertex_class == VertexClass::corner) return {point, from};
  if (vertex_class == VertexClass::smooth || from.edge == kNone) {
    const Lifted at = project_to_face(point, from.triangle);
    return {at.point, {at.foot.triangle, from.edge}};
  }
  const CurvePoint found = curves_.project(point, from.edge);
  return {found.point, {from.triangle, found.edge}};
}

Vec3 FrozenSurface::tangent_axis(const Vec3& point, VertexClass vertex_class,
                                 const SurfaceAnchor& from) const {
  if (vertex_class == VertexClass::smooth || from.edge == kNone) return normal(walk(point, from.triangle));
  return curves_.direction_at(point, from.edge);
}

}  // namespace isorelax
