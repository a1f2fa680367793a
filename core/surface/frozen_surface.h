#pragma once

#include <memory>
#include <span>
#include <vector>

#include "surface/closest_point.h"
#include "surface/feature_curves.h"
#include "surface/height_fit.h"
#include "surface/sectors.h"
#include "surface/vertex_class.h"

namespace isorelax {

/// Where on a frozen surface a vertex is: what the next projection starts from.
struct SurfaceAnchor {
  Index triangle = kNone;
  Index edge = kNone;  ///< of the feature curves; kNone for a vertex on none
};

/// A point on the frozen surface.
struct Projection {
  Vec3 point = Vec3::Zero();
  SurfaceAnchor anchor;
};

/// The surface as it is at the start of a run; vertices slide on it while the mesh changes (method Sec. 9).
///
/// The surface is smoother than its triangles: over a triangle it is the average, weighted with the
/// barycentric coordinates, of local polynomial fits at its three vertices (WALF: Jiao & Wang 2012), so that
/// it passes through all the original vertices. Fits never reach across a crease or a border; creases and
/// borders are curves of their own, creases drawn finely the lines that they are. Planar patches are exactly
/// planar. Nowhere is it farther from its triangles than the turn of their normals explains.
class FrozenSurface {
 public:
  FrozenSurface() = default;
  /// `classes` are those of classify_vertices for the same mesh. Copies what it needs.
  /// About 6 microseconds and 1 kB a vertex.
  FrozenSurface(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                const Topology& topology, const VertexClasses& classes, unsigned threads = 0);

  /// Where a vertex of the original is. Precondition: the vertex is in a triangle.
  [[nodiscard]] SurfaceAnchor anchor(Index vertex) const { return anchors_[vertex]; }

  /// Brings `point` back to the surface near `from`. A smooth vertex goes to its own face: the search walks
  /// from triangle to triangle and never over a crease. A ridge or boundary vertex goes to its own feature
  /// curve, or, where it is on none, to the face. A corner keeps `point`. A vertex of the original that has
  /// not moved stays. Allocates nothing; safe from several threads.
  [[nodiscard]] Projection project(const Vec3& point, VertexClass vertex_class,
                                   const SurfaceAnchor& from) const;

  /// What spans the tangent space of the frozen surface at a point that `project` led to, of unit length: the
  /// normal of its face, or, for a ridge or boundary vertex on a feature curve, the direction of that curve.
  /// It changes smoothly over a face, where the mesh's own normals follow the triangles that happen to be
  /// there: a move along those leaves the surface, and what is brought back need not go downhill.
  [[nodiscard]] Vec3 tangent_axis(const Vec3& point, VertexClass vertex_class,
                                  const SurfaceAnchor& from) const;

  /// The closest point of the original triangles themselves, anywhere: what a largest deviation is counted
  /// from. `hint` makes it cheaper, see ClosestPointIndex.
  [[nodiscard]] SurfacePoint closest(const Vec3& point, Index hint = kNone) const {
    return flat_->closest(point, hint);
  }
  /// The closest point of one of them.
  [[nodiscard]] SurfacePoint closest_of(Index triangle, const Vec3& point) const {
    return flat_->closest_of(triangle, point);
  }
  /// Share, from 0 to 1, of the curved triangles over whose middle the three fits differ by a small part of
  /// their height: 1 on a sphere, little on a rough scan, 0 where no triangle is curved.
  [[nodiscard]] double agreement() const { return agreement_; }
  /// The original triangles.
  [[nodiscard]] const std::shared_ptr<const ClosestPointIndex>& flat() const { return flat_; }

 private:
  /// A point of a triangle with its lifted one.
  struct Lifted {
    SurfacePoint foot;
    Vec3 point;
  };

  void find_walls(const Topology& topology, std::span<const Corner> creases);
  void find_planar_patches(const Topology& topology);
  void fit_sectors(unsigned threads);
  void bound_lifts(unsigned threads);
  void measure_agreement(unsigned threads);
  void find_curves(const Topology& topology, const VertexClasses& classes,
                   std::span<const FeatureCurves::Edge> creases);
  [[nodiscard]] bool is_planar(const Sectors& sectors, Index sector) const;

  [[nodiscard]] SurfacePoint walk(const Vec3& point, Index triangle) const;
  [[nodiscard]] Lifted lift(const SurfacePoint& foot) const;
  [[nodiscard]] Lifted project_to_face(const Vec3& point, Index from) const;
  [[nodiscard]] Vec3 normal(const SurfacePoint& foot) const;

  std::vector<Vec3> x_;
  std::vector<Triangle> triangles_;
  std::shared_ptr<const ClosestPointIndex> flat_;
  EdgeWalls walls_;               ///< creases and borders
  std::vector<Corner> opposite_;  ///< across edges that are no walls
  Sectors faces_;                 ///< about each vertex, between walls
  Sectors patches_;               ///< the same with the rims of planar patches as walls too: one fit for each
  std::vector<std::uint8_t> planar_;  ///< triangles of planar patches
  std::vector<Vec3> normals_;         ///< of the patches' sectors: unit, weighted by area
  std::vector<HeightFit> fits_;       ///< of the patches' sectors
  std::vector<double> largest_lift_;  ///< of each triangle
  std::vector<SurfaceAnchor> anchors_;
  FeatureCurves curves_;
  double agreement_ = 0;
  double resolution2_ = 0;  ///< squared length that makes no difference
};

}  // namespace isorelax
